#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace laneloom {

/// A DDS domain that no other test on this host has while this lives. The file that is locked for it is left
/// behind: a file that is removed could be locked twice.
class DomainLease {
 public:
  /// Throws std::runtime_error when all domains are taken.
  DomainLease() {
    for (int tried = 0; tried < kDomains && file_ < 0; ++tried) {
      number_ = 1 + (getpid() + tried) % kDomains;
      file_ = lock(number_);
    }
    if (file_ < 0) throw std::runtime_error("no DDS domain is free for this test");
  }
  ~DomainLease() { close(file_); }
  DomainLease(const DomainLease&) = delete;
  DomainLease& operator=(const DomainLease&) = delete;

  int number() const { return number_; }

 private:
  /// The file of a domain, locked; -1: another process has it.
  static int lock(int number) {
    const auto path =
        std::filesystem::temp_directory_path() / ("laneloom_test_domain_" + std::to_string(number));
    const int file = open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0 || flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    close(file);
    return -1;
  }

  static constexpr int kDomains = 90;  // the ports of higher ones are the system's to give away
  int number_ = 0;
  int file_ = -1;
};

/// The DDS domain of this process, and of no other test.
inline int own_domain() {
  static const DomainLease lease;
  return lease.number();
}

}  // namespace laneloom
