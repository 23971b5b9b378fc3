#include "evaluation/top_ll.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "evaluation/lane_chains.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

constexpr std::size_t kPoints = 11;
constexpr std::array kThresholds_m{1.0, 2.0, 3.0};
constexpr double kMinConfidence = 0.5;
constexpr double kNone = std::numeric_limits<double>::infinity();

struct Vertex {
  Polyline points;
  double confidence = 1.0;
  Lane::Direction direction = Lane::Direction::unknown;
};

Polyline resampled(const Polyline& points) {
  const MeasuredPolyline line(points);
  Polyline result;
  for (std::size_t i = 0; i < kPoints; ++i)
    result.push_back(line.at(line.length() * static_cast<double>(i) / (kPoints - 1)));
  return result;
}

/// The truth lanes in range, each by its longest piece and by its index among the truth's lines.
std::map<std::size_t, Polyline> truth_vertices(const KindComparison& lanes) {
  std::map<std::size_t, const LinePiece*> longest;
  for (const LinePiece& piece : lanes.truths) {
    const LinePiece*& best = longest.emplace(piece.line, &piece).first->second;
    if (piece.samples.size() > best->samples.size()) best = &piece;
  }
  std::map<std::size_t, Polyline> vertices;
  for (const auto& [line, piece] : longest) vertices.emplace(line, resampled(piece->points));
  return vertices;
}

/// The published lanes, as chains.
class PublishedGraph {
 public:
  using Edges = std::map<std::pair<std::size_t, std::size_t>, double>;  ///< with confidence

  PublishedGraph(const LocalMap& map, const RangeConfig& range) {
    const Eigen::Isometry3d T_body_map = map.T_map_body.inverse();
    std::map<ElementId, std::size_t> vertex_of;
    for (const PublishedChain& chain : lane_chains(map)) {
      for (const Lane* lane : chain.lanes) vertex_of.emplace(lane->id, vertices_.size());
      add_vertex(chain, T_body_map, range);
    }
    for (const Linkage& linkage : map.linkages) {
      const auto from = vertex_of.find(linkage.from), to = vertex_of.find(linkage.to);
      if (from == vertex_of.end() || to == vertex_of.end() || from->second == to->second) continue;
      double& confidence = edges_[{from->second, to->second}];
      confidence = std::max(confidence, linkage.probability);
    }
  }

  /// The vertices. A vertex has no points if no part of its lane is in range.
  const std::vector<Vertex>& vertices() const { return vertices_; }
  double edge(std::size_t from, std::size_t to) const {
    const auto found = edges_.find({from, to});
    return found == edges_.end() ? 0.0 : found->second;
  }

 private:
  void add_vertex(const PublishedChain& chain, const Eigen::Isometry3d& T_body_map,
                  const RangeConfig& range) {
    Vertex vertex{.direction = chain.lanes.front()->direction};
    if (chain.existence_probability >= 0.0) vertex.confidence = chain.existence_probability;
    const auto longest = longest_piece_in_range(chain.centerline, 0, T_body_map, range);
    if (longest) vertex.points = resampled(longest->points);
    vertices_.push_back(std::move(vertex));
  }

  std::vector<Vertex> vertices_;
  Edges edges_;
};

struct Taken {
  std::size_t vertex = 0;  ///< published
  bool turned = false;
};

struct Nearest {
  std::size_t truth = 0;
  double distance_m = kNone;
  bool turned = false;
};

Nearest nearest(const Vertex& vertex, const std::map<std::size_t, Polyline>& truths) {
  Nearest best;
  Polyline points = vertex.points;
  for (const bool turned : {false, true}) {
    for (const auto& [truth, line] : truths) {
      if (!may_run(vertex.direction, turned)) break;
      const double distance_m = frechet_distance_m(points, line);
      if (distance_m < best.distance_m) best = {truth, distance_m, turned};
    }
    std::reverse(points.begin(), points.end());
  }
  return best;
}

/// For each truth lane that was found, the published lane that took it.
std::map<std::size_t, Taken> take(const std::map<std::size_t, Polyline>& truths,
                                  const std::vector<Vertex>& published, double threshold_m) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < published.size(); ++i)
    if (!published[i].points.empty()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return published[a].confidence > published[b].confidence;
  });
  std::map<std::size_t, Taken> taken;
  for (const std::size_t i : order) {
    const Nearest found = nearest(published[i], truths);
    if (found.distance_m < threshold_m) taken.emplace(found.truth, Taken{i, found.turned});
  }
  return taken;
}

struct RatedEdge {
  double confidence = 0.0;
  bool right = false;
};

double average_precision_of_edges(std::vector<RatedEdge> edges, std::size_t truths) {
  if (truths == 0 && edges.empty()) return 1.0;
  if (truths == 0 || edges.empty()) return 0.0;
  std::stable_sort(edges.begin(), edges.end(),
                   [](const RatedEdge& a, const RatedEdge& b) { return a.confidence > b.confidence; });
  double sum = 0.0, right = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!edges[i].right) continue;
    right += 1.0;
    sum += right / static_cast<double>(i + 1);
  }
  return sum / static_cast<double>(truths);
}

}  // namespace

double frechet_distance_m(const Polyline& a, const Polyline& b) {
  std::vector<double> row(b.size(), kNone);  // of the couplings up to a's point before
  for (std::size_t i = 0; i < a.size(); ++i) {
    double diagonal = i == 0 ? 0.0 : kNone;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double before = std::min({diagonal, row[j], j == 0 ? kNone : row[j - 1]});
      diagonal = row[j];
      row[j] = std::max(before, (a[i] - b[j]).head<2>().norm());
    }
  }
  return row.back();
}

void add_top_ll(const TruthTopology& truth, const FrameComparison& frame, const LocalMap& map,
                const RangeConfig& range, TopLl& top_ll) {
  const std::map<std::size_t, Polyline> truths = truth_vertices(frame.of(LineKind::lane));
  const PublishedGraph graph(map, range);
  for (const double threshold_m : kThresholds_m) {
    const std::map<std::size_t, Taken> taken = take(truths, graph.vertices(), threshold_m);
    // The map's confidence in an edge. For lanes that it lacks, it is the contrary of the truth, hardly sure.
    const auto told = [&](std::size_t from, std::size_t to, bool exists) {
      const auto a = taken.find(from), b = taken.find(to);
      if (a == taken.end() || b == taken.end()) return exists ? 0.0 : std::nextafter(kMinConfidence, 1.0);
      const bool turned = a->second.turned && b->second.turned;
      return turned ? graph.edge(b->second.vertex, a->second.vertex)
                    : graph.edge(a->second.vertex, b->second.vertex);
    };
    for (const auto& [vertex, line] : truths) {
      for (const bool outgoing : {true, false}) {
        std::vector<RatedEdge> edges;
        std::size_t existing = 0;
        for (const auto& [other, other_line] : truths) {
          const std::size_t from = outgoing ? vertex : other, to = outgoing ? other : vertex;
          const bool exists = truth.successors.contains({from, to});
          if (exists) ++existing;
          const double confidence = told(from, to, exists);
          if (confidence > kMinConfidence) edges.push_back({confidence, exists});
        }
        top_ll.average_precisions += average_precision_of_edges(std::move(edges), existing);
        ++top_ll.vertices;
      }
    }
  }
}

}  // namespace laneloom::evaluation
