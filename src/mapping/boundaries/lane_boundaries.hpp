#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom::boundaries {

/// A continuous lane boundary, made of one or more markings.
struct LaneBoundary {
  Marking marking;                 ///< has the id of its oldest member
  std::vector<ElementId> members;  ///< ids of the markings that it is made of, ascending
  std::vector<Stretch> bridged{};  ///< the gaps between them, along the marking
  bool two_way = false;            ///< inferred between two kerbs: opposite directions of traffic meet here
  MeasuredPolyline course{};       ///< the marking's points, measured by Boundaries
  /// The side on which it bounds a round island, measured likewise. Traffic goes round that one way.
  std::optional<Side> island{};

  bool is_edge() const { return marking.type == MarkingType::roadedge; }
  bool is_confirmed() const { return marking.status == ElementStatus::confirmed; }
  bool is_inferred() const { return marking.status == ElementStatus::inferred; }
  /// Whether it is an edge that was continued where it is not seen. A street may begin there.
  bool is_unseen_edge() const { return is_edge() && is_inferred(); }
};

/// The boundaries of one map, by ascending id, each with its measured course.
class Boundaries {
 public:
  Boundaries() = default;
  Boundaries(std::vector<LaneBoundary> boundaries);  // NOLINT(google-explicit-constructor): they are the same

  std::size_t size() const { return all_.size(); }
  bool empty() const { return all_.empty(); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }
  const LaneBoundary& operator[](std::size_t index) const { return all_[index]; }
  /// The index of the boundary of an id, which must exist.
  std::size_t index_of(ElementId id) const;
  /// The boundary of an id. Null: there is none.
  const LaneBoundary* find(ElementId id) const;
  const LaneBoundary& of(ElementId id) const { return all_[index_of(id)]; }

  /// Lets a boundary run in the other direction.
  void reverse(std::size_t index);
  void insert(std::vector<LaneBoundary> boundaries);
  std::vector<LaneBoundary> take() && { return std::move(all_); }

 private:
  std::vector<LaneBoundary> all_;
};

/// Whether a path leads over an edge that was seen, on its level.
bool crosses_edge(const Polyline& path, const Boundaries& boundaries);

/// Joins lanelines, and joins roadedges, whose ends are close and aligned to continuous boundaries (paper,
/// Sec. III-D-1). Ends that `joints` shows to be separate are not joined. Close ends that detections ran
/// through are joined at any angle: round a hairpin or the tip of an island. The nearest ends are joined
/// first, each end once. Stoplines are left out.
Boundaries lane_boundaries(const std::vector<Marking>& markings, const markings::PairHistories& joints,
                           const BoundaryConfig& config);

}  // namespace laneloom::boundaries
