#include "view/black_box.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <variant>

#include "base/seconds.hpp"
#include "config/config_file.hpp"
#include "io/work_folder.hpp"
#include "laneloom/dds/cdr.hpp"

namespace laneloom::view {
namespace {

constexpr std::size_t kGroupBytes = 1U << 19U;

std::string content_of(const std::filesystem::path& path) {
  std::string content(std::filesystem::file_size(path), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return content;
}

/// The configuration that a status tells, as a file. Empty: it tells none, or is of another version of
/// laneloom.
std::string configuration_of(const ServiceStatus& status) {
  if (status.configuration.empty()) return {};
  try {
    return config::dump(config::from_settings(status.configuration, ""));
  } catch (const ConfigError&) {
    return {};
  }
}

}  // namespace

BlackBox::BlackBox(const DdsConfig& dds, const StoreLimits& limits)
    : map_frame_id_(dds.map_frame_id), limits_(limits) {}

void BlackBox::add(const recording::AnyMessage& message, std::int64_t time_ns) {
  const std::lock_guard lock(mutex_);
  if (const auto* status = std::get_if<ServiceStatus>(&message)) status_ = *status;
  std::visit([&](const auto& any) { dds::to_cdr(any, map_frame_id_, cdr_); }, message);
  open_.append(cdr_.begin(), cdr_.end());
  log_time_ns_ = std::max(log_time_ns_ + 1, time_ns);
  open_entries_.push_back({log_time_ns_, message.index(), open_.size()});
  if (open_.size() >= kGroupBytes) {
    groups_.push_back({std::exchange(open_entries_, {}), Packed(open_)});
    bytes_ += groups_.back().messages.bytes();
    open_.clear();
  }
  while (!groups_.empty() &&
         (seconds(log_time_ns_ - groups_.front().entries.back().log_time_ns) > limits_.span_s ||
          bytes_ > limits_.bytes)) {
    bytes_ -= groups_.front().messages.bytes();
    groups_.pop_front();
  }
}

std::string BlackBox::mcap() const {
  const std::lock_guard lock(mutex_);
  const io::WorkFolder folder;
  const std::string path = folder.file("last.mcap");
  recording::RecordingWriter writer(
      path, {.map_frame_id = map_frame_id_, .configuration = status_ ? configuration_of(*status_) : ""});
  const auto write = [&](const std::vector<Entry>& entries, const std::string& messages) {
    std::size_t begin = 0;
    for (const Entry& entry : entries) {
      writer.write_raw({.log_time_ns = entry.log_time_ns,
                        .topic = entry.topic,
                        .bytes = {messages.begin() + static_cast<std::ptrdiff_t>(begin),
                                  messages.begin() + static_cast<std::ptrdiff_t>(entry.end)}});
      begin = entry.end;
    }
  };
  for (const Group& group : groups_) write(group.entries, group.messages.unpacked());
  write(open_entries_, open_);
  writer.close();
  return content_of(path);
}

}  // namespace laneloom::view
