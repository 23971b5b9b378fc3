#pragma once

#include <cstddef>
#include <vector>

#include "export/driven_places.hpp"
#include "export/votes.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// The stoplines of drives. Several that lie across one lane within 1.5 m are one: that with the smallest
/// deviation, at the mean of their places along the lane, weighed by their deviations. Not thread-safe.
class StoplineArchive {
 public:
  struct Entry {
    Marking marking;
    MeasuredPolyline course;
    double weight = 0.0;  ///< 1 / m^2, of the place
    Votes votes;
  };

  /// Adds a stopline of a drive. It must be in the map frame and have a length.
  void add(const Marking& stopline, std::size_t drive, const DrivenPlaces& before);
  /// Counts as unseen what a drive passed and did not see.
  void end_drive(std::size_t drive, const DrivenPlaces& places);
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace laneloom::exports
