#pragma once

#include <array>
#include <chrono>
#include <vector>

#include "laneloom/mapper.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::support {

/// Mean, p50, p99 and maximum, by nearest rank. All are 0 if there are no values.
TimeSummary summarise(std::vector<double> values_ms);

/// Measures the mapper's stages, frame by frame.
class StageTimer : public StageObserver {
 public:
  void update_begins() override;
  void stage_done(Stage stage) override;

  /// The times of a stage over all frames. A frame that did not reach it counts with a time of 0.
  TimeSummary stage(Stage stage) const;
  TimeSummary total() const;
  /// Whether any frame reached a stage.
  bool reached(Stage stage) const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point stage_start_;
  std::array<std::vector<double>, kStageCount> stages_ms_;
  std::array<bool, kStageCount> reached_{};
  std::vector<double> total_ms_;
};

}  // namespace laneloom::support
