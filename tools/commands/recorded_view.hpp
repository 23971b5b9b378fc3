#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "simulation/road.hpp"
#include "view/frame_store.hpp"

namespace laneloom::commands {

/// Files that a view shows. An empty name: the file is not given.
struct RecordedInputs {
  std::string recording;             ///< of all topics (.mcap), or a drive without maps, which is mapped
  std::vector<std::string> configs;  ///< each maps the recording's detections, instead of its own maps
  std::string frames;                ///< frames, instead of a recording
  std::vector<std::string> maps;     ///< maps of the same drive, likewise
  std::string truth;                 ///< of the road
  bool strict = false;               ///< the first thing that is wrong is an error
  std::string name{};                ///< of the recording, for people; empty: its path

  bool empty() const { return recording.empty() && frames.empty() && maps.empty(); }
  std::string title() const;
  /// The names of the maps that are seen beside one another, the truth last. Empty: there is one map.
  std::vector<std::string> names() const;
};

/// The elements to draw of the truth beneath each map, as JSON; none if it is null.
std::string truth_elements(const simulation::Road* truth);

/// Reads the files into the store, and finishes it. `truth` may be null. Ends early if a stop is requested,
/// of it or of the program. Does not throw: the store has the error.
void load(const RecordedInputs& inputs, const RangeConfig& range, const simulation::Road* truth,
          view::FrameStore& store, const std::stop_token& stop = {});

}  // namespace laneloom::commands
