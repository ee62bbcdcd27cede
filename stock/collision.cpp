#include "stock/collision.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace frustum::stock {
namespace {

using cutter::Box;
using kinematics::PathBlock;
using kinematics::PathKind;
using kinematics::ToolPath;

constexpr double kMargin = 0.01;  // mm: above any geometric error, below any collision that matters

bool overlap(const Box& a, const BoundingBox& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

// The stretches of one block that come near the blank.
struct SuspectMove {
  std::uint32_t block = 0;
  std::vector<std::uint32_t> stretches{};
  Box box{};
};

std::vector<SuspectMove> suspects(const Workpiece& workpiece) {
  const ToolPath& path = workpiece.removed().path();
  const BoundingBox blank = workpiece.blank().bounds();
  std::vector<SuspectMove> moves;
  for (std::uint32_t i = 0; i < path.stretches.size(); ++i) {
    const PathBlock& block = path.blocks[path.stretches[i].block];
    if (block.kind == PathKind::feed && block.spindle_on) continue;
    const Box& box = workpiece.removed().box(i);
    if (!overlap(box, blank)) continue;
    if (moves.empty() || moves.back().block != path.stretches[i].block) {
      moves.push_back({path.stretches[i].block, {}, box});
    }
    SuspectMove& move = moves.back();
    move.stretches.push_back(i);
    move.box = {move.box.min.cwiseMin(box.min), move.box.max.cwiseMax(box.max)};
  }
  for (SuspectMove& move : moves) {
    move.box = {move.box.min.cwiseMax(blank.min), move.box.max.cwiseMin(blank.max)};
  }
  return moves;
}

std::optional<Collision> examine(const Workpiece& workpiece, const SuspectMove& move) {
  const ToolPath& path = workpiece.removed().path();
  const PathBlock& block = path.blocks[move.block];
  const double pitch = workpiece.removed().tool(block.tool).profile().max_radius() / 6.0;
  const cutter::RaySpan span{0.0, move.box.max.z() - move.box.min.z()};
  if (!(span.hi > 0.0)) return std::nullopt;
  Collision worst{.kind = block.kind == PathKind::rapid ? CollisionKind::rapid_through_material
                                                        : CollisionKind::feed_with_spindle_off,
                  .source_line = block.source_line,
                  .tool = block.tool};
  const auto count = [&](int k) {
    return 1 + static_cast<int>((move.box.max[k] - move.box.min[k]) / pitch);
  };
  for (int i = 0; i < count(0); ++i) {
    for (int j = 0; j < count(1); ++j) {
      const Ray ray{move.box.min + Vec3((i + 0.5) * pitch, (j + 0.5) * pitch, 0.0), Vec3::UnitZ()};
      const IntervalSet covered = workpiece.removed()
                                      .core_along(ray, move.stretches, kMargin)
                                      .intersected(IntervalSet({{span.lo, span.hi}}));
      if (covered.empty()) continue;
      const IntervalSet met =
          workpiece.material_along(ray, span, move.stretches.front()).intersected(covered);
      for (const Interval& piece : met.intervals()) {
        if (piece.length() > worst.depth) {
          worst.depth = piece.length();
          worst.point = ray.at(0.5 * (piece.lo + piece.hi));
        }
      }
    }
  }
  if (worst.depth <= kMargin) return std::nullopt;
  return worst;
}

}  // namespace

std::vector<Collision> find_collisions(const Workpiece& workpiece) {
  std::vector<Collision> found;
  for (const SuspectMove& move : suspects(workpiece)) {
    if (const auto collision = examine(workpiece, move)) found.push_back(*collision);
  }
  return found;
}

}  // namespace frustum::stock
