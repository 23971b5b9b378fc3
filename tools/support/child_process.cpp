#include "support/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace laneloom::support {
namespace {

/// Becomes the program. The child's end of the pipe `complaints` is closed when the program begins. If it
/// cannot begin, the pipe tells why.
void become(char* const* arguments, int output, int complaints) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // else it would outlive an interrupted benchmark
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(arguments[0], arguments);
  const int error = errno;
  [[maybe_unused]] const auto told = write(complaints, &error, sizeof error);
  _exit(127);
}

/// A file to write, open as long as this.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path)
      : descriptor_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {
    if (descriptor_ < 0) throw std::runtime_error(path + ": cannot be written");
  }
  ~OpenFile() { close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

ChildProcess::ChildProcess(std::vector<std::string> command, const std::string& output)
    : ChildProcess(std::move(command), OpenFile(output).descriptor()) {}

ChildProcess::ChildProcess(std::vector<std::string> command, int output) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> complaints{};
  if (pipe2(complaints.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "pipe");
  id_ = fork();
  if (id_ == 0) become(arguments.data(), output, complaints[1]);
  int error = errno;
  close(complaints[1]);
  const bool failed = id_ < 0 || read(complaints[0], &error, sizeof error) > 0;
  close(complaints[0]);
  if (!failed) return;
  if (id_ > 0) waitpid(id_, nullptr, 0);
  throw std::runtime_error(command[0] + ": cannot be started: " + std::generic_category().message(error));
}

ChildProcess::~ChildProcess() {
  if (id_ <= 0) return;
  kill(id_, SIGKILL);
  wait();
}

void ChildProcess::signal(int number) const {
  if (id_ > 0) kill(id_, number);
}

bool ChildProcess::running() {
  if (id_ > 0 && waitpid(id_, &status_, WNOHANG) == id_) id_ = -1;
  return id_ > 0;
}

int ChildProcess::wait() {
  while (id_ > 0)
    if (waitpid(id_, &status_, 0) == id_ || errno != EINTR) id_ = -1;
  return WIFSIGNALED(status_) ? -WTERMSIG(status_) : WEXITSTATUS(status_);
}

std::string ChildProcess::failure() const {
  if (WIFSIGNALED(status_)) return fmt::format("ended by signal {}", WTERMSIG(status_));
  return WEXITSTATUS(status_) == 0 ? "" : fmt::format("ended with exit code {}", WEXITSTATUS(status_));
}

std::string ChildProcess::stop(std::chrono::milliseconds patience) {
  if (!running()) return failure().empty() ? "had ended before" : failure();
  const auto deadline = std::chrono::steady_clock::now() + patience;
  kill(id_, SIGTERM);
  while (running() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (!running()) return failure();
  kill(id_, SIGKILL);
  wait();
  return fmt::format("did not end within {} ms, and was killed", patience.count());
}

}  // namespace laneloom::support
