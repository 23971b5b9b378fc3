#include "export/loops.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/degree.hpp"
#include "export/align.hpp"
#include "export/drive_stations.hpp"
#include "export/line_archive.hpp"
#include "export/motions.hpp"

namespace laneloom::exports {
namespace {

constexpr double kLeastLoop_m = 350.0;              // driven, from a place until the drive is back
constexpr double kLaid_m = 80.0;                    // of the drive, that is laid onto what it left before
constexpr double kRoad_m = 120.0;                   // of what it left before, either way from the place
constexpr double kNear_m = 12.0;                    // from the place to that to which the drive comes back
constexpr double kLevel_m = 3.0;                    // likewise, of heights
constexpr double kCosAlong = 0.9;                   // between the headings, either way
constexpr std::size_t kStationsApart = 5;           // places of one loop that are laid
constexpr double kMet = 0.6;                        // least share of the lines that lie on those before
constexpr double kExpected_m = 0.5, kLost_m = 3.0;  // deviations of the place where it is expected
constexpr int kIterations = 6;
// Deviations: of odometry from station to station; of a place that was laid, beyond what its lines tell; of
// the first station.
const Motion kOdometryStddev{0.1, 0.1, 0.05, 0.1 * kDegree};
const Motion kLaidStddev{0.1, 0.1, 0.1, 0.1 * kDegree};
const Motion kFirstStddev{1e-3, 1e-3, 1e-3, 1e-6};
constexpr double kDoubtful = 3.0;  // deviations from which on a place counts less

using Isometries = std::vector<Eigen::Isometry3d>;

/// The stations of an edge: T_road_drive of `to` is that of `from`, times `T_from_to`.
struct Edge {
  std::size_t from = 0, to = 0;
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
  Eigen::Matrix4d information = Eigen::Matrix4d::Identity();
  bool is_loop = false;
};

/// The part of a drive that was driven between two distances. `driven_m` is per pose.
DriveLines part_of(const DriveLines& drive, const std::vector<double>& driven_m, double from_m, double to_m) {
  const auto begin = static_cast<std::size_t>(std::ranges::lower_bound(driven_m, from_m) - driven_m.begin());
  const auto end = static_cast<std::size_t>(std::ranges::upper_bound(driven_m, to_m) - driven_m.begin());
  const auto pose = [&](std::size_t i) { return drive.poses.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto piece = [&](std::size_t i) {
    return std::ranges::lower_bound(drive.pieces, i, {}, &ArchivedPiece::pose);
  };
  DriveLines part{{piece(begin), piece(end)}, {pose(begin), pose(end)}};
  for (ArchivedPiece& one : part.pieces) one.pose -= begin;
  return part;
}

/// Normal equations over the motions of all stations.
class Equations {
 public:
  explicit Equations(std::size_t stations) : g_(Eigen::VectorXd::Zero(place(stations))) {}

  /// Holds a station where it is.
  void hold(std::size_t k, const Eigen::Matrix4d& information) { add(k, k, information); }
  /// Adds an error, which is moved by a motion of the station `to` as that is, and by one of `from` times
  /// `carry`.
  void add(const Edge& edge, const Eigen::Matrix4d& carry, const Eigen::Matrix4d& information,
           const Motion& error) {
    add(edge.from, edge.from, carry.transpose() * information * carry);
    add(edge.from, edge.to, carry.transpose() * information);
    add(edge.to, edge.from, information * carry);
    add(edge.to, edge.to, information);
    g_.segment<4>(place(edge.from)) += carry.transpose() * information * error;
    g_.segment<4>(place(edge.to)) += information * error;
  }
  /// The motions, four numbers a station.
  Eigen::VectorXd solve() const {
    Eigen::SparseMatrix<double> H(g_.size(), g_.size());
    H.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(H).solve(-g_);
  }

  static Eigen::Index place(std::size_t k) { return static_cast<Eigen::Index>(4 * k); }

 private:
  void add(std::size_t row, std::size_t column, const Eigen::Matrix4d& block) {
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        entries_.emplace_back(static_cast<int>(place(row)) + r, static_cast<int>(place(column)) + c,
                              block(r, c));
  }

  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd g_;
};

/// A drive that comes back to a place.
struct Return {
  std::size_t before = 0, now = 0;  ///< stations
  Eigen::Isometry3d expected;       ///< leads from the frame of the poses now to that of the poses before
  DriveLines lines;                 ///< of now, moved to where they are expected
  LineArchive road;                 ///< of before
};

/// Lays the lines of now onto those of before. `stddev_m` is that of the place where they are expected.
/// Empty: too few of them lie there.
std::optional<Edge> laid(const Return& comes_back, double stddev_m) {
  const auto end = end_on_road(comes_back.lines, comes_back.road, stddev_m);
  if (!end) return std::nullopt;
  DriveLines found = comes_back.lines;
  move(end->T_road_drive, found);
  if (met_share(found.pieces, comes_back.road) < kMet) return std::nullopt;
  const Eigen::Matrix4d floor = kLaidStddev.cwiseAbs2().asDiagonal();
  return Edge{.from = comes_back.before,
              .to = comes_back.now,
              .T_from_to = end->T_road_drive * comes_back.expected,
              .information = (end->covariance + floor).inverse(),
              .is_loop = true};
}

/// The pose graph of a drive.
class Loops {
 public:
  explicit Loops(const DriveLines& drive)
      : drive_(drive),
        driven_m_(driven_to(drive)),
        stations_(stations_of(drive)),
        T_road_drive_(stations_.size(), Eigen::Isometry3d::Identity()) {
    const Eigen::Matrix4d odometry = kOdometryStddev.cwiseAbs2().cwiseInverse().asDiagonal();
    for (std::size_t k = 1; k < stations_.size(); ++k)
      edges_.push_back({.from = k - 1, .to = k, .information = odometry});
  }

  Isometries close() {
    find_places();
    for (int i = 0; i < kIterations; ++i) relax();
    return between(stations_, T_road_drive_, drive_);
  }

 private:
  Eigen::Isometry3d pose(std::size_t k) const { return T_road_drive_[k] * stations_[k].T_drive_body; }
  Point place(std::size_t k) const { return pose(k).translation(); }

  /// The earlier station to which the drive comes back at a station. Empty: to none.
  std::optional<std::size_t> visited_before(std::size_t k) const {
    std::optional<std::size_t> nearest;
    double nearest_m = kNear_m;
    const Eigen::Vector2d heading = pose(k).linear().col(0).head<2>().normalized();
    for (std::size_t j = 0; j < k && stations_[j].driven_m + kLeastLoop_m < stations_[k].driven_m; ++j) {
      const Point away = place(j) - place(k);
      const double away_m = away.head<2>().norm();
      if (away_m >= nearest_m || std::abs(away.z()) > kLevel_m) continue;
      if (std::abs(pose(j).linear().col(0).head<2>().normalized().dot(heading)) < kCosAlong) continue;
      nearest_m = away_m;
      nearest = j;
    }
    return nearest;
  }

  /// Lays the drive onto itself where it comes back.
  void find_places() {
    // The last station is among them.
    for (std::size_t k = (stations_.size() - 1) % kStationsApart; k < stations_.size(); k += kStationsApart) {
      const auto before = visited_before(k);
      if (!before) continue;
      const Return comes_back = return_to(*before, k);
      auto edge = laid(comes_back, kExpected_m);
      const bool is_expected = edge.has_value();
      if (!is_expected) edge = laid(comes_back, kLost_m);
      if (edge) edges_.push_back(*edge);
      // Later places are expected by what was found.
      if (edge && !is_expected) relax();
    }
  }

  Return return_to(std::size_t before, std::size_t k) const {
    const double before_m = stations_[before].driven_m, now_m = stations_[k].driven_m;
    Return comes_back{.before = before,
                      .now = k,
                      .expected = T_road_drive_[before].inverse() * T_road_drive_[k],
                      .lines = part_of(drive_, driven_m_, now_m - kLaid_m, now_m),
                      .road = {}};
    move(comes_back.expected, comes_back.lines);
    for (const ArchivedPiece& piece :
         part_of(drive_, driven_m_, before_m - kRoad_m, before_m + kRoad_m).pieces)
      comes_back.road.add(piece);
    return comes_back;
  }

  /// A step of Gauss-Newton over all stations.
  void relax() {
    Equations equations(stations_.size());
    equations.hold(0, kFirstStddev.cwiseAbs2().cwiseInverse().asDiagonal());
    for (const Edge& edge : edges_) {
      const Eigen::Isometry3d expected = T_road_drive_[edge.from] * edge.T_from_to;
      const Point about = expected * Point(stations_[edge.to].T_drive_body.translation());
      const Motion error = motion(expected, T_road_drive_[edge.to], about);
      const double doubt = edge.is_loop ? error.dot(edge.information * error) / (kDoubtful * kDoubtful) : 0.0;
      // A turn of the first station moves the second one aside.
      Eigen::Matrix4d carry = -Eigen::Matrix4d::Identity();
      carry.block<2, 1>(0, 3) = -left_of((about - place(edge.from)).head<2>());
      equations.add(edge, carry, edge.information / (1.0 + doubt), error);
    }
    const Eigen::VectorXd motions = equations.solve();
    for (std::size_t k = 0; k < stations_.size(); ++k)
      T_road_drive_[k] = moved(T_road_drive_[k], motions.segment<4>(Equations::place(k)), place(k));
  }

  const DriveLines& drive_;
  std::vector<double> driven_m_;  ///< per pose
  std::vector<DriveStation> stations_;
  Isometries T_road_drive_;  ///< per station
  std::vector<Edge> edges_;
};

}  // namespace

std::vector<Eigen::Isometry3d> close_loops(const DriveLines& drive) {
  if (drive.poses.empty()) return {};
  return Loops(drive).close();
}

}  // namespace laneloom::exports
