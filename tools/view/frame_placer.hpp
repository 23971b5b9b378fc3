#pragma once

#include <cstdint>
#include <vector>

#include "view/events.hpp"
#include "view/frame_text.hpp"
#include "view/quality.hpp"

namespace laneloom::view {

/// Gives each moment of a view its place: number, quality and events. Not thread-safe.
class FramePlacer {
 public:
  /// `maps` is the number of maps in each moment. `truth` may be null, and must outlive this.
  explicit FramePlacer(const RangeConfig& range, std::size_t maps = 1,
                       const simulation::Road* truth = nullptr);

  FramePlace next(const ViewMoment& moment);

 private:
  void rate(const ViewMoment& moment, std::vector<MapQuality>& quality);

  std::uint64_t number_ = 0;
  std::vector<QualityMeter> meters_;
  EventFinder events_;
};

}  // namespace laneloom::view
