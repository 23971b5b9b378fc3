#pragma once

#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// The stoplines of a drive, each as it was known best. Of those that lie across one lane within 1.5 m, one
/// is kept: the one with the smallest deviation. Not thread-safe.
class StoplineArchive {
 public:
  /// `stopline` is in the map frame and has a length.
  void add(const Marking& stopline);
  const std::vector<Marking>& markings() const { return markings_; }

 private:
  std::vector<Marking> markings_;
};

}  // namespace laneloom
