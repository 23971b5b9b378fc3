#include "view/frame_placer.hpp"

namespace laneloom::view {

FramePlacer::FramePlacer(const RangeConfig& range, std::size_t maps, const simulation::Road* truth)
    : meters_(maps, QualityMeter(range, truth)) {}

FramePlace FramePlacer::next(const ViewMoment& moment) {
  FramePlace place{.number = number_++};
  if (!moment.repeated) rate(moment, place.quality);
  place.events = events_.next(moment, place.quality.empty() ? nullptr : &place.quality.front());
  return place;
}

void FramePlacer::rate(const ViewMoment& moment, std::vector<MapQuality>& quality) {
  const DetectionFrame* detections = moment.detections ? &*moment.detections : nullptr;
  for (std::size_t i = 0; i < meters_.size(); ++i)
    quality.push_back(meters_[i].next(i == 0 ? moment.map.map : moment.others.at(i - 1), detections));
}

}  // namespace laneloom::view
