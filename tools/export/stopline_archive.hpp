#pragma once

#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::exports {

/// The stoplines of a drive. Of several that lie across one lane within 1.5 m, the one with the smallest
/// deviation is kept. Not thread-safe.
class StoplineArchive {
 public:
  /// Adds a stopline. It must be in the map frame and have a length.
  void add(const Marking& stopline);
  const std::vector<Marking>& markings() const { return markings_; }

 private:
  std::vector<Marking> markings_;
};

}  // namespace laneloom::exports
