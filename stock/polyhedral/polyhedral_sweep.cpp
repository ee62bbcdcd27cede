#include "stock/polyhedral/polyhedral_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "stock/polyhedral/polyhedral_body.hpp"

namespace frustum::stock {
namespace {

using kinematics::ToolPath;
using kinematics::ToolPose;

// The shares of the tolerance, see the header: two quarters and a half.
constexpr double kMergeShare = 0.25;
constexpr double kArcShare = 0.25;
constexpr double kHullShare = 0.5;

// A pose with the roll of the facets about the axis.
Pose framed(const ToolPose& pose, const Vec3& across) {
  const Vec3 x = (across - across.dot(pose.axis) * pose.axis).normalized();
  Mat3 rotation;
  rotation << x, pose.axis.cross(x), pose.axis;
  return {rotation, pose.tip};
}

Diagnostic at_block(Diagnostic failure, const kinematics::PathBlock& block) {
  failure.line = static_cast<int>(block.source_line);
  if (block.source_file) failure.file = *block.source_file;
  return failure;
}

// Least and largest of some displacements along a normal.
struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void add(double value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  [[nodiscard]] double width() const { return hi - lo; }
  // How far the hull of a facet with these displacements at its corners leaves its sweep.
  [[nodiscard]] double overshoot() const {
    return lo < 0.0 && hi > 0.0 ? -lo * hi / (hi - lo) : 0.0;
  }
};

// The two facets that meet in an edge, with the displacements of its ends along their normals.
double edge_overshoot(const Vec3& n1, const Vec3& n2, const Vec3& d1, const Vec3& d2) {
  Range first, second;
  for (const Vec3& d : {d1, d2}) {
    first.add(n1.dot(d));
    second.add(n2.dot(d));
  }
  if (std::min(first.lo, second.lo) >= 0.0 || std::max(first.hi, second.hi) <= 0.0) return 0.0;
  // A unit normal between the two is their combination with weights that sum to 1/cos at most.
  const double half_angle_cosine = std::sqrt(std::max(0.0, (1.0 + n1.dot(n2)) / 2.0));
  return std::max(first.width(), second.width()) / (4.0 * std::max(half_angle_cosine, 0.1));
}

class Sweep {
 public:
  Sweep(const BoundingBox& within, const PolyhedralOptions& options)
      : within_(within), options_(options), tolerance_(options.tolerance.value) {}

  // The motion from one pose to the next; the true one stays within `apart` of it.
  void add(const FacetedBody& body, const ToolPose& from, const ToolPose& to, double apart) {
    if (overfull()) return;
    const double turn = angle_between(from.axis, to.axis);
    const double arc = body.reach() * turn * turn / 8.0;
    const double growth = apart + arc;
    const std::vector<Ring> rings = body.rings(growth);
    const Pose a = framed(from, across_);
    const Pose b = framed(to, a.rotation.col(0));
    if (misses(body, rings, a, b)) {
      across_ = b.rotation.col(0);
      return;
    }
    // 1e-9 rad moves no point of a cutter by more than rounding does.
    const bool turns = turn > 1e-9;
    if (turns && (arc > kArcShare * tolerance_ ||
                  end_overshoot(body, rings, a, b) > kHullShare * tolerance_)) {
      const ToolPose middle = kinematics::between(from, to, 0.5);
      add(body, from, middle, apart);
      add(body, middle, to, apart);
      return;
    }
    emit(body, turns ? slab_rings(body, rings, a, b) : std::vector<std::vector<Ring>>(1, rings), a,
         b);
    across_ = b.rotation.col(0);
  }

  // The same motion of every part.
  void add(const std::vector<FacetedBody>& parts, const ToolPose& from, const ToolPose& to,
           double apart) {
    const Vec3 across = across_;
    for (const FacetedBody& part : parts) {
      across_ = across;
      add(part, from, to, apart);
    }
  }
  // Facets keep their roll from segment to segment.
  void begin_at(const ToolPose& pose) { across_ = perpendicular_to(pose.axis); }
  [[nodiscard]] bool overfull() const {
    return pieces_.size() > static_cast<std::size_t>(options_.max_pieces);
  }
  [[nodiscard]] std::vector<ConvexPiece>& pieces() { return pieces_; }

 private:
  static Vec3 displacement(const FacetedBody& body, const Ring& ring, int j, const Pose& a,
                           const Pose& b) {
    const Vec3 vertex = body.vertex(ring, j);
    return b.point(vertex) - a.point(vertex);
  }

  [[nodiscard]] bool misses(const FacetedBody& body, const std::vector<Ring>& rings, const Pose& a,
                            const Pose& b) const {
    Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 hi = -lo;
    for (const Ring& ring : rings) {
      for (int j = 0; j < body.facets(); ++j) {
        for (const Pose& pose : {a, b}) {
          const Vec3 point = pose.point(body.vertex(ring, j));
          lo = lo.cwiseMin(point);
          hi = hi.cwiseMax(point);
        }
      }
    }
    return (lo.array() > within_.max.array()).any() || (hi.array() < within_.min.array()).any();
  }

  // Of the end faces and of the edges around the axis: what convex sections cannot mend.
  [[nodiscard]] static double end_overshoot(const FacetedBody& body, const std::vector<Ring>& rings,
                                            const Pose& a, const Pose& b) {
    const Vec3 axis = (a.rotation.col(2) + b.rotation.col(2)).normalized();
    const int top = static_cast<int>(rings.size()) - 1;
    Range bottom_face, top_face;
    double worst = 0.0;
    for (int i = 0; i <= top; ++i) {
      const Ring& ring = rings[static_cast<std::size_t>(i)];
      for (int j = 0; j < body.facets(); ++j) {
        const Vec3 here = displacement(body, ring, j, a, b);
        const Vec3 next = displacement(body, ring, j + 1, a, b);
        if (i == 0) bottom_face.add(-axis.dot(here));
        if (i == top) top_face.add(axis.dot(here));
        const Vec3 below = i == 0 ? Vec3(-axis) : a.direction(body.band_normal(i - 1, j));
        const Vec3 above = i == top ? axis : a.direction(body.band_normal(i, j));
        worst = std::max(worst, edge_overshoot(below, above, here, next));
      }
    }
    return std::max({worst, bottom_face.overshoot(), top_face.overshoot()});
  }

  // Of band i as a whole: its facets and the edges along the generatrix.
  [[nodiscard]] static double band_overshoot(const FacetedBody& body, int i, const Ring& lower,
                                             const Ring& upper, const Pose& a, const Pose& b) {
    double worst = 0.0;
    for (int j = 0; j < body.facets(); ++j) {
      worst = std::max(worst, edge_overshoot(a.direction(body.band_normal(i, j - 1)),
                                             a.direction(body.band_normal(i, j)),
                                             displacement(body, lower, j, a, b),
                                             displacement(body, upper, j, a, b)));
    }
    return worst;
  }

  // The rings of each convex section, so that the walls of none overshoot by more than their share.
  [[nodiscard]] std::vector<std::vector<Ring>> slab_rings(const FacetedBody& body,
                                                          const std::vector<Ring>& rings,
                                                          const Pose& a, const Pose& b) const {
    std::vector<std::vector<Ring>> slabs(1, {rings.front()});
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      const Ring& lower = rings[i];
      const Ring& upper = rings[i + 1];
      const double over = band_overshoot(body, static_cast<int>(i), lower, upper, a, b);
      const double needed = std::ceil(over / (kHullShare * tolerance_));
      const int parts = static_cast<int>(std::clamp(needed, 1.0, options_.max_pieces + 1.0));
      for (int k = 1; k <= parts; ++k) {
        const double t = static_cast<double>(k) / parts;
        const Ring ring{lower.radius + t * (upper.radius - lower.radius),
                        lower.z + t * (upper.z - lower.z)};
        slabs.back().push_back(k == parts ? upper : ring);
        if (k < parts) slabs.push_back({ring});
      }
    }
    return slabs;
  }

  void emit(const FacetedBody& body, const std::vector<std::vector<Ring>>& slabs, const Pose& a,
            const Pose& b) {
    for (const std::vector<Ring>& rings : slabs) {
      if (misses(body, rings, a, b)) continue;
      ConvexPiece piece;
      for (const Ring& ring : rings) {
        for (int j = 0; j < body.facets(); ++j) {
          piece.push_back(a.point(body.vertex(ring, j)));
          piece.push_back(b.point(body.vertex(ring, j)));
        }
      }
      pieces_.push_back(std::move(piece));
    }
  }

  BoundingBox within_;
  PolyhedralOptions options_;
  double tolerance_;
  Vec3 across_ = Vec3::UnitX();
  std::vector<ConvexPiece> pieces_;
};

// How far no body point of a pose is from the straight motion from `first` to `last`.
double distance_from_motion(const ToolPose& first, const ToolPose& last, const ToolPose& pose,
                            double reach) {
  const Vec3 step = last.tip - first.tip;
  const double turn = angle_between(first.axis, last.axis);
  double t = 0.0;
  if (step.squaredNorm() > 0.0) {
    t = (pose.tip - first.tip).dot(step) / step.squaredNorm();
  } else if (turn > 0.0) {
    t = angle_between(first.axis, pose.axis) / turn;
  }
  const ToolPose near = kinematics::between(first, last, std::clamp(t, 0.0, 1.0));
  return (near.tip - pose.tip).norm() + reach * (near.axis - pose.axis).norm();
}

// Segments [first, last) as one motion.
struct Run {
  std::size_t last = 0;
  double apart = 0.0;
};

Run merged_run(const ToolPath& path, std::size_t first, double reach, double tolerance) {
  // Trying every length costs its square; runs longer than this gain little.
  constexpr std::size_t kLongest = 200;
  const auto tool_of = [&](std::size_t i) { return path.blocks[path.segments[i].block].tool; };
  Run best{first + 1, 0.0};
  for (std::size_t last = first + 1; last < path.segments.size(); ++last) {
    if (last - first >= kLongest || tool_of(last) != tool_of(first) ||
        path.segments[last].first_pose != path.segments[last - 1].first_pose + 1) {
      break;
    }
    double apart = 0.0;
    for (std::size_t i = first + 1; i <= last; ++i) {
      apart = std::max(
          apart, distance_from_motion(path.from(path.segments[first]), path.to(path.segments[last]),
                                      path.from(path.segments[i]), reach));
    }
    if (apart > tolerance) break;
    best = {last + 1, apart};
  }
  return best;
}

}  // namespace

Result<std::vector<ConvexPiece>> faceted_sweep(const ToolPath& path,
                                               const std::map<int, cutter::Cutter>& cutters,
                                               const BoundingBox& within,
                                               const PolyhedralOptions& options) {
  std::map<int, std::vector<FacetedBody>> bodies;
  for (const auto& [number, cutter] : cutters) {
    for (const cutter::Profile& part : cutter.body().parts()) {
      bodies[number].emplace_back(part, options.facets, options.arc_facets);
    }
  }
  Sweep sweep(within, options);
  std::optional<std::uint32_t> pose_before;
  std::size_t next = 0;
  while (next < path.segments.size()) {
    const kinematics::PathSegment& first = path.segments[next];
    const kinematics::PathBlock& block = path.blocks[first.block];
    const auto body = bodies.find(block.tool);
    if (body == bodies.end()) {
      return at_block(
          error("unknown-tool"_id, fmt::format("tool T{} cuts but is not defined", block.tool),
                fmt::format("add tool.{} with type, diameter and length", block.tool)),
          block);
    }
    if (!cutters.at(block.tool).body().concave().empty()) {
      return at_block(
          error("polyhedral-concave-tool"_id,
                fmt::format("the polyhedral engine cannot take tool T{}: its generatrix is concave",
                            block.tool),
                "it takes bodies made of convex parts; the ray engine takes this one"),
          block);
    }
    if (pose_before != first.first_pose) sweep.begin_at(path.from(first));
    const Run run = merged_run(path, next, cutters.at(block.tool).body().reach(),
                               kMergeShare * options.tolerance.value);
    const kinematics::PathSegment& last = path.segments[run.last - 1];
    sweep.add(body->second, path.from(first), path.to(last), run.apart);
    if (sweep.overfull()) {
      return at_block(
          error("polyhedral-pieces"_id,
                fmt::format("the polyhedral sweep needs more than {} hulls", options.max_pieces),
                fmt::format("a facet tolerance above {} mm needs fewer", options.tolerance.value)),
          block);
    }
    pose_before = last.first_pose + 1;
    next = run.last;
  }
  return std::move(sweep.pieces());
}

}  // namespace frustum::stock
