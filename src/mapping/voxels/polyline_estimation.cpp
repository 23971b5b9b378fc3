#include "mapping/voxels/polyline_estimation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace laneloom::voxels {
namespace {

using Points = std::vector<WeightedPoint>;

constexpr std::size_t kMinGroup = 3;      // points that make a quadrant worth a polyline
constexpr double kMinVariance_m2 = 0.05;  // along a group; with less, its direction is not determined

/// Principal components, by descending eigenvalue.
struct PrincipalAxes {
  Point mean;
  Eigen::Matrix3d axes;  ///< columns
  Eigen::Vector3d variance;

  Point to_local(const Point& point) const { return axes.transpose() * (point - mean); }
  Point to_map(const Point& local) const { return axes * local + mean; }
};

PrincipalAxes principal_axes(const Points& points) {
  PrincipalAxes pca{.mean = Point::Zero(), .axes = {}, .variance = {}};
  for (const auto& p : points) pca.mean += p.point;
  pca.mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : points) covariance += (p.point - pca.mean) * (p.point - pca.mean).transpose();
  covariance /= static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  pca.axes = solver.eigenvectors().rowwise().reverse();
  pca.variance = solver.eigenvalues().reverse();
  return pca;
}

/// Weighted least-squares line through one group: the other two coordinates as functions of the first.
class LineFit {
 public:
  void add(const Point& local, double weight) {
    const double u = local.x();
    const Eigen::Vector2d v = local.tail<2>();
    weight_ += weight;
    sum_u_ += weight * u;
    sum_uu_ += weight * u * u;
    sum_v_ += weight * v;
    sum_uv_ += weight * u * v;
    first_ = std::min(first_, u);
    last_ = std::max(last_, u);
  }
  bool empty() const { return weight_ == 0.0; }
  double first() const { return first_; }
  double last() const { return last_; }

  Point at(double u) const {
    const double mean_u = sum_u_ / weight_;
    const Eigen::Vector2d mean_v = sum_v_ / weight_;
    const double variance = sum_uu_ / weight_ - mean_u * mean_u;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    if (variance > kMinVariance_m2) slope = (sum_uv_ / weight_ - mean_u * mean_v) / variance;
    const Eigen::Vector2d v = mean_v + slope * (u - mean_u);
    return {u, v.x(), v.y()};
  }

 private:
  double weight_ = 0.0, sum_u_ = 0.0, sum_uu_ = 0.0;
  Eigen::Vector2d sum_v_ = Eigen::Vector2d::Zero(), sum_uv_ = Eigen::Vector2d::Zero();
  double first_ = std::numeric_limits<double>::infinity();
  double last_ = -std::numeric_limits<double>::infinity();
};

/// Joins the fitted lines of consecutive groups: halfway between two that are adjacent, straight across empty
/// ones.
Polyline connect(const std::vector<LineFit>& fits, double start, double group_m) {
  Polyline line;
  std::optional<std::size_t> previous;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    if (fits[k].empty()) continue;
    if (!previous) {
      line.push_back(fits[k].at(fits[k].first()));
    } else if (*previous + 1 == k) {
      const double border = start + group_m * static_cast<double>(k);
      line.push_back(0.5 * (fits[*previous].at(border) + fits[k].at(border)));
    } else {
      line.push_back(fits[*previous].at(fits[*previous].last()));
      line.push_back(fits[k].at(fits[k].first()));
    }
    previous = k;
  }
  line.push_back(fits[*previous].at(fits[*previous].last()));
  return line;
}

/// Case 1: groups of about `segment_m` along the first principal component, with a line for each.
Polyline fit_along_first_component(const Points& points, const PrincipalAxes& pca, double segment_m) {
  Polyline local(points.size());
  std::ranges::transform(points, local.begin(), [&](const auto& p) { return pca.to_local(p.point); });
  const auto [lowest, highest] = std::ranges::minmax(local, {}, [](const Point& p) { return p.x(); });
  const double start = lowest.x();
  const double span_m = highest.x() - start;
  const auto groups = static_cast<std::size_t>(std::max(1.0, std::round(span_m / segment_m)));
  const double group_m = span_m / static_cast<double>(groups);

  std::vector<LineFit> fits(groups);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = group_m > 0.0 ? (local[i].x() - start) / group_m : 0.0;
    fits[std::min(groups - 1, static_cast<std::size_t>(share))].add(local[i], points[i].weight);
  }
  Polyline line = connect(fits, start, group_m);
  for (Point& point : line) point = pca.to_map(point);
  return line;
}

/// Puts the pieces into the order and directions that leave the shortest gaps between them.
std::vector<Polyline> chain(const std::vector<Polyline>& pieces) {
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<Polyline> best;
  double best_gap = std::numeric_limits<double>::infinity();
  do {
    for (unsigned flips = 0; flips < 1U << pieces.size(); ++flips) {
      const auto flipped = [&](std::size_t k) { return ((flips >> k) & 1U) != 0; };
      const auto head = [&](std::size_t k) {
        return flipped(k) ? pieces[order[k]].back() : pieces[order[k]].front();
      };
      const auto tail = [&](std::size_t k) {
        return flipped(k) ? pieces[order[k]].front() : pieces[order[k]].back();
      };
      double gap = 0.0;
      for (std::size_t k = 1; k < pieces.size(); ++k) gap += (head(k) - tail(k - 1)).norm();
      if (gap >= best_gap) continue;
      best_gap = gap;
      best.clear();
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        best.push_back(pieces[order[k]]);
        if (flipped(k)) std::ranges::reverse(best.back());
      }
    }
  } while (std::ranges::next_permutation(order).found);
  return best;
}

/// Case 2: each quadrant on its own. The lines are then joined end to end; ends that are close meet halfway.
Polyline fit_quadrants(const Points& points, const PrincipalAxes& pca, double segment_m) {
  std::array<Points, 4> quadrants;
  for (const auto& p : points) {
    const Point local = pca.to_local(p.point);
    quadrants[(local.x() < 0.0 ? 0U : 1U) + (local.y() < 0.0 ? 0U : 2U)].push_back(p);
  }
  std::vector<Polyline> pieces;
  for (const Points& quadrant : quadrants) {
    if (quadrant.size() < kMinGroup) continue;
    pieces.push_back(fit_along_first_component(quadrant, principal_axes(quadrant), segment_m));
  }
  Polyline line;
  for (const Polyline& piece : chain(pieces)) {
    auto next = piece.begin();
    if (!line.empty() && (line.back() - *next).norm() < 0.5 * segment_m)
      line.back() = 0.5 * (line.back() + *next++);
    line.insert(line.end(), next, piece.end());
  }
  return line;
}

}  // namespace

Polyline estimate_polyline(const Points& points, MarkingType type, const PolylineConfig& config) {
  if (points.size() < 2) return {};
  const PrincipalAxes pca = principal_axes(points);
  if (type == MarkingType::stopline) {
    return fit_along_first_component(points, pca, std::numeric_limits<double>::infinity());
  }
  const bool straight = pca.variance[1] < config.straight_ratio * pca.variance[0];
  if (straight || points.size() < 4 * kMinGroup) {
    return fit_along_first_component(points, pca, config.segment_length_m);
  }
  return fit_quadrants(points, pca, config.curve_segment_length_m);
}

}  // namespace laneloom::voxels
