#include "simulation/opendrive_road.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"
#include "simulation/borders.hpp"
#include "simulation/opendrive_line.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kSectionStep_m = 1.0;
constexpr double kLeastWidth_m = 0.5;   // of a lane, where it is widest
constexpr double kLeastLength_m = 0.1;  // of a lane or a mark
constexpr double kNoWidth_m = 0.03;     // width of a lane that is none
constexpr double kSameStation_m = 1e-6;
constexpr double kMarkedShare = 0.8;    // of a border that is marked, at least
constexpr std::size_t kMostLanes = 64;  // of one side
constexpr std::array kVehicleLanes{"driving",        "entry",    "exit",         "onRamp", "offRamp",
                                   "connectingRamp", "slipLane", "bus",          "taxi",   "HOV",
                                   "mwyEntry",       "mwyExit",  "bidirectional"};
constexpr std::array kOtherPavedLanes{"shoulder", "stop", "parking", "biking", "tram", "roadWorks"};

bool is_one_of(const auto& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// A part of a lane section: its lanes on one side, or its centre lane.
struct Part {
  pugi::xml_node element{};
  double from_m = 0.0;  ///< begin of the section, from which its offsets count
};

/// A lane of a lane section: between `inner` and the border that is farther from the centre lane.
struct Strip {
  int id = 0;
  std::string_view type{};
  std::vector<double> inner_m{}, outer_m{};  ///< to the left of the reference line, at each station
  Part lane{};

  bool is_for_vehicles() const { return is_one_of(kVehicleLanes, type); }
  bool is_paved() const { return is_for_vehicles() || is_one_of(kOtherPavedLanes, type); }
  double widest_m() const {
    double result_m = 0.0;
    for (std::size_t i = 0; i < inner_m.size(); ++i)
      result_m = std::max(result_m, std::abs(outer_m[i] - inner_m[i]));
    return result_m;
  }
  bool is_wide() const { return widest_m() >= kLeastWidth_m; }
  bool is_there() const { return widest_m() > kNoWidth_m; }
};

/// Whether what is paved lies on either side of the outer border of a side's strip. A strip that has no width
/// hides nothing.
bool touches_pavement(const std::vector<Strip>& side, std::size_t i) {
  const auto next = std::find_if(side.begin() + static_cast<std::ptrdiff_t>(i) + 1, side.end(),
                                 std::mem_fn(&Strip::is_there));
  return side[i].is_paved() || (next != side.end() && next->is_paved());
}

/// The stations of a lane section along the reference line: every metre or less, and where marks begin.
std::vector<double> section_stations(double from_m, double to_m, std::vector<double> mark_begins_m) {
  std::vector<double> result{from_m};
  const auto go_on_to = [&](double end_m) {
    const double begin_m = result.back();
    const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil((end_m - begin_m) / kSectionStep_m)));
    for (std::size_t i = 1; i <= steps; ++i)
      result.push_back(begin_m + (end_m - begin_m) * static_cast<double>(i) / static_cast<double>(steps));
  };
  std::ranges::sort(mark_begins_m);
  for (const double begin_m : mark_begins_m)
    if (begin_m - result.back() >= kLeastLength_m && to_m - begin_m >= kLeastLength_m) go_on_to(begin_m);
  go_on_to(to_m);
  return result;
}

/// Reads one road into the truth.
class RoadReader {
 public:
  RoadReader(const pugi::xml_node& element, LengthLimit& limit)
      : element_(element),
        limit_(limit),
        line_(element),
        lane_offset_(element, element.child("lanes"), "laneOffset", "s"),
        in_junction_(std::string_view(element.attribute("junction").as_string("-1")) != "-1"),
        right_hand_(std::string_view(element.attribute("rule").as_string("RHT")) != "LHT") {}

  Road read() && {
    const double length_m = line_.length_m();
    std::multimap<double, pugi::xml_node> sections;  // by their begin
    for (const pugi::xml_node& section : element_.child("lanes").children("laneSection"))
      sections.emplace(std::clamp(number(element_, section, "s"), 0.0, length_m), section);
    for (auto section = sections.begin(); section != sections.end(); ++section) {
      const double from_m = section->first;
      take_parts(section->second, from_m);
      const auto next = std::next(section);
      to_m_ = next == sections.end() ? length_m : next->first;
      if (to_m_ - from_m < kLeastLength_m) continue;
      stations_ = section_stations(from_m, to_m_, mark_begins());
      read_section();
    }
    for (const pugi::xml_node& object : element_.child("objects").children("object")) read_object(object);
    road_.right_hand_traffic = right_hand_;
    return std::move(road_);
  }

 private:
  /// Takes the parts of a section. If it is of a single side, that of the other side goes on.
  void take_parts(const pugi::xml_node& section, double from_m) {
    const bool single = section.attribute("singleSide").as_bool();
    if (!single || section.child("left")) left_ = {section.child("left"), from_m};
    if (!single || section.child("right")) right_ = {section.child("right"), from_m};
    centre_ = {section.child("center").child("lane"), from_m};
  }

  /// Reads the stretch on which all parts stay the same.
  void read_section() {
    std::vector<double> centre_m;
    for (const double s_m : stations_) centre_m.push_back(lane_offset_.at(s_m));
    line(centre_m);  // for its length, which is limited
    add_marks(centre_, centre_m);
    const std::vector<Strip> left = strips(left_, centre_m);
    const std::vector<Strip> right = strips(right_, centre_m);
    for (const std::vector<Strip>* side : {&left, &right})
      for (std::size_t i = 0; i < side->size(); ++i)
        if ((*side)[i].is_there() && touches_pavement(*side, i))
          add_marks((*side)[i].lane, (*side)[i].outer_m);
    add_edges(borders(left, right, centre_m));
    for (const std::vector<Strip>* side : {&left, &right})
      for (const Strip& strip : *side)
        if (strip.is_for_vehicles() && strip.is_wide()) add_lane(strip);
    lines_.clear();
  }

  /// Where marks begin, along the reference line.
  std::vector<double> mark_begins() const {
    std::vector<double> begins_m;
    const auto add_begins = [&](const pugi::xml_node& lane, double from_m) {
      for (const pugi::xml_node& mark : lane.children("roadMark"))
        begins_m.push_back(from_m + number_or(element_, mark, "sOffset", 0.0));
    };
    add_begins(centre_.element, centre_.from_m);
    for (const Part& side : {left_, right_})
      for (const pugi::xml_node& lane : side.element.children("lane")) add_begins(lane, side.from_m);
    return begins_m;
  }

  /// The lanes of a side, from the centre outwards.
  std::vector<Strip> strips(const Part& side, const std::vector<double>& centre_m) const {
    std::map<int, pugi::xml_node> lanes;  // by their number from the centre
    for (const pugi::xml_node& lane : side.element.children("lane"))
      if (const int id = lane.attribute("id").as_int(); id != 0) lanes[std::abs(id)] = lane;
    if (lanes.size() > kMostLanes) refuse(element_, "has more than 64 lanes on one side");
    std::vector<Strip> result;
    std::vector<double> inner_m = centre_m;
    for (const auto& [number, lane] : lanes) {
      Strip strip{.id = lane.attribute("id").as_int(),
                  .type = lane.attribute("type").as_string(),
                  .lane = {lane, side.from_m}};
      const double sign = strip.id > 0 ? 1.0 : -1.0;
      const Cubics widths(element_, lane, "width", "sOffset"), borders(element_, lane, "border", "sOffset");
      for (std::size_t i = 0; i < stations_.size(); ++i) {
        const double at_m = stations_[i] - side.from_m;
        const double width_m = widths.empty() && !borders.empty()
                                   ? sign * (borders.at(at_m) + centre_m[i] - inner_m[i])
                                   : widths.at(at_m);
        strip.inner_m.push_back(inner_m[i]);
        strip.outer_m.push_back(inner_m[i] + sign * std::max(0.0, width_m));
      }
      inner_m = strip.outer_m;
      result.push_back(std::move(strip));
    }
    return result;
  }

  /// The line along stations `first` to `last`.
  Polyline line(const std::vector<double>& left_m, std::size_t first, std::size_t last) {
    Polyline points;
    for (std::size_t i = first; i <= last; ++i) points.push_back(line_.point(stations_[i], left_m[i]));
    if (!limit_.add(points)) refuse(element_, LengthLimit::kComplaint);
    return points;
  }
  Polyline line(const std::vector<double>& left_m) { return line(left_m, 0, left_m.size() - 1); }

  /// What lies on a border, from one station to another.
  struct Line {
    ElementId marking = kNoElement;
    const std::vector<double>* left_m = nullptr;
    std::size_t first = 0, last = 0;
    bool is_on(const std::vector<double>& border_m) const {
      const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(last) + 1;
      return std::equal(left_m->begin() + from, left_m->begin() + to, border_m.begin() + from);
    }
  };

  /// The longest marking on a border, if the border is marked nearly everywhere.
  ElementId marking_on(const std::vector<double>& border_m) const {
    ElementId longest = kNoElement;
    double longest_m = 0.0, marked_m = 0.0;
    for (const Line& line : lines_) {
      if (!line.is_on(border_m)) continue;
      const double length_m = stations_[line.last] - stations_[line.first];
      marked_m += length_m;
      if (length_m <= longest_m) continue;
      longest_m = length_m;
      longest = line.marking;
    }
    return marked_m >= kMarkedShare * (stations_.back() - stations_.front()) ? longest : kNoElement;
  }

  void add_lane(const Strip& strip) {
    const bool reversed =
        std::string_view(strip.lane.element.attribute("direction").as_string()) == "reversed";
    const bool against = ((strip.id < 0) != right_hand_) != reversed;
    // The borders on the left and on the right of someone who looks along the reference line.
    const std::vector<double>& left_m = strip.id > 0 ? strip.outer_m : strip.inner_m;
    const std::vector<double>& right_m = strip.id > 0 ? strip.inner_m : strip.outer_m;
    Polyline left = line(left_m), right = line(right_m);
    ElementId left_marking = marking_on(left_m), right_marking = marking_on(right_m);
    if (against) {
      std::swap(left, right);
      std::swap(left_marking, right_marking);
      std::ranges::reverse(left);
      std::ranges::reverse(right);
    }
    if (length(left) < kLeastLength_m || length(right) < kLeastLength_m) return;
    Polyline centerline = midway(left, right);
    road_.lanes.push_back({.id = road_.lanes.size() + 1,
                           .left = std::move(left),
                           .right = std::move(right),
                           .centerline = std::move(centerline),
                           .left_marking = left_marking,
                           .right_marking = right_marking,
                           .in_intersection = in_junction_});
  }

  /// Adds the marks of a lane, which lie on its outer border.
  void add_marks(const Part& lane, const std::vector<double>& left_m) {
    std::vector<pugi::xml_node> marks;
    for (const pugi::xml_node& mark : lane.element.children("roadMark")) marks.push_back(mark);
    const auto begin_of = [&](std::size_t i) { return lane.from_m + number(element_, marks[i], "sOffset"); };
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const double begin_m = begin_of(i), end_m = i + 1 < marks.size() ? begin_of(i + 1) : to_m_;
      const std::size_t first = nearest_station(begin_m), last = nearest_station(end_m);
      if (first < last) add_mark(marks[i].attribute("type").as_string(), left_m, first, last);
    }
  }

  std::size_t nearest_station(double s_m) const {
    const auto next = std::ranges::lower_bound(stations_, s_m);
    if (next == stations_.begin()) return 0;
    const auto index = static_cast<std::size_t>(next - stations_.begin());
    return next == stations_.end() || s_m - stations_[index - 1] < *next - s_m ? index - 1 : index;
  }

  void add_mark(std::string_view type, const std::vector<double>& left_m, std::size_t first,
                std::size_t last) {
    if (type.empty() || type == "none") return;
    RoadMarking mark{.points = line(left_m, first, last)};
    if (length(mark.points) < kLeastLength_m) return;
    const bool solid = type.find("solid") != std::string_view::npos;
    const bool broken = type.find("broken") != std::string_view::npos || type == "botts dots";
    if (type == "curb" || type == "edge" || type == "grass") mark.type = MarkingType::roadedge;
    if (solid != broken) mark.style = solid ? MarkingStyle::solid : MarkingStyle::dashed;
    if (mark.type == MarkingType::roadedge) mark.style = MarkingStyle::solid;
    add(std::move(mark));
    lines_.push_back({road_.markings.back().id, &left_m, first, last});
  }

  /// A border between two lanes, or at the side of the road.
  struct Border {
    const std::vector<double>* left_m;
    Part lane;                  ///< whose marks lie on it
    const Strip* beyond;        ///< the lane to its right; null: none
    std::vector<bool> is_edge;  ///< of what is paved, at each station
  };

  std::vector<Border> borders(const std::vector<Strip>& left, const std::vector<Strip>& right,
                              const std::vector<double>& centre_m) const {
    std::vector<Border> result;
    for (auto strip = left.rbegin(); strip != left.rend(); ++strip)
      result.push_back({&strip->outer_m, strip->lane, &*strip, {}});
    result.push_back({&centre_m, centre_, nullptr, {}});
    for (const Strip& strip : right) {
      result.back().beyond = &strip;
      result.push_back({&strip.outer_m, strip.lane, nullptr, {}});
    }
    return result;
  }

  std::string_view mark_at(const Part& lane, double s_m) const {
    std::string_view type = "none";
    for (const pugi::xml_node& mark : lane.element.children("roadMark"))
      if (lane.from_m + number(element_, mark, "sOffset") <= s_m + kSameStation_m)
        type = mark.attribute("type").as_string();
    return type;
  }

  /// Adds the edges of what is paved, where they have no mark.
  void add_edges(std::vector<Border> all) {
    if (in_junction_) return;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      bool paved = false;
      for (Border& border : all) {
        const Strip* strip = border.beyond;
        const bool is_there =
            strip == nullptr || std::abs(strip->outer_m[i] - strip->inner_m[i]) > kNoWidth_m;
        const bool next_is_paved = is_there ? strip != nullptr && strip->is_paved() : paved;
        border.is_edge.push_back(next_is_paved != paved && mark_at(border.lane, stations_[i]) == "none");
        paved = next_is_paved;
      }
    }
    for (const Border& border : all) add_edge(border);
  }

  /// Adds the stretches of a border that are edges, each with the station before and behind, where an island
  /// is closed.
  void add_edge(const Border& border) {
    const std::size_t last = stations_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      if (!border.is_edge[i]) continue;
      const std::size_t first = i, begin = i > 0 ? i - 1 : 0;
      while (i < last && border.is_edge[i + 1]) ++i;
      if (i == first) continue;  // where a lane begins or ends with no width
      const std::size_t end = std::min(last, i + 1);
      add({.type = MarkingType::roadedge,
           .style = MarkingStyle::solid,
           .points = line(*border.left_m, begin, end)});
      lines_.push_back({road_.markings.back().id, border.left_m, begin, end});
    }
  }

  /// Adds an object if it is a stop line.
  void read_object(const pugi::xml_node& object) {
    if (std::string_view(object.attribute("type").as_string()) != "roadMark") return;
    const std::string_view name = object.attribute("name").as_string();
    if (std::string_view(object.attribute("subtype").as_string()) != "signalLines" &&
        name.find("StopLine") == std::string_view::npos)
      return;
    Frame frame = line_.at(number(element_, object, "s")).moved(number(element_, object, "t"));
    frame.heading_rad += number_or(element_, object, "hdg", 0.0);
    const double half_m = 0.5 * number(element_, object, "width");
    if (2.0 * half_m < kLeastLength_m) return;
    add({.type = MarkingType::stopline,
         .style = MarkingStyle::solid,
         .points = {frame.moved(-half_m).position, frame.moved(half_m).position}});
  }

  void add(RoadMarking marking) {
    marking.id = road_.markings.size() + 1;
    road_.markings.push_back(std::move(marking));
  }

  const pugi::xml_node& element_;
  LengthLimit& limit_;
  Road road_;
  ReferenceLine line_;
  Cubics lane_offset_;
  bool in_junction_, right_hand_;
  Part left_, right_, centre_;
  double to_m_ = 0.0;  ///< end of the stretch
  std::vector<double> stations_;
  std::vector<Line> lines_;  ///< of the stretch
};

}  // namespace

Road read_opendrive_road(const pugi::xml_node& element, LengthLimit& limit) {
  return RoadReader(element, limit).read();
}

}  // namespace laneloom::simulation
