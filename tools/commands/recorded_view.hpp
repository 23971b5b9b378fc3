#pragma once

#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "view/frame_store.hpp"

namespace laneloom {

/// Files that a view shows. What is empty is not given.
struct RecordedInputs {
  std::string recording;             ///< all topics (.mcap)
  std::vector<std::string> configs;  ///< maps of the recording's detections by each, in place of its maps
  std::string frames;                ///< in place of a recording
  std::vector<std::string> maps;     ///< likewise, of the same drive
  std::string truth;                 ///< of the road

  bool empty() const { return recording.empty() && frames.empty() && maps.empty(); }
  std::string title() const;
  /// Of the maps that are compared; none: there is one map.
  std::vector<std::string> names() const;
};

/// The elements to draw of the truth, as JSON; none where it is not given. Throws as load_truth().
std::string truth_elements(const RecordedInputs& inputs);

/// Reads the files into the store, and finishes it. Does not throw: the store has the error.
void load(const RecordedInputs& inputs, const RangeConfig& range, FrameStore& store);

}  // namespace laneloom
