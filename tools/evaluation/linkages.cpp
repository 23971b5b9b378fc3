#include "evaluation/linkages.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "evaluation/lane_chains.hpp"
#include "evaluation/sample_grid.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

constexpr double kStoplineGap_m = 3.0;
constexpr double kLevel_m = 2.0;         // a lane on a bridge does not end at a stopline below it
constexpr std::size_t kEndSamples = 50;  // 5 m

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

Polyline prolonged(Polyline line) {
  const Eigen::Vector2d leaving = kStoplineGap_m * end_direction(line, End::back);
  line.push_back(line.back() + Point(leaving.x(), leaving.y(), 0.0));
  return line;
}

/// The chains that follow `lane`, directly or across lanes that are in no chain.
std::set<std::size_t> following(const simulation::RoadLane& lane,
                                const std::map<ElementId, const simulation::RoadLane*>& lanes,
                                const std::map<ElementId, std::size_t>& chain_of) {
  std::set<std::size_t> chains;
  std::set<ElementId> passed;
  std::vector<ElementId> open = lane.successors;
  while (!open.empty()) {
    const ElementId id = open.back();
    open.pop_back();
    const auto chain = chain_of.find(id);
    if (chain != chain_of.end()) {
      chains.insert(chain->second);
    } else if (lanes.contains(id) && passed.insert(id).second) {
      const std::vector<ElementId>& next = lanes.at(id)->successors;
      open.insert(open.end(), next.begin(), next.end());
    }
  }
  return chains;
}

/// The place of a published lane.
struct LanePlace {
  std::size_t truth = 0;  ///< index of the truth lane
  double from_m = 0.0;    ///< its beginning, along the truth lane's piece in range
  double to_m = 0.0;      ///< its end, likewise
  bool reversed() const { return to_m < from_m; }
};

class LaneFinder {
 public:
  explicit LaneFinder(const std::vector<LinePiece>& truths)
      : truths_(truths), grid_(samples(truths), kMatchDistance_m) {}

  std::optional<LanePlace> place(const LinePiece& piece, Lane::Direction direction) const {
    std::optional<std::tuple<std::size_t, double>> best;  // samples, minus their mean distance
    std::optional<LanePlace> place;
    const auto near = grid_.nearness(piece.samples);
    for (std::size_t i = 0; i < truths_.size(); ++i) {
      const auto count = static_cast<double>(near[i].count);
      if (near[i].count == 0 || count < kMatchShare * static_cast<double>(piece.samples.size())) continue;
      const std::tuple rank{near[i].count, -near[i].distances_m / count};
      if (best && rank <= *best) continue;
      const MeasuredPolyline truth(truths_[i].points);
      const LanePlace candidate{truths_[i].line, truth.project(piece.points.front()).arc_m,
                                truth.project(piece.points.back()).arc_m};
      if (!may_run(direction, candidate.reversed())) continue;
      best = rank;
      place = candidate;
    }
    return place;
  }

 private:
  static std::vector<Polyline> samples(const std::vector<LinePiece>& pieces) {
    std::vector<Polyline> all;
    all.reserve(pieces.size());
    for (const LinePiece& piece : pieces) all.push_back(piece.samples);
    return all;
  }

  const std::vector<LinePiece>& truths_;
  SampleGrid grid_;
};

/// The published lanes in range, each with its longest piece there.
using LanePieces = std::vector<std::pair<const Lane*, LinePiece>>;

LanePieces lane_pieces(const LocalMap& map, const RangeConfig& range) {
  const Eigen::Isometry3d T_body_map = map.T_map_body.inverse();
  LanePieces lanes;
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    auto longest = longest_piece_in_range(map.lanes[i].centerline, i, T_body_map, range);
    if (longest) lanes.emplace_back(&map.lanes[i], std::move(*longest));
  }
  return lanes;
}

/// The places of a published lane in range: as a whole, and of its first and last few metres, which may be on
/// other truth lanes.
struct LanePlaces {
  std::optional<LanePlace> whole, begin, end;
};
using Places = std::map<ElementId, LanePlaces>;

LinePiece stretch(const LinePiece& piece, std::size_t from, std::size_t to) {
  const Polyline samples(piece.samples.begin() + static_cast<std::ptrdiff_t>(from),
                         piece.samples.begin() + static_cast<std::ptrdiff_t>(to));
  return {piece.line, samples, samples};
}

Places places(const LanePieces& pieces, const LaneFinder& finder) {
  Places places;
  for (const auto& [lane, piece] : pieces) {
    const std::size_t count = piece.samples.size(), end = std::min(count, kEndSamples);
    places[lane->id] = {finder.place(piece, lane->direction),
                        finder.place(stretch(piece, 0, end), lane->direction),
                        finder.place(stretch(piece, count - end, count), lane->direction)};
  }
  return places;
}

void add_directions(const LanePieces& pieces, const LaneFinder& finder, PairScore& score) {
  for (const auto& [lane, piece] : pieces) {
    if (!finder.place(piece, Lane::Direction::unknown)) continue;
    ++score.truths;
    if (lane->direction == Lane::Direction::unknown) continue;
    ++score.published;
    if (!finder.place(piece, lane->direction)) continue;
    ++score.right;
    ++score.found;
  }
}

using Pair = std::pair<std::size_t, std::size_t>;

/// The pair of truth lanes that a linkage stands for. None: the linkage is wrong. The two are equal if it
/// stays on one lane.
std::optional<Pair> truth_pair(const TruthTopology& truth, const std::optional<LanePlace>& from,
                               const std::optional<LanePlace>& to) {
  if (!from || !to || from->reversed() != to->reversed()) return std::nullopt;
  if (from->truth == to->truth) {
    const bool in_order = from->reversed() ? from->from_m > to->from_m : from->from_m < to->from_m;
    return in_order ? std::optional(Pair{from->truth, to->truth}) : std::nullopt;
  }
  const Pair pair = from->reversed() ? Pair{to->truth, from->truth} : Pair{from->truth, to->truth};
  return truth.successors.contains(pair) ? std::optional(pair) : std::nullopt;
}

void add_linkages(const TruthTopology& truth, const Places& places, const LocalMap& map,
                  TopologyScore& score) {
  std::set<Pair> found;
  for (const Linkage& linkage : map.linkages) {
    const auto from = places.find(linkage.from), to = places.find(linkage.to);
    if (from == places.end() || to == places.end()) continue;
    const std::optional<Pair> pair = truth_pair(truth, from->second.end, to->second.begin);
    for (PairScore* counted : {&score.linkages, &score.by_kind.at(static_cast<std::size_t>(linkage.kind))}) {
      ++counted->published;
      if (pair) ++counted->right;
    }
    if (pair) found.insert(*pair);
  }
  std::set<std::size_t> seen;
  for (const auto& [id, place] : places)
    if (place.whole) seen.insert(place.whole->truth);
  for (const Pair& pair : truth.successors) {
    if (!seen.contains(pair.first) || !seen.contains(pair.second)) continue;
    ++score.linkages.truths;
    if (found.contains(pair)) ++score.linkages.found;
  }
}

void add_stoplines(const TruthTopology& truth, const FrameComparison& frame, const Places& places,
                   const LocalMap& map, PairScore& score) {
  const KindComparison& stoplines = frame.of(LineKind::stopline);
  for (const TruePositive& match : stoplines.matches) {
    const std::set<std::size_t>& expected = truth.lanes_of_stopline.at(stoplines.truths[match.truth].line);
    const std::size_t line = stoplines.predictions[match.prediction].line;
    if (line >= map.stoplines.size()) continue;  // a boundary of this type ends no lanes
    std::set<std::size_t> seen, named;
    for (const auto& [id, place] : places)
      if (place.whole && expected.contains(place.whole->truth)) seen.insert(place.whole->truth);
    for (const ElementId id : map.stoplines[line].lanes) {
      const auto place = places.find(id);
      if (place == places.end()) continue;
      ++score.published;
      const std::optional<LanePlace>& whole = place->second.whole;
      if (!whole || !expected.contains(whole->truth)) continue;
      ++score.right;
      named.insert(whole->truth);
    }
    score.truths += seen.size();
    score.found += named.size();
  }
}

}  // namespace

bool may_run(Lane::Direction direction, bool reversed) {
  return direction == Lane::Direction::unknown || direction == Lane::Direction::both ||
         (direction == Lane::Direction::against_centerline) == reversed;
}

double PairScore::precision() const { return ratio(right, published); }
double PairScore::recall() const { return ratio(found, truths); }
double PairScore::f1() const {
  const double sum = precision() + recall();
  return sum > 0.0 ? 2.0 * precision() * recall() / sum : 0.0;
}

TruthTopology truth_topology(const simulation::Road& truth) {
  const std::vector<LaneChain> chains = lane_chains(truth);
  std::map<ElementId, const simulation::RoadLane*> lanes;
  for (const simulation::RoadLane& lane : truth.lanes) lanes.emplace(lane.id, &lane);
  std::map<ElementId, std::size_t> chain_of;
  for (std::size_t i = 0; i < chains.size(); ++i)
    for (const simulation::RoadLane* lane : chains[i]) chain_of.emplace(lane->id, i);

  TruthTopology topology;
  for (std::size_t i = 0; i < chains.size(); ++i)
    for (const std::size_t next : following(*chains[i].back(), lanes, chain_of))
      if (next != i) topology.successors.emplace(i, next);
  for (std::size_t i = 0; i < truth.markings.size(); ++i) {
    if (truth.markings[i].type != MarkingType::stopline) continue;
    std::set<std::size_t>& ended = topology.lanes_of_stopline[chains.size() + i];
    for (std::size_t chain = 0; chain < chains.size(); ++chain)
      if (intersect(prolonged(centerline(chains[chain])), truth.markings[i].points, kLevel_m))
        ended.insert(chain);
  }
  return topology;
}

void add_topology(const TruthTopology& truth, const FrameComparison& frame, const LocalMap& map,
                  const RangeConfig& range, TopologyScore& score) {
  const LaneFinder finder(frame.of(LineKind::lane).truths);
  const LanePieces pieces = lane_pieces(map, range);
  const Places found = places(pieces, finder);
  add_directions(pieces, finder, score.directions);
  add_linkages(truth, found, map, score);
  add_stoplines(truth, frame, found, map, score.stopline_lanes);
}

}  // namespace laneloom::evaluation
