#pragma once

#include <array>
#include <chrono>
#include <vector>

#include "laneloom/mapper.hpp"
#include "laneloom/messages.hpp"

namespace laneloom {

/// Measures the mapper's stages, frame by frame.
class StageTimer : public StageObserver {
 public:
  void start_frame();
  void stage_done(Stage stage) override;
  void end_frame();

  /// Over all frames. What a frame did not reach counts as no time.
  TimeSummary stage(Stage stage) const;
  TimeSummary total() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point frame_start_, stage_start_;
  std::array<std::vector<double>, kStageCount> stages_ms_;
  std::vector<double> total_ms_;
};

}  // namespace laneloom
