#include "recording/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace laneloom::recording {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}
[[noreturn]] void fail_errno(const std::string& path) { fail(path, std::strerror(errno)); }

int open_or_throw(const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC, 0644);
  if (descriptor < 0) fail_errno(path);
  return descriptor;
}

}  // namespace

FileDescriptor::~FileDescriptor() { close(descriptor_); }

OutputFile::OutputFile(const std::string& path)
    : path_(path), file_(open_or_throw(path, O_WRONLY | O_CREAT | O_EXCL)) {}

void OutputFile::append(ByteView bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(file_.get(), bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      // If even this fails, a reader takes the file for cut off.
      const bool undone = ftruncate(file_.get(), static_cast<off_t>(size_)) == 0 &&
                          lseek(file_.get(), static_cast<off_t>(size_), SEEK_SET) >= 0;
      errno = reason;
      if (!undone) fail(path_, std::string(std::strerror(reason)) + "; its end is incomplete");
      fail_errno(path_);
    }
    done += static_cast<std::size_t>(written);
  }
  size_ += bytes.size();
}

InputFile::InputFile(const std::string& path)
    : path_(path), file_(open_or_throw(path, O_RDONLY | O_NONBLOCK)) {
  struct stat status {};
  if (fstat(file_.get(), &status) != 0) fail_errno(path);
  if (!S_ISREG(status.st_mode)) fail(path, "is not a regular file");
  size_ = static_cast<std::uint64_t>(status.st_size);
}

void InputFile::read(std::uint64_t offset, std::span<std::uint8_t> to) const {
  while (!to.empty()) {
    const ssize_t count = pread(file_.get(), to.data(), to.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_errno(path_);
    if (count == 0) fail(path_, "became shorter while it was read");
    to = to.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
}

}  // namespace laneloom::recording
