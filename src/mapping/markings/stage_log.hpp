#pragma once

#include "laneloom/stages.hpp"

namespace laneloom::markings {

/// Tells an observer, if there is one, when an update begins and when its stages end.
class StageLog {
 public:
  explicit StageLog(StageObserver* observer) : observer_(observer) {
    if (observer_ != nullptr) observer_->update_begins();
  }

  /// The place for the reasons of the update. Null: nobody asks.
  FrameReasons* reasons() const { return observer_ != nullptr ? observer_->reasons() : nullptr; }

  void done(Stage stage) const {
    if (observer_ != nullptr) observer_->stage_done(stage);
  }
  /// Reports that the stage ended, and returns its result.
  template <class Result>
  Result done(Stage stage, Result result) const {
    done(stage);
    return result;
  }

 private:
  StageObserver* observer_;
};

}  // namespace laneloom::markings
