#include "drive/dds_map_service.hpp"

#include <utility>

namespace laneloom::drive {

DdsMapService::DdsMapService(const DdsConfig& dds)
    : participant_(dds, "laneloom-lab drive"),
      detections_(participant_),
      poses_(participant_),
      objects_(participant_),
      maps_(participant_, {.sample = [this](PublishedMap&& map) { take(std::move(map)); },
                           .refused = {},
                           .matched = {},
                           .alive =
                               [this](int writers) {
                                 if (writers == 0) lose();
                               },
                           .deadline_missed = {}}) {}

bool DdsMapService::connected() const {
  return detections_.matched() > 0 && poses_.matched() > 0 && maps_.matched() > 0;
}

std::uint64_t DdsMapService::received() const {
  const std::lock_guard lock(mutex_);
  return received_;
}

void DdsMapService::send(const NextTurn& turn) {
  if (!next_turns_) next_turns_.emplace(participant_);
  next_turns_->write(turn);
}

void DdsMapService::take(PublishedMap&& map) {
  const std::lock_guard lock(mutex_);
  ++received_;
  arrived_ = may_drive_on(map) ? std::move(map.map) : LocalMap{};
}

void DdsMapService::lose() {
  const std::lock_guard lock(mutex_);
  arrived_ = {};
}

const LocalMap& DdsMapService::newest(std::int64_t) {
  const std::lock_guard lock(mutex_);
  newest_ = arrived_;
  return newest_;
}

}  // namespace laneloom::drive
