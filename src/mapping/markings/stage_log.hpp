#pragma once

#include "laneloom/stages.hpp"

namespace laneloom {

/// Tells an observer of an update's begin and of its stages' ends; nobody, where there is no observer.
class StageLog {
 public:
  explicit StageLog(StageObserver* observer) : observer_(observer) {
    if (observer_ != nullptr) observer_->update_begins();
  }

  void done(Stage stage) const {
    if (observer_ != nullptr) observer_->stage_done(stage);
  }
  /// Passes on what the stage made.
  template <class Result>
  Result done(Stage stage, Result result) const {
    done(stage);
    return result;
  }

 private:
  StageObserver* observer_;
};

}  // namespace laneloom
