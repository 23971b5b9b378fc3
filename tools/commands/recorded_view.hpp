#pragma once

#include <string>

#include "laneloom/config.hpp"
#include "view/frame_store.hpp"

namespace laneloom {

/// Files that a view shows. What is empty is not given.
struct RecordedInputs {
  std::string recording;     ///< all topics (.mcap)
  std::string frames, maps;  ///< in place of a recording: either or both
  std::string truth;         ///< of the road

  bool empty() const { return recording.empty() && frames.empty() && maps.empty(); }
  std::string title() const;
};

/// The elements to draw of the truth, as JSON; none where it is not given. Throws as load_truth().
std::string truth_elements(const RecordedInputs& inputs);

/// Reads the files into the store, and finishes it. Does not throw: the store has the error.
void load(const RecordedInputs& inputs, const RangeConfig& range, FrameStore& store);

}  // namespace laneloom
