#pragma once

#include "laneloom/types.hpp"

namespace laneloom {

/// A line that was cut off from another, or has merged into it.
struct Relative {
  ElementId id = kNoElement, other = kNoElement;
};

}  // namespace laneloom
