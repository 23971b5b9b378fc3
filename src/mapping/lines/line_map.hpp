#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/geometry/point_grid.hpp"
#include "mapping/lines/lateral_filter.hpp"
#include "mapping/lines/network_model.hpp"
#include "mapping/markings/markings.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom::lines {

/// How a frame saw a place on a line.
enum class Sight : std::uint8_t { out_of_view, missed, observed };

/// A place on a line, about a metre from the next, with the knowledge of the line there.
struct Station {
  Point position = Point::Zero();                      ///< map frame
  LateralFilter lateral;                               ///< estimate of the position across the line
  double log_odds = 0.0;                               ///< that the line is there, by how often it was seen
  std::array<double, kMarkingTypeCount> type_votes{};  ///< one vote per independent view
  markings::StyleVotes style_votes{};                  ///< one vote per independent view
  double moved_m = 0.0;                                ///< to the left, since the station was made
  std::array<FarView, NetworkModel::kNodes_m.size()> far_views{};  ///< the first view at each range
  Sight sight = Sight::out_of_view;                                ///< in the present frame; not saved

  template <class Archive>
  void serialize(Archive& archive) {
    archive(position, lateral, log_odds, type_votes, style_votes, moved_m, far_views);
  }
};

/// How the present frame saw a stretch: as most of its stations that are in view. Out of view: all of them
/// are.
Sight sight_of(std::span<const Station> stretch);

/// How the present frame showed two lines, `a` with the smaller id.
markings::PairSighting sighting_of(ElementId a, Sight a_sight, ElementId b, Sight b_sight);

/// The beliefs in the detections of a line, see DetectionModel::belief().
struct Beliefs {
  double count = 0.0;  ///< number of independent views
  double mean = 0.0;

  void add(double belief, double news) {
    count += news;
    mean += news / count * (belief - mean);
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(count, mean);
  }
};

/// A marking that is followed over time.
struct Line {
  ElementId id = kNoElement;
  std::vector<Station> stations;   ///< in order along the line
  std::uint64_t observations = 0;  ///< number of detections that observed it
  std::int64_t first_seen_ns = 0;  ///< stamp of the frame that made it
  std::int64_t last_seen_ns = 0;   ///< stamp of the newest frame that observed it
  Beliefs beliefs{};

  /// The type with most votes of all stations; of equals, the first one.
  MarkingType type() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, stations, observations, first_seen_ns, last_seen_ns, beliefs);
  }
};

/// Lets a line run the other way: what was left of it is right of it then.
void reverse(Line& line);

/// Whether a type is matched apart from the others. Stoplines are, because they cross the others; lanelines
/// and roadedges are told apart by vote.
inline bool is_stopline(MarkingType type) { return type == MarkingType::stopline; }

/// The foot of a point on a line.
struct StationFoot {
  double index = 0.0;      ///< place between stations: 2.5 is halfway between the third and the fourth
  double lateral_m = 0.0;  ///< distance of the point; left of the line is positive
  double height_m = 0.0;   ///< of the point above the foot
  bool inside = false;     ///< the foot is not beyond one of the line's ends
};

/// The foot of `point` on the two segments at station `nearest`. The line has at least two stations.
StationFoot foot_at(const Line& line, std::size_t nearest, const Point& point);

/// The station nearest to a place between stations that is not negative, of two the second one. It is what
/// std::lround() says, which is a call.
inline std::size_t nearest_station(double index) {
  const auto before = static_cast<std::size_t>(index);
  return index - static_cast<double>(before) < 0.5 ? before : before + 1;
}

/// Horizontal unit direction of the line at a station.
Eigen::Vector2d direction_at(const Line& line, std::size_t station);

/// The positions and directions of a line's stations, for quick repeated searches of feet. The line has at
/// least two stations. It is copied.
class Course {
 public:
  explicit Course(const Line& line);

  std::size_t size() const { return places_.size(); }
  /// The same as foot_at() of the line.
  StationFoot foot(std::size_t nearest, const Point& point) const;
  /// The same as direction_at() of the line.
  const Eigen::Vector2d& direction(std::size_t station) const { return places_[station].direction; }

 private:
  /// A station, reduced to what Course::foot() needs.
  struct Place {
    Point position;
    Eigen::Vector2d direction;
  };
  std::vector<Place> places_;
};

/// A station, reduced to what searches need.
struct StationPlace {
  Point position = Point::Zero();  ///< map frame
  std::uint32_t line = 0;          ///< index of its line
  std::uint32_t station = 0;       ///< index in that line
};

/// Finds the stations of one instant by place.
using StationGrid = geometry::PointGrid<StationPlace>;

/// The stations of all lines.
StationGrid station_grid(const std::vector<Line>& lines);

}  // namespace laneloom::lines
