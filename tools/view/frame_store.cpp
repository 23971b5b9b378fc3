#include "view/frame_store.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/seconds.hpp"
#include "io/json_text.hpp"

namespace laneloom::view {
namespace {

constexpr std::size_t kSummariesPerAnswer = 4000;
constexpr std::size_t kFramesPerGroup = 8;

/// The frame of an index among frames that end where `ends` says.
std::string cut_out(const std::string& frames, const std::vector<std::size_t>& ends, std::size_t index) {
  const std::size_t begin = index == 0 ? 0 : ends[index - 1];
  return frames.substr(begin, ends[index] - begin);
}

}  // namespace

void FrameStore::add(std::int64_t time_ns, std::string summary, std::string_view frame) {
  const std::lock_guard lock(mutex_);
  if (open_ends_.empty()) open_time_ns_ = time_ns;
  open_ += frame;
  open_ends_.push_back(open_.size());
  summaries_.push_back(std::move(summary));
  ++size_;
  if (open_ends_.size() >= kFramesPerGroup) close_group();
  while (!groups_.empty() &&
         (seconds(time_ns - groups_.front().time_ns) > limits_.span_s || bytes_ > limits_.bytes)) {
    const Group& oldest = groups_.front();
    bytes_ -= oldest.frames.bytes();
    summaries_.erase(summaries_.begin(),
                     summaries_.begin() + static_cast<std::ptrdiff_t>(oldest.ends.size()));
    groups_.pop_front();
  }
}

void FrameStore::close_group() {
  groups_.push_back({open_time_ns_, size_ - open_ends_.size(), std::exchange(open_ends_, {}), Packed(open_)});
  bytes_ += groups_.back().frames.bytes();
  open_.clear();
}

void FrameStore::finish(const std::string& error) {
  const std::lock_guard lock(mutex_);
  finished_ = true;
  error_ = error;
}

std::size_t FrameStore::size() const {
  const std::lock_guard lock(mutex_);
  return size_;
}

std::string FrameStore::failure() const {
  const std::lock_guard lock(mutex_);
  return size_ == 0 ? error_ : "";
}

std::optional<std::string> FrameStore::frame(std::size_t number) const {
  const std::lock_guard lock(mutex_);
  const std::size_t first_open = size_ - open_ends_.size();
  if (number >= size_) return std::nullopt;
  if (number >= first_open) return cut_out(open_, open_ends_, number - first_open);
  const auto after = std::ranges::upper_bound(groups_, number, {}, &Group::first);
  if (after == groups_.begin()) return std::nullopt;
  const Group& group = *std::prev(after);
  return cut_out(group.frames.unpacked(), group.ends, number - group.first);
}

std::string FrameStore::summaries(std::size_t from) const {
  const std::lock_guard lock(mutex_);
  const std::size_t kept = size_ - summaries_.size();
  const std::size_t begin = std::max(from, kept) - kept;
  const std::size_t end =
      std::min(summaries_.size(), begin < summaries_.size() ? begin + kSummariesPerAnswer : begin);
  std::string list;
  for (std::size_t i = begin; i < end; ++i) list += (i == begin ? "" : ",") + summaries_[i];
  const bool complete = finished_ && end >= summaries_.size();
  return R"({"complete":)" + nlohmann::json(complete).dump() + R"(,"error":)" + io::json_text(error_) +
         R"(,"frames":[)" + list + "]}";
}

}  // namespace laneloom::view
