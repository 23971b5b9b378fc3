#pragma once

#include "laneloom/types.hpp"

namespace laneloom::markings {

/// A line `id` that was cut off from the line `other`, or has merged into it.
struct Relative {
  ElementId id = kNoElement, other = kNoElement;
};

}  // namespace laneloom::markings
