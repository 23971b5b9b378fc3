#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laneloom/messages.hpp"
#include "view/black_box.hpp"
#include "view/frame_store.hpp"
#include "view/web_server.hpp"

namespace laneloom::view {

/// The answers to a viewer's requests by HTTP, both live and of a recording: the page with its modules,
/// `/info`, `/palette`, `/truth`, `/recording?from=` and `/frame?number=`; of a live view also `/metrics` and
/// `/save`. Thread-safe.
class Site {
 public:
  /// What a view shows.
  struct Content {
    std::string title;               ///< names the vehicle or the recording
    std::string truth = "[]";        ///< elements to draw in every frame, as JSON
    std::vector<std::string> names;  ///< of the maps that are compared; empty: there is one map
    std::size_t max_file_bytes = 0;  ///< of a file that the page may open; 0: it may open none
    const BlackBox* black_box =
        nullptr;  ///< of a live view; null: it is a recording. It must outlive the site
  };

  /// `frames` must outlive this.
  Site(Content content, const FrameStore& frames);

  WebAnswer answer(std::string_view target) const;
  /// The newest status of the service, for `/metrics`.
  void set_status(const ServiceStatus& status);

 private:
  using SteadyClock = std::chrono::steady_clock;

  std::string info() const;
  WebAnswer recorded(std::string_view path, std::string_view number) const;
  WebAnswer metrics_answer() const;
  WebAnswer saved() const;

  Content content_;
  const FrameStore& frames_;
  mutable std::mutex mutex_;
  std::optional<ServiceStatus> status_;
  SteadyClock::time_point status_time_;
};

}  // namespace laneloom::view
