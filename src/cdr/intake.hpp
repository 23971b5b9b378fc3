#pragma once

#include <utf8.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "Common.h"
#include "laneloom/types.hpp"

namespace laneloom::dds {

/// Takes values out of a message, and remembers the first reason to refuse it.
class Intake {
 public:
  double number(double value) {
    if (!std::isfinite(value)) refuse("not_finite");
    return value;
  }
  const std::vector<double>& numbers(const std::vector<double>& values) {
    for (const double value : values) number(value);
    return values;
  }
  /// `last` is the largest value of the enumeration. Both enumerations list the same values in the same
  /// order.
  template <class To, class From>
  To enumeration(From value, To last) {
    if (static_cast<std::uint32_t>(value) > static_cast<std::uint32_t>(last)) {
      refuse("unknown_enum");
      return last;
    }
    return static_cast<To>(value);
  }
  /// Text is published on, and readers may refuse a string that is not UTF-8.
  std::string text(std::string from) {
    if (!utf8::is_valid(from.begin(), from.end())) refuse("not_text");
    return from;
  }
  /// There must be one value per point, or no values at all.
  void sizes_match(std::size_t values, std::size_t points) {
    if (values != 0 && values != points) refuse("wrong_size");
  }

  Point point(const msg::Point& from);
  Polyline polyline(const std::vector<msg::Point>& from);
  /// The normalised rotation. It is refused if it is far from unit length.
  Eigen::Quaterniond rotation(const msg::Quaternion& from);
  laneloom::Stretch range(const msg::Range& from) { return {number(from.from_m()), number(from.to_m())}; }

  void refuse(std::string_view reason) {
    if (refusal_.empty()) refusal_ = reason;
  }
  /// The first reason to refuse the message. Empty: there is none.
  std::string_view refusal() const { return refusal_; }

 private:
  std::string_view refusal_;
};

}  // namespace laneloom::dds
