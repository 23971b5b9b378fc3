#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "base/seconds.hpp"
#include "cdr/intake.hpp"

/// Parts that several messages share.
namespace laneloom::dds {

/// The beginning of a text, of at most `bytes` bytes. No character of UTF-8 is cut.
std::string beginning(const std::string& text, std::size_t bytes);
msg::Pose pose_to_msg(const Point& position, const Eigen::Quaterniond& orientation);
msg::Header header_to_msg(std::int64_t stamp_ns, std::uint64_t sequence, std::uint64_t session_id,
                          const std::string& frame_id);

/// Puts values into a message: values of any type that an element of a message has. Text is cut to its bound.
struct ToMessage {
  std::int64_t stamp_ns = 0;  ///< of the message; ages are given at it

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void put(Number from, Number& to) const { to = from; }
  /// Both enumerations list the same values in the same order.
  template <class Enum, class MsgEnum>
  requires std::is_enum_v<Enum>
  void put(Enum from, MsgEnum& to) const { to = static_cast<MsgEnum>(from); }
  template <class Text>
  void put(const std::string& from, Text& to) const {
    to = beginning(from, Text::max_size).c_str();
  }
  static void put(const Point& from, msg::Point& to) {
    to.x(from.x());
    to.y(from.y());
    to.z(from.z());
  }
  void put(const Polyline& from, msg::Area& to) const { put(from, to.outline()); }
  template <class From, class To>
  void put(const std::vector<From>& from, std::vector<To>& to) const {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) put(from[i], to[i]);
  }
  template <HasFields From, class To>
  void put(const From& from, To& to) const {
    for_each_field<From>([&]<class Member, class Of>(const Field<From, Member, Of>& field) {
      const Member& member = from.*field.member;
      auto& sent = field.of_message(to);
      if constexpr (kIsSentAsAge<Member, decltype(sent)>)
        sent = member == 0 && field.may_be_unknown ? -1.0 : seconds(stamp_ns - member);
      else
        put(member, sent);
    });
  }
};

}  // namespace laneloom::dds
