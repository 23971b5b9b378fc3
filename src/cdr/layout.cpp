#include "cdr/layout.hpp"

#include <string>
#include <type_traits>
#include <vector>

#include "cdr/bounds.hpp"

namespace laneloom::dds {
namespace {

constexpr std::size_t kEnum = 4;
constexpr std::size_t kLong = 4;
constexpr std::size_t kLongLong = 8;
constexpr std::size_t kDouble = 8;
constexpr std::size_t kTextBound = std::remove_cvref_t<decltype(msg::Header().frame_id())>::max_size;
constexpr std::size_t kValueBound = std::remove_cvref_t<decltype(msg::Setting().value())>::max_size;

void header(CdrScanner& cdr) {
  cdr.numbers(kLongLong);
  cdr.numbers(kLong);
  cdr.numbers(kLongLong, 3);
  cdr.text(kTextBound);
}

void pose(CdrScanner& cdr) { cdr.numbers(kDouble, 7); }

/// The layout in CDR of a value of this type. A stamp is as long as the age that is sent for it.
template <class Value>
struct Layout {
  static void scan(CdrScanner& cdr) {
    if constexpr (HasFields<Value>)
      for_each_field<Value>([&]<class Struct, class Member, class Of>(const Field<Struct, Member, Of>&) {
        Layout<Member>::scan(cdr);
      });
    else
      cdr.numbers(std::is_enum_v<Value> ? kEnum : sizeof(Value));
  }
};
template <>
struct Layout<std::string> {
  static void scan(CdrScanner& cdr) { cdr.text(kTextBound); }
};
template <>
struct Layout<Point> {
  static void scan(CdrScanner& cdr) { cdr.numbers(kDouble, 3); }
};
template <class Element>
struct Layout<std::vector<Element>> {
  static void scan(CdrScanner& cdr) { cdr.sequence(kMaxLength<Element>, Layout<Element>::scan); }
};
// The long lists are skipped in one step.
template <>
struct Layout<Polyline> {
  static void scan(CdrScanner& cdr) { cdr.double_sequence(3, kMaxLength<Point>); }
};
template <>
struct Layout<std::vector<double>> {
  static void scan(CdrScanner& cdr) { cdr.double_sequence(1, kMaxLength<double>); }
};

template <class... Values>
void values(CdrScanner& cdr) {
  (Layout<Values>::scan(cdr), ...);
}

void counter(CdrScanner& cdr) {
  cdr.text(kTextBound);
  cdr.numbers(kLongLong);
}

void source(CdrScanner& cdr) {
  cdr.text(kTextBound);
  cdr.numbers(kLongLong, 5);
  cdr.numbers(kDouble);
  cdr.sequence(msg::MAX_VALUES, [](CdrScanner& value) {
    value.text(kTextBound);
    value.numbers(kDouble);
  });
}

void setting(CdrScanner& cdr) {
  cdr.text(kTextBound);
  cdr.text(kValueBound);
}

}  // namespace

void scan(CdrScanner& cdr, const msg::Detections* /*type*/) {
  header(cdr);
  values<std::string, std::vector<MarkingType>, Polyline, std::vector<Polyline>, std::vector<Detection>>(cdr);
}

void scan(CdrScanner& cdr, const msg::VehiclePose* /*type*/) {
  header(cdr);
  pose(cdr);
  cdr.number_sequence(kDouble, 36);
}

void scan(CdrScanner& cdr, const msg::Objects* /*type*/) {
  header(cdr);
  values<std::vector<TrackedObject>>(cdr);
}

void scan(CdrScanner& cdr, const msg::NextTurn* /*type*/) {
  header(cdr);
  values<NextTurn>(cdr);
}

void scan(CdrScanner& cdr, const msg::LaneMap* /*type*/) {
  header(cdr);
  cdr.numbers(kLongLong, 2);
  cdr.numbers(kDouble, 2);
  values<MapState, std::vector<StateReason>>(cdr);
  pose(cdr);
  values<std::vector<FusedFrame>, std::vector<Marking>, std::vector<Lane>, std::vector<Stopline>,
         std::vector<Linkage>, Way, std::vector<DrivenPath>, std::vector<LineageEvent>>(cdr);
}

void scan(CdrScanner& cdr, const msg::RoadMarkings* /*type*/) {
  header(cdr);
  values<std::vector<Marking>>(cdr);
}

void scan(CdrScanner& cdr, const msg::ServiceStatus* /*type*/) {
  header(cdr);
  values<MapState, std::vector<StateReason>>(cdr);
  cdr.numbers(kDouble, 11);
  cdr.numbers(kLong);
  cdr.sequence(msg::MAX_COUNTERS, counter);
  cdr.sequence(msg::MAX_SOURCES, source);
  cdr.text(kTextBound);
  cdr.text(kTextBound);
  cdr.sequence(msg::MAX_SETTINGS, setting);
}

}  // namespace laneloom::dds
