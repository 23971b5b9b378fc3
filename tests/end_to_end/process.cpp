#include "process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace laneloom {

Process::Process(const std::vector<std::string>& command) {
  std::string name = "/tmp/laneloom_process_XXXXXX";
  close(mkstemp(name.data()));
  error_file_ = name;

  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int errors = open(name.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive a test that crashes
    dup2(errors, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  close(errors);
  if (pid_ < 0) throw std::runtime_error("can not start " + command[0]);
}

Process::~Process() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  unlink(error_file_.c_str());
}

void Process::signal(int number) const { kill(pid_, number); }

std::optional<int> Process::wait() {
  for (int i = 0; i < 6000; ++i) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    usleep(10'000);
  }
  return std::nullopt;
}

std::string Process::errors() const {
  std::ostringstream text;
  text << std::ifstream(error_file_).rdbuf();
  return text.str();
}

bool Process::wait_for_error(const std::string& text) const {
  for (int i = 0; i < 3000; ++i) {
    if (errors().find(text) != std::string::npos) return true;
    usleep(10'000);
  }
  return false;
}

}  // namespace laneloom
