#include "drawing/drawing.hpp"

#include <algorithm>
#include <utility>

namespace laneloom::drawing {

void Drawing::add(Element element) {
  if (element.shapes.empty()) return;
  const auto behind = std::upper_bound(elements_.begin(), elements_.end(), element.layer,
                                       [](Layer layer, const Element& other) { return layer < other.layer; });
  elements_.insert(behind, std::move(element));
}

}  // namespace laneloom::drawing
