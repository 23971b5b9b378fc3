#include "view/frame_store.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "recording/compression.hpp"

namespace laneloom::view {
namespace {

constexpr std::size_t kSummariesPerAnswer = 4000;

recording::ByteView bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

void FrameStore::add(std::string summary, std::string_view frame) {
  Compressed compressed{.size = frame.size()};
  compress(recording::Compression::zstd, bytes_of(frame), compressed.bytes);
  compressed.bytes.shrink_to_fit();
  const std::lock_guard lock(mutex_);
  frames_.push_back(std::move(compressed));
  summaries_.push_back(std::move(summary));
}

void FrameStore::finish(const std::string& error) {
  const std::lock_guard lock(mutex_);
  finished_ = true;
  error_ = error;
}

std::size_t FrameStore::size() const {
  const std::lock_guard lock(mutex_);
  return frames_.size();
}

std::string FrameStore::failure() const {
  const std::lock_guard lock(mutex_);
  return frames_.empty() ? error_ : "";
}

std::optional<std::string> FrameStore::frame(std::size_t number) const {
  const std::lock_guard lock(mutex_);
  if (number >= frames_.size()) return std::nullopt;
  const Compressed& compressed = frames_[number];
  std::string text(compressed.size, '\0');
  decompress(recording::Compression::zstd, compressed.bytes,
             {reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
  return text;
}

std::string FrameStore::summaries(std::size_t from) const {
  const std::lock_guard lock(mutex_);
  const std::size_t end =
      std::min(summaries_.size(), from < summaries_.size() ? from + kSummariesPerAnswer : from);
  std::string list;
  for (std::size_t i = from; i < end; ++i) list += (i == from ? "" : ",") + summaries_[i];
  const bool complete = finished_ && end >= summaries_.size();
  return R"({"complete":)" + nlohmann::json(complete).dump() + R"(,"error":)" +
         nlohmann::json(error_).dump() + R"(,"frames":[)" + list + "]}";
}

}  // namespace laneloom::view
