#include "view/stream.hpp"

#include <algorithm>

namespace laneloom::view {

void Outbox::put(std::uint64_t slot, WebMessage message) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [slot](const auto& entry) { return entry.first == slot; });
  if (found != waiting_.end())
    found->second = std::move(message);
  else
    waiting_.emplace_back(slot, std::move(message));
}

std::optional<WebMessage> Outbox::next() {
  if (waiting_.empty()) return std::nullopt;
  WebMessage message = std::move(waiting_.front().second);
  waiting_.erase(waiting_.begin());
  return message;
}

void PageStream::open(const NewestPublications& newest, Outbox& outbox) {
  if (newest[channel_].body) publish(newest[channel_], outbox);
}

bool PageStream::receive(std::string_view, const NewestPublications&, Outbox&) { return true; }

void PageStream::publish(const Publication& publication, Outbox& outbox) {
  if (publication.channel == channel_) outbox.put(0, {.header = {}, .body = publication.body});
}

}  // namespace laneloom::view
