#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laneloom/messages.hpp"
#include "view/frame_store.hpp"
#include "view/web_server.hpp"

namespace laneloom::view {

/// The answers to a viewer's requests by HTTP, both live and of a recording: the page with its modules,
/// `/info`, `/palette`, `/truth`, `/metrics`, and of a recording `/recording?from=` and `/frame?number=`.
/// Thread-safe.
class Site {
 public:
  /// `title` names the vehicle or the recording. `recording` is null for a live view; otherwise it must
  /// outlive this. `truth` has elements to draw in every frame, as JSON. `names` are the names of the maps
  /// that are compared; empty: there is one map.
  Site(std::string title, std::string truth, const FrameStore* recording,
       std::vector<std::string> names = {});

  WebAnswer answer(std::string_view target) const;
  /// The newest status of the service, for `/metrics`.
  void set_status(const ServiceStatus& status);

 private:
  using SteadyClock = std::chrono::steady_clock;

  std::string info() const;
  WebAnswer recorded(std::string_view path, std::string_view number) const;
  WebAnswer metrics_answer() const;

  std::string title_, truth_;
  const FrameStore* recording_;
  std::vector<std::string> names_;
  mutable std::mutex mutex_;
  std::optional<ServiceStatus> status_;
  SteadyClock::time_point status_time_;
};

}  // namespace laneloom::view
