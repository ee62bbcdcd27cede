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

// Feeds with the spindle off that follow each other are one move: one report is enough.
bool continues(const ToolPath& path, const SuspectMove& move, std::uint32_t block) {
  if (move.block == block) return true;
  const PathBlock& before = path.blocks[path.stretches[move.stretches.back()].block];
  return before.kind == PathKind::feed && path.blocks[block].kind == PathKind::feed;
}

std::vector<SuspectMove> suspects(const Workpiece& workpiece) {
  const ToolPath& path = workpiece.removed().path();
  const BoundingBox blank = workpiece.blank().bounds();
  std::vector<SuspectMove> moves;
  for (std::uint32_t i = 0; i < path.stretches.size(); ++i) {
    const std::uint32_t block_index = path.stretches[i].block;
    const PathBlock& block = path.blocks[block_index];
    if (block.kind == PathKind::feed && block.spindle_on) continue;
    const Box& box = workpiece.removed().box(i);
    if (!overlap(box, blank)) continue;
    if (moves.empty() || !continues(path, moves.back(), block_index)) {
      moves.push_back({block_index, {}, box});
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
  const double pitch = workpiece.removed().tool(block.tool).body().max_radius() / 6.0;
  const Vec3 size = move.box.max - move.box.min;
  if (!(size.array() > 0.0).all()) return std::nullopt;
  Collision worst{.kind = block.kind == PathKind::rapid ? CollisionKind::rapid_through_material
                                                        : CollisionKind::feed_with_spindle_off,
                  .source_line = block.source_line,
                  .tool = block.tool};
  // At least four rays across whatever is there, so that a thin overlap is not stepped over.
  const auto count = [&](int k) {
    return std::max(4, static_cast<int>(std::ceil(size[k] / pitch)));
  };
  // The depth is the longest overlap along the direction in which the overlap is thinnest.
  for (int axis = 0; axis < 3; ++axis) {
    double longest = 0.0;
    Vec3 at = Vec3::Zero();
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const cutter::RaySpan span{0.0, size[axis]};
    for (int i = 0; i < count(u); ++i) {
      for (int j = 0; j < count(v); ++j) {
        const Ray ray{move.box.min + (i + 0.5) / count(u) * size[u] * Vec3::Unit(u) +
                          (j + 0.5) / count(v) * size[v] * Vec3::Unit(v),
                      Vec3::Unit(axis)};
        const IntervalSet covered = workpiece.removed()
                                        .core_along(ray, move.stretches, kMargin)
                                        .intersected(IntervalSet({{span.lo, span.hi}}));
        if (covered.empty()) continue;
        const IntervalSet met =
            workpiece.material_along(ray, span, move.stretches.front()).intersected(covered);
        for (const Interval& piece : met.intervals()) {
          if (piece.length() > longest) {
            longest = piece.length();
            at = ray.at(0.5 * (piece.lo + piece.hi));
          }
        }
      }
    }
    if (longest > kMargin && (worst.depth == 0.0 || longest < worst.depth)) {
      worst.depth = longest;
      worst.point = at;
    }
  }
  if (worst.depth == 0.0) return std::nullopt;
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
