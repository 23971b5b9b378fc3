#pragma once

#include <sys/types.h>

namespace laneloom::bench {

/// Usage of a running process, from /proc. All throw std::runtime_error if it is gone.
double peak_rss_mb(pid_t process);  ///< MiB, since its start
double rss_mb(pid_t process);       ///< MiB, now
double cpu_s(pid_t process);        ///< of all its threads, in user mode and in the kernel

}  // namespace laneloom::bench
