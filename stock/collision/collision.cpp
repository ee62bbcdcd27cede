#include "stock/collision/collision.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

namespace frustum::stock {
namespace {

using cutter::Body;
using cutter::Profile;
using kinematics::PathBlock;
using kinematics::PathKind;
using kinematics::PathSegment;
using kinematics::SpindleDirection;
using kinematics::ToolPath;
using kinematics::ToolPose;

// The segments of one block that come near the blank.
struct SuspectMove {
  std::uint32_t block = 0;
  std::vector<std::uint32_t> segments{};
  Box box{};
};

// Feeds of one tool with the spindle off that follow each other are one move: one report is enough.
// What a block between them cuts would be missing.
bool continues(const ToolPath& path, const SuspectMove& move, std::uint32_t block) {
  if (move.block == block) return true;
  const std::uint32_t last = path.segments[move.segments.back()].block;
  const PathBlock &before = path.blocks[last], &now = path.blocks[block];
  if (before.kind != PathKind::feed || now.kind != PathKind::feed) return false;
  const auto cuts = [](const PathBlock& between) {
    return between.kind == PathKind::feed && between.spindle_on();
  };
  return before.tool == now.tool &&
         std::none_of(path.blocks.begin() + last, path.blocks.begin() + block, cuts);
}

// Of the blocks that `is_suspect`; one that `goes_on` from the move before belongs to it.
template <typename IsSuspect, typename GoesOn>
std::vector<SuspectMove> suspects(const Workpiece& workpiece, const IsSuspect& is_suspect,
                                  const GoesOn& goes_on) {
  const ToolPath& path = workpiece.removed().path();
  const BoundingBox blank = workpiece.blank().bounds();
  std::vector<SuspectMove> moves;
  for (std::uint32_t i = 0; i < path.segments.size(); ++i) {
    const std::uint32_t block_index = path.segments[i].block;
    if (!is_suspect(block_index)) continue;
    const Box& box = workpiece.removed().box(i);
    if (!overlap(box, blank)) continue;
    if (moves.empty() || !goes_on(moves.back(), block_index)) {
      moves.push_back({block_index, {}, box});
    }
    SuspectMove& move = moves.back();
    move.segments.push_back(i);
    move.box = united(move.box, box);
  }
  for (SuspectMove& move : moves) {
    move.box = {move.box.min.cwiseMax(blank.min), move.box.max.cwiseMin(blank.max)};
  }
  return moves;
}

// A ring around the axis on the surface of the shrunk body.
struct Ring {
  double radius = 0.0;
  double z = 0.0;
};

std::vector<Ring> rings_of(const Profile& body) {
  constexpr double kInside = 1e-4;  // mm, of the body that is shrunk by the margin
  const double inset = kCollisionMargin + kInside;
  const double step = body.max_radius() / 3.0;
  std::vector<Ring> rings;
  const auto add_at = [&](double z) {
    const Ray across{Vec3(0, 0, z), Vec3::UnitX()};
    const auto chord = body.chord({Vec3::Zero(), Vec3::UnitZ()}, across, -inset);
    if (chord && chord->hi > 0.0) rings.push_back({chord->hi, z});
  };
  const double bottom = body.bottom() + 1.01 * inset, top = body.height() - 1.01 * inset;
  const int levels = 1 + static_cast<int>(std::max(0.0, top - bottom) / step);
  for (int k = 0; k <= levels; ++k) add_at(bottom + (top - bottom) * k / levels);
  if (rings.empty()) return rings;
  // What a plunge meets first.
  const Ring lowest = rings.front();
  for (const double share : {0.0, 1.0 / 3.0, 2.0 / 3.0}) {
    rings.push_back({share * lowest.radius, lowest.z});
  }
  return rings;
}

// Box of the material that the cutter surely meets on this straight segment, seen along the motion.
class OverlapSearch {
 public:
  OverlapSearch(const Workpiece& workpiece, const SuspectMove& move)
      : workpiece_(workpiece), first_(move.segments.front()) {}

  // The segment must be straight.
  void follow(const Profile& body, const std::vector<Ring>& rings, const ToolPose& from,
              const ToolPose& to) {
    const Vec3 way = to.tip - from.tip;
    const double length = way.norm();
    const Vec3 direction = length > 0.0 ? Vec3(way / length) : from.axis;
    const Vec3 side = any_normal(from.axis);
    const Vec3 other = from.axis.cross(side);
    constexpr int kAround = 16;
    const bool square = std::abs(direction.dot(from.axis)) < 1e-9;
    for (const Ring& ring : rings) {
      const int around = ring.radius > 0.0 ? kAround : 1;
      for (int j = 0; j < around; ++j) {
        const double angle = 2.0 * std::numbers::pi * j / around;
        const Vec3 out = std::cos(angle) * side + std::sin(angle) * other;
        // Square to the axis, the rays through the back of a ring are those through its front.
        if (square && out.dot(direction) < -1e-9) continue;
        const Vec3 at = from.tip + ring.z * from.axis + ring.radius * out;
        follow_ray({at, direction}, body, from, length);
      }
    }
  }

  [[nodiscard]] const std::optional<Box>& found() const { return found_; }

 private:
  static Vec3 any_normal(const Vec3& axis) {
    Eigen::Index least = 0;
    axis.cwiseAbs().minCoeff(&least);
    return axis.cross(Vec3::Unit(least)).normalized();
  }

  void follow_ray(const Ray& ray, const Profile& body, const ToolPose& from, double length) {
    const auto chord = body.chord(from, ray, -kCollisionMargin);
    if (!chord) return;
    const RaySpan span{chord->lo, chord->hi + length};
    if (workpiece_.blank().along(ray, span).minus(lately_removed(ray)).empty()) return;
    const IntervalSet met = workpiece_.material_along(ray, span, first_);
    for (const Interval& piece : met.intervals()) {
      const Vec3 a = ray.at(piece.lo), b = ray.at(piece.hi);
      if (!found_) found_ = Box{a, a};
      found_->min = found_->min.cwiseMin(a.cwiseMin(b));
      found_->max = found_->max.cwiseMax(a.cwiseMax(b));
    }
  }

  // Some of what the few segments before the move have removed: most rapids run where the tool has
  // just been, and this is much cheaper than to ask the whole program.
  [[nodiscard]] IntervalSet lately_removed(const Ray& ray) const {
    constexpr std::uint32_t kLately = 8;
    const ToolPath& path = workpiece_.removed().path();
    std::vector<Interval> all;
    for (std::uint32_t i = first_ - std::min(first_, kLately); i < first_; ++i) {
      const PathSegment& s = path.segments[i];
      const Vec3 way = path.to(s).tip - path.from(s).tip;
      const bool along = path.from(s).axis == path.to(s).axis &&
                         way.cross(ray.direction).norm() <= 1e-12 * way.norm();
      for (const Profile& part :
           workpiece_.removed().tool(path.blocks[s.block].tool).body().parts()) {
        const auto a = part.chord(path.from(s), ray), b = part.chord(path.to(s), ray);
        if (a) all.push_back({a->lo, a->hi});
        if (b) all.push_back({b->lo, b->hi});
        // Moving along the ray, the part also covers what is between.
        if (a && b && along) all.push_back({std::min(a->lo, b->lo), std::max(a->hi, b->hi)});
      }
    }
    return IntervalSet(std::move(all));
  }

  const Workpiece& workpiece_;
  std::uint32_t first_;
  std::optional<Box> found_{};
};

// Where there is something to measure, and by how many rays across at most.
struct Suspicion {
  Box box{};
  int most_rays = 0;
};

// Nothing when there is no overlap; turning moves and concave cutters are measured all over.
std::optional<Suspicion> suspicion(const Workpiece& workpiece, const SuspectMove& move) {
  constexpr std::size_t kMostSegments = 4;
  const ToolPath& path = workpiece.removed().path();
  const auto turns = [&](std::uint32_t i) {
    const PathSegment& s = path.segments[i];
    return path.from(s).axis != path.to(s).axis;
  };
  const Body& body = workpiece.removed().tool(path.blocks[move.block].tool).body();
  if (move.segments.size() > kMostSegments || !body.concave().empty() ||
      std::ranges::any_of(move.segments, turns)) {
    constexpr int kMost = 128;
    return Suspicion{move.box, kMost};
  }
  OverlapSearch search(workpiece, move);
  for (const Profile& part : body.parts()) {
    const std::vector<Ring> rings = rings_of(part);
    for (const std::uint32_t i : move.segments) {
      search.follow(part, rings, path.from(path.segments[i]), path.to(path.segments[i]));
    }
  }
  if (!search.found()) return std::nullopt;
  // The next ray, which met nothing, was not farther away than this.
  const Vec3 around = Vec3::Constant(0.4 * body.max_radius());
  constexpr int kEnoughForADepth = 24;
  return Suspicion{{(search.found()->min - around).cwiseMax(move.box.min),
                    (search.found()->max + around).cwiseMin(move.box.max)},
                   kEnoughForADepth};
}

struct Overlap {
  double depth = 0.0;
  Vec3 point = Vec3::Zero();
};

// The depth is the longest overlap along the direction in which it is thinnest, of those whose rays
// have met any; the margin by which the body was shrunk belongs to it.
Overlap measured_overlap(const Workpiece& workpiece, const SuspectMove& move,
                         const Suspicion& where, double pitch) {
  const Box& box = where.box;
  const Vec3 size = box.max - box.min;
  std::vector<Box> boxes;
  boxes.reserve(move.segments.size());
  for (const std::uint32_t i : move.segments) boxes.push_back(workpiece.removed().box(i));
  Overlap worst;
  if (!(size.array() > 0.0).all()) return worst;
  // At least four rays across whatever is there, so that a thin overlap is not stepped over.
  const auto count = [&](int k) {
    return std::clamp(static_cast<int>(std::ceil(size[k] / pitch)), 4, where.most_rays);
  };
  for (int axis = 0; axis < 3; ++axis) {
    double longest = 0.0;
    Vec3 at = Vec3::Zero();
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const RaySpan span{0.0, size[axis]};
    for (int i = 0; i < count(u); ++i) {
      const double across = box.min[u] + (i + 0.5) / count(u) * size[u];
      std::vector<std::size_t> beside;  // segments that rays of this row may meet
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (boxes[k].min[u] <= across && across <= boxes[k].max[u]) beside.push_back(k);
      }
      for (int j = 0; j < count(v); ++j) {
        Ray ray{box.min, Vec3::Unit(axis)};
        ray.origin[u] = across;
        ray.origin[v] += (j + 0.5) / count(v) * size[v];
        std::vector<std::uint32_t> met_segments;
        for (const std::size_t k : beside) {
          const bool may_meet =
              boxes[k].min[v] <= ray.origin[v] && ray.origin[v] <= boxes[k].max[v];
          if (may_meet) met_segments.push_back(move.segments[k]);
        }
        const IntervalSet covered = workpiece.removed()
                                        .core_along(ray, met_segments, kCollisionMargin)
                                        .intersected(IntervalSet({{span.lo, span.hi}}));
        if (covered.empty()) continue;
        const IntervalSet met =
            workpiece.material_along(ray, span, move.segments.front()).intersected(covered);
        for (const Interval& piece : met.intervals()) {
          if (piece.length() > longest) {
            longest = piece.length();
            at = ray.at(0.5 * (piece.lo + piece.hi));
          }
        }
      }
    }
    if (longest == 0.0) continue;
    const double depth = longest + kCollisionMargin;
    if (worst.depth == 0.0 || depth < worst.depth) worst = {depth, at};
  }
  return worst;
}

std::optional<Collision> examine(const Workpiece& workpiece, const SuspectMove& move) {
  const std::optional<Suspicion> where = suspicion(workpiece, move);
  if (!where) return std::nullopt;
  const PathBlock& block = workpiece.removed().path().blocks[move.block];
  const double pitch = workpiece.removed().tool(block.tool).body().max_radius() / 6.0;
  const Overlap worst = measured_overlap(workpiece, move, *where, pitch);
  if (worst.depth == 0.0) return std::nullopt;
  const std::uint32_t last = workpiece.removed().path().segments[move.segments.back()].block;
  return Collision{.kind = block.kind == PathKind::rapid ? CollisionKind::rapid_through_material
                                                         : CollisionKind::feed_with_spindle_off,
                   .body = CollisionBody::cutter,
                   .block = move.block,
                   .source_line = block.source_line,
                   .source_file = block.source_file,
                   .last_line = workpiece.removed().path().blocks[last].source_line,
                   .tool = block.tool,
                   .point = worst.point,
                   .depth = worst.depth};
}

SpindleDirection against(cutter::CutterHand hand) {
  return hand == cutter::CutterHand::right ? SpindleDirection::counterclockwise
                                           : SpindleDirection::clockwise;
}

// Feeds while the spindle turns against the hand of the tool, but those of taps.
class FeedsAgainstHand {
 public:
  explicit FeedsAgainstHand(const Workpiece& workpiece)
      : swept_(workpiece.removed()), ends_(swept_.path().blocks.size()) {
    const ToolPath& path = swept_.path();
    for (const PathSegment& segment : path.segments) {
      Ends& ends = ends_[segment.block];
      if (ends.from == nullptr) ends.from = &path.from(segment);
      ends.to = &path.to(segment);
    }
  }

  [[nodiscard]] bool has(std::uint32_t index) const {
    const PathBlock& block = swept_.path().blocks[index];
    if (block.kind != PathKind::feed) return false;
    return block.spindle == against(swept_.tool(block.tool).spec().hand) && !is_of_tap(index);
  }
  // The block is the first one after the spindle or the tool has changed.
  [[nodiscard]] bool begins_stretch(std::uint32_t before, std::uint32_t index) const {
    const auto& blocks = swept_.path().blocks;
    for (std::uint32_t i = before; i < index; ++i) {
      if (blocks[i + 1].spindle != blocks[i].spindle || blocks[i + 1].tool != blocks[i].tool) {
        return true;
      }
    }
    return false;
  }

 private:
  struct Ends {
    const ToolPose* from = nullptr;
    const ToolPose* to = nullptr;
  };

  // Share of the way along the tool axis: 1 out of a hole, -1 into it; nothing where nothing moves.
  [[nodiscard]] std::optional<double> outwards(std::uint32_t index) const {
    const Ends& ends = ends_[index];
    if (ends.from == nullptr) return std::nullopt;
    const Vec3 way = ends.to->tip - ends.from->tip;
    const double length = way.norm();
    if (!(length > 0.0)) return std::nullopt;
    return way.dot(ends.from->axis) / length;
  }

  // A tap goes in along its axis and comes back with the spindle reversed.
  [[nodiscard]] bool is_of_tap(std::uint32_t index) const {
    constexpr double kAlong = 0.999;  // machines with errors do not go quite along the axis
    const auto& blocks = swept_.path().blocks;
    const std::optional<double> in = outwards(index);
    if (!in || *in > -kAlong) return false;
    for (std::uint32_t i = index + 1; i < blocks.size(); ++i) {
      if (blocks[i].kind != PathKind::feed || blocks[i].tool != blocks[index].tool) return false;
      const std::optional<double> next = outwards(i);
      if (!next) continue;
      if (std::abs(*next) < kAlong) return false;
      if (*next > 0.0) {
        return blocks[i].spindle != blocks[index].spindle &&
               blocks[i].spindle != SpindleDirection::off;
      }
    }
    return false;
  }

  const cutter::SweptCutter& swept_;
  std::vector<Ends> ends_;
};

}  // namespace

std::vector<std::uint32_t> cuts_against_hand(const Workpiece& workpiece) {
  const FeedsAgainstHand feeds(workpiece);
  const std::vector<SuspectMove> moves = suspects(
      workpiece, [&](std::uint32_t block) { return feeds.has(block); },
      [](const SuspectMove& move, std::uint32_t block) { return move.block == block; });
  std::vector<std::uint32_t> found;
  for (const SuspectMove& move : moves) {
    if (!found.empty() && !feeds.begins_stretch(found.back(), move.block)) continue;
    if (examine(workpiece, move)) found.push_back(move.block);
  }
  return found;
}

std::vector<Collision> find_cutter_collisions(const Workpiece& workpiece) {
  const ToolPath& path = workpiece.removed().path();
  const std::vector<SuspectMove> moves = suspects(
      workpiece,
      [&](std::uint32_t block) {
        return path.blocks[block].kind == PathKind::rapid || !path.blocks[block].spindle_on();
      },
      [&](const SuspectMove& move, std::uint32_t block) { return continues(path, move, block); });
  std::vector<std::optional<Collision>> examined(moves.size());
  tbb::parallel_for(std::size_t{0}, moves.size(),
                    [&](std::size_t i) { examined[i] = examine(workpiece, moves[i]); });
  std::vector<Collision> found;
  for (const auto& collision : examined) {
    if (collision) found.push_back(*collision);
  }
  return found;
}

std::vector<NonCuttingBody> non_cutting_bodies(const Workpiece& workpiece) {
  const cutter::SweptCutter& swept = workpiece.removed();
  std::set<int> numbers;
  for (const PathBlock& block : swept.path().blocks) numbers.insert(block.tool);
  std::vector<NonCuttingBody> bodies;
  const auto add = [&](int tool, CollisionBody which, const std::optional<cutter::Body>& body) {
    if (!body) return;
    bodies.push_back({tool, which, {body->parts().begin(), body->parts().end()}, body});
  };
  for (const int number : numbers) {
    add(number, CollisionBody::shank, swept.tool(number).shank());
    add(number, CollisionBody::holder, swept.tool(number).holder());
  }
  return bodies;
}

std::vector<Collision> find_collisions(const Workpiece& workpiece) {
  std::vector<Collision> found = find_cutter_collisions(workpiece);
  const auto bodies = find_body_collisions(workpiece, non_cutting_bodies(workpiece));
  found.insert(found.end(), bodies.begin(), bodies.end());
  std::ranges::stable_sort(found, [](const Collision& a, const Collision& b) {
    return std::tie(a.block, a.body) < std::tie(b.block, b.body);
  });
  return found;
}

}  // namespace frustum::stock
