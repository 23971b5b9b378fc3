#include "view/site.hpp"

#include <charconv>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "drawing/drawing_json.hpp"
#include "io/json_text.hpp"
#include "view/door.hpp"
#include "view/metrics.hpp"
#include "view/page.hpp"

namespace laneloom::view {
namespace {

/// Metrics are of a status that is at most this old. A status comes every second, and metrics of a service
/// that is gone must not look alive.
constexpr std::chrono::seconds kStatusLasts{5};

WebAnswer not_found() { return {404, "text/plain", "not found\n"}; }

std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

Site::Site(Content content, const FrameStore& frames) : content_(std::move(content)), frames_(frames) {}

WebAnswer Site::answer(std::string_view asked) const {
  const Target target(asked);
  if (target.path == "/info") return {.body = info()};
  if (target.path == "/palette") return {.body = drawing::palette_json().dump()};
  if (target.path == "/truth") return {.body = content_.truth};
  if (target.path == "/metrics" && content_.black_box != nullptr) return metrics_answer();
  if (target.path == "/save" && content_.black_box != nullptr) return saved();
  if (target.path == "/recording") return recorded(target.path, target.value("from"));
  if (target.path == "/frame") return recorded(target.path, target.value("number"));
  const auto file = page_files().find(target.path == "/" ? "/index.html" : target.path);
  if (file == page_files().end()) return not_found();
  return {.type = file->second.type, .body = file->second.text};
}

std::string Site::info() const {
  return io::json_text({{"title", content_.title},
                        {"live", content_.black_box != nullptr},
                        {"names", content_.names},
                        {"max_file_bytes", content_.max_file_bytes}});
}

WebAnswer Site::recorded(std::string_view path, std::string_view number) const {
  const auto value = number_of(number);
  if (!value) return not_found();
  if (path == "/recording") return {.body = frames_.summaries(*value)};
  auto frame = frames_.frame(*value);
  return frame ? WebAnswer{.body = *std::move(frame)} : not_found();
}

WebAnswer Site::metrics_answer() const {
  const std::lock_guard lock(mutex_);
  if (!status_ || SteadyClock::now() - status_time_ > kStatusLasts)
    return {503, "text/plain", "no status of the service in the last 5 s\n"};
  return {.type = "text/plain; version=0.0.4; charset=utf-8", .body = metrics(*status_)};
}

WebAnswer Site::saved() const {
  try {
    return {.type = "application/octet-stream", .body = content_.black_box->mcap()};
  } catch (const std::exception& error) {
    return {500, "text/plain", std::string(error.what()) + "\n"};
  }
}

void Site::set_status(const ServiceStatus& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
  status_time_ = SteadyClock::now();
}

}  // namespace laneloom::view
