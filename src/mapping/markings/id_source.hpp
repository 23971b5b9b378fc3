#pragma once

#include "laneloom/types.hpp"

namespace laneloom::markings {

/// Gives out ids, each once, in ascending order.
class IdSource {
 public:
  explicit IdSource(ElementId first = kNoElement + 1) : next_(first) {}

  ElementId next() { return next_++; }

  /// Leaves out more ids than a service can give out between a snapshot and its end.
  void leave_out_unknown() { next_ += ElementId{1} << 24; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(next_);
  }

 private:
  ElementId next_;
};

}  // namespace laneloom::markings
