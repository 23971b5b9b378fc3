#pragma once

#include <utf8.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "Detections.hpp"
#include "base/fields.hpp"

namespace laneloom::dds {

/// Whether a member is a stamp whose age is sent.
template <class Member, class OfMessage>
inline constexpr bool kIsSentAsAge = std::conjunction_v<std::is_same<Member, std::int64_t>,
                                                        std::is_same<std::remove_cvref_t<OfMessage>, double>>;

/// Takes values out of a message, and remembers the first reason to refuse it.
class Intake {
 public:
  /// `stamp_ns` is the stamp of the message, at which ages are given.
  explicit Intake(std::int64_t stamp_ns = 0) : stamp_ns_(stamp_ns) {}

  double number(double value) {
    if (!std::isfinite(value)) refuse("not_finite");
    return value;
  }
  const std::vector<double>& numbers(const std::vector<double>& values) {
    for (const double value : values) number(value);
    return values;
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
  /// The normalised rotation. It is refused if it is far from unit length.
  Eigen::Quaterniond rotation(const msg::Quaternion& from);

  /// Takes a value of any type that an element of a message has.
  ///@{
  void take(double from, double& to) { to = number(from); }
  template <std::integral Number>
  void take(Number from, Number& to) {
    to = from;
  }
  /// Both enumerations list the same values in the same order.
  template <class MsgEnum, class Enum>
  requires std::is_enum_v<Enum>
  void take(MsgEnum from, Enum& to) {
    const bool is_known = static_cast<std::uint32_t>(from) <= static_cast<std::uint32_t>(kLast<Enum>);
    if (!is_known) refuse("unknown_enum");
    to = is_known ? static_cast<Enum>(from) : kLast<Enum>;
  }
  template <class Text>
  void take(const Text& from, std::string& to) {
    to = from.to_string();
  }
  void take(const msg::Point& from, Point& to) { to = point(from); }
  void take(const msg::Area& from, Polyline& to) { take(from.outline(), to); }
  template <class From, class To>
  void take(const std::vector<From>& from, std::vector<To>& to) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) take(from[i], to[i]);
  }
  template <class From, HasFields To>
  void take(const From& from, To& to) {
    for_each_field<To>([&](const auto& field) { take_member(field, field.of_message(from), to); });
  }
  ///@}

  void refuse(std::string_view reason) {
    if (refusal_.empty()) refusal_ = reason;
  }
  /// The first reason to refuse the message. Empty: there is none.
  std::string_view refusal() const { return refusal_; }

 private:
  template <class To, class Member, class Of>
  void take_member(const Field<To, Member, Of>& field, const auto& from, To& to) {
    Member& member = to.*field.member;
    if constexpr (kIsSentAsAge<Member, decltype(from)>)
      member = number(from) < 0.0 && field.may_be_unknown ? 0 : stamp_before(from);
    else
      take(from, member);
    if constexpr (std::is_same_v<Member, std::vector<double>>) sizes_match(member.size(), to.points.size());
  }
  /// The stamp that was `age_s` before that of the message.
  std::int64_t stamp_before(double age_s);

  std::int64_t stamp_ns_ = 0;
  std::string_view refusal_;
};

}  // namespace laneloom::dds
