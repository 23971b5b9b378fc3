#include "snapshot/private_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace laneloom::snapshot {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::system_error failure(int error, const std::string& what) {
  return {error, std::generic_category(), what};
}

bool is_trusted(uid_t user) { return user == geteuid() || user == 0; }

/// Throws std::runtime_error if a folder of the path is a link of another user, who could lead it anywhere.
void refuse_planted_links(const std::string& file) {
  std::filesystem::path whole;
  for (const auto& part : std::filesystem::absolute(file).parent_path()) {
    whole /= part;
    struct stat status {};
    if (lstat(whole.c_str(), &status) == 0 && S_ISLNK(status.st_mode) && !is_trusted(status.st_uid))
      throw std::runtime_error(whole.string() + " is a link of user " + std::to_string(status.st_uid));
  }
}

/// Creates a new file. Fails if there is a file or a link already.
File create(const std::string& file) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (descriptor < 0) throw failure(errno, "cannot make " + file);
  return File(fdopen(descriptor, "wb"));
}

/// Opens a file without waiting for the other end, in case that it is a pipe.
File open_to_read(const std::string& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 && errno == ELOOP) throw std::runtime_error("is a link");
  if (descriptor < 0) throw failure(errno, "cannot be read");
  return File(fdopen(descriptor, "rb"));
}

}  // namespace

void replace_private_file(const std::string& file, std::string_view bytes) {
  refuse_planted_links(file);
  const std::string unfinished = file + kUnfinished;
  unlink(unfinished.c_str());  // left by a crash during writing
  File out = create(unfinished);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out.get()) == bytes.size();
  if (std::fclose(out.release()) != 0 || !written) throw failure(errno, "cannot write " + unfinished);
  if (std::rename(unfinished.c_str(), file.c_str()) != 0) throw failure(errno, "cannot replace " + file);
}

std::string read_private_file(const std::string& file) {
  refuse_planted_links(file);
  const File in = open_to_read(file);
  struct stat status {};
  if (fstat(fileno(in.get()), &status) != 0) throw failure(errno, "cannot be read");
  if (!S_ISREG(status.st_mode)) throw std::runtime_error("not a regular file");
  if (!is_trusted(status.st_uid)) {
    throw std::runtime_error("belongs to user " + std::to_string(status.st_uid));
  }
  std::string bytes;
  std::array<char, 65536> part{};
  for (std::size_t count = part.size(); count == part.size();) {
    count = std::fread(part.data(), 1, part.size(), in.get());
    bytes.append(part.data(), count);
  }
  if (std::ferror(in.get()) != 0) throw failure(errno, "cannot be read");
  return bytes;
}

}  // namespace laneloom::snapshot
