// Shanks and holders against material. Along each ray of a grid the history of the material is
// known, piece by piece: a body that reaches a piece before the block that removes it has collided.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "cutter/search/ray_search.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/swept_box.hpp"
#include "stock/collision/collision.hpp"
#include "stock/solid/box_scene.hpp"
#include "stock/solid/removal.hpp"

namespace frustum::stock {
namespace {

using cutter::Profile;
using cutter::SegmentMotion;
using kinematics::PathBlock;
using kinematics::PathKind;
using kinematics::PathSegment;
using kinematics::ToolPath;

// mm of material within a body. What the body covers when it is shrunk by the margin it covers with
// the margin on both sides, or all that there is of the material.
constexpr double kEnough = 0.5 * kCollisionMargin;

// Passages of which their whole sweep is asked first.
constexpr std::size_t kMany = 200;

// One body on one segment, near a ray.
struct Passage {
  std::uint32_t segment = 0;
  const NonCuttingBody* body = nullptr;
  RaySpan span{};  // of the ray, within the box of all that the body covers
};

Box box_of(const NonCuttingBody& body, const ToolPath& path, const PathSegment& segment) {
  const auto box_of_part = [&](const Profile& part) {
    return cutter::swept_box({part.bottom(), part.height(), part.max_radius()},
                             SegmentMotion(path, segment, part.reach()));
  };
  Box all = box_of_part(body.parts.front());
  for (const Profile& part : body.parts) all = united(all, box_of_part(part));
  return all;
}

struct Key {
  std::uint32_t block = 0;
  CollisionBody body = CollisionBody::shank;
  auto operator<=>(const Key&) const = default;
};

// All that a body covers on its way, found as what a cutter removes is.
class BodySweep {
 public:
  BodySweep(const ToolPath& path, std::vector<std::uint32_t> segments, const cutter::Body& body)
      : path_(path), sweep_{&body, cutter::PoseTree(path, std::move(segments), body)} {}

  // Whether it covers enough for a collision of any piece of a ray before the block that takes the
  // piece away. `all` is what there was of the material before the program.
  template <class Pieces>
  [[nodiscard]] bool meets(const Ray& ray, const IntervalSet& all, const Pieces& pieces) const {
    const auto everything = static_cast<std::uint32_t>(path_.segments.size());
    const bool reaches_any = std::ranges::any_of(
        all.intervals(), [&](const Interval& piece) { return covers(ray, piece, everything); });
    return reaches_any && std::ranges::any_of(pieces(), [&](const RemovedPiece& r) {
             const auto taken = std::ranges::partition_point(
                 path_.segments, [&r](const PathSegment& s) { return s.block < r.block; });
             return covers(ray, r.piece,
                           static_cast<std::uint32_t>(taken - path_.segments.begin()));
           });
  }

 private:
  [[nodiscard]] bool covers(const Ray& ray, const Interval& piece,
                            std::uint32_t first_excluded) const {
    std::vector<cutter::SweptInterval> swept;
    cutter::extend_swept_interval({&path_, ray, {piece.lo, piece.hi}, first_excluded}, sweep_,
                                  swept);
    double length = 0.0;
    for (const cutter::SweptInterval& s : swept) {
      length += std::max(0.0, std::min(s.hi.s, piece.hi) - std::max(s.lo.s, piece.lo));
    }
    return length >= std::min(kEnough, 0.5 * piece.length());
  }

  const ToolPath& path_;
  cutter::ToolSweep sweep_;
};

// All passages that come near the blank. Their boxes are one scene a body, in which a ray finds
// them.
class Passages {
 public:
  // But those that are `known` to collide.
  Passages(const Workpiece& workpiece, const std::vector<NonCuttingBody>& bodies,
           const std::set<Key>& known)
      : path_(workpiece.removed().path()), blank_(workpiece.blank()) {
    for (const NonCuttingBody& body : bodies) collect(body, known);
  }

  [[nodiscard]] bool empty() const { return bodies_.empty(); }
  // But those of bodies that surely meet none of the pieces of material, each before the block that
  // takes it away; `pieces()` is asked for where that is worth it.
  template <class Pieces>
  [[nodiscard]] std::vector<Passage> near(const Ray& ray, RaySpan span,
                                          const Pieces& pieces) const {
    std::vector<Passage> found;
    const BoxCrossing crossing(ray);
    for (const BodyBoxes& each : bodies_) {
      if (each.sweep && !each.sweep->meets(ray, blank_.along(ray, span), pieces)) continue;
      const auto first = static_cast<std::ptrdiff_t>(found.size());
      each.scene.along(ray, span, [&](std::uint32_t box) {
        found.push_back({each.segments[box], each.body, crossing.within(each.boxes[box], span)});
        return span.hi;
      });
      // Embree's order is not fixed.
      std::sort(found.begin() + first, found.end(),
                [](const Passage& a, const Passage& b) { return a.segment < b.segment; });
    }
    return found;
  }
  [[nodiscard]] std::uint32_t block_index(const Passage& p) const {
    return path_.segments[p.segment].block;
  }
  // What the body, shrunk by the margin, surely covers: standing bodies a quarter of a radius
  // apart.
  [[nodiscard]] IntervalSet core_along(const Passage& p, const Ray& ray) const {
    const PathSegment& segment = path_.segments[p.segment];
    std::vector<Interval> all;
    for (const Profile& part : p.body->parts) {
      const SegmentMotion motion(path_, segment, part.reach());
      // All poses of the segment are within half its way of the middle.
      if (!part.chord(motion.at(0.5), ray, 0.5 * motion.travel())) continue;
      const int steps = 1 + static_cast<int>(motion.travel() / (0.25 * part.max_radius()));
      for (int k = 0; k <= steps; ++k) {
        const auto chord =
            part.chord(motion.at(static_cast<double>(k) / steps), ray, -kCollisionMargin);
        if (chord) all.push_back({chord->lo, chord->hi, 0, 0});
      }
    }
    return IntervalSet(std::move(all));
  }

 private:
  struct BodyBoxes {
    const NonCuttingBody* body = nullptr;
    std::optional<BodySweep> sweep{};  // where the body is known as a whole
    std::vector<std::uint32_t> segments{};
    std::vector<Box> boxes{};  // of the segments
    BoxScene scene{};          // of the boxes
  };

  void collect(const NonCuttingBody& body, const std::set<Key>& known) {
    const BoundingBox blank = blank_.bounds();
    if (body.parts.empty()) return;
    BodyBoxes near_blank{&body};
    for (std::uint32_t i = 0; i < path_.segments.size(); ++i) {
      const PathSegment& segment = path_.segments[i];
      if (body.tool != path_.blocks[segment.block].tool) continue;
      if (known.contains({segment.block, body.body})) continue;
      const Box box = box_of(body, path_, segment);
      if (!overlap(box, blank)) continue;
      near_blank.segments.push_back(i);
      near_blank.boxes.push_back(box);
    }
    if (near_blank.boxes.empty()) return;
    near_blank.scene = BoxScene(near_blank.boxes);
    if (body.whole && near_blank.boxes.size() > kMany)
      near_blank.sweep.emplace(path_, near_blank.segments, *body.whole);
    bodies_.push_back(std::move(near_blank));
  }

  const ToolPath& path_;
  const Blank& blank_;
  std::vector<BodyBoxes> bodies_{};
};

struct Longest {
  double length = 0.0;
  Vec3 point = Vec3::Zero();
};
using Hits = std::map<Key, Longest>;

void keep_longer(Hits& hits, const Key& key, const Longest& hit) {
  Longest& best = hits[key];
  if (hit.length > best.length) best = hit;
}

// The ray's material, each piece with the block that takes it away.
std::vector<RemovedPiece> history(const Workpiece& workpiece, const Timetable& table,
                                  const Ray& ray, RaySpan span) {
  std::vector<RemovedPiece> pieces = removed_along(workpiece, table, ray, span);
  const IntervalSet stays = workpiece.material_along(ray, span);
  for (const Interval& piece : stays.intervals()) pieces.push_back({table.blocks(), piece});
  return pieces;
}

// mm of the material within the span.
double length_within(const IntervalSet& material, const RaySpan& span) {
  double length = 0.0;
  for (const Interval& piece : material.intervals()) {
    length += std::max(0.0, std::min(piece.hi, span.hi) - std::max(piece.lo, span.lo));
  }
  return length;
}

// The passages that may meet what is left when the first of them begins. Most are beside it, which
// their boxes show at less cost than their bodies: what is shrunk by the margin is inside its box
// by the margin.
std::vector<Passage> suspects(const Workpiece& workpiece, std::vector<Passage> near,
                              const Ray& ray) {
  if (near.empty()) return near;
  std::uint32_t first = near.front().segment;
  RaySpan all = near.front().span;
  for (const Passage& passage : near) {
    first = std::min(first, passage.segment);
    all = {std::min(all.lo, passage.span.lo), std::max(all.hi, passage.span.hi)};
  }
  const IntervalSet left = workpiece.material_along(ray, all, first);
  std::erase_if(near, [&](const Passage& passage) {
    return left.empty() || length_within(left, passage.span) < kEnough;
  });
  return near;
}

// What stands along a ray after blocks: of many it is divided from the ray's history, of few it is
// asked for.
class Standing {
 public:
  Standing(const Workpiece& workpiece, const Timetable& table, const Ray& ray, RaySpan span)
      : workpiece_(workpiece), table_(table), ray_(ray), span_(span) {}

  [[nodiscard]] const std::vector<RemovedPiece>& pieces() {
    if (!known_) known_ = history(workpiece_, table_, ray_, span_);
    return *known_;
  }
  [[nodiscard]] IntervalSet after(std::uint32_t block) {
    constexpr int kFew = 8;
    if (!known_ && ++asked_ <= kFew) {
      return workpiece_.material_along(ray_, span_, table_.first_segment(block + 1));
    }
    std::vector<Interval> standing;
    for (const RemovedPiece& r : pieces()) {
      if (r.block > block) standing.push_back(r.piece);
    }
    return IntervalSet(std::move(standing));
  }

 private:
  const Workpiece& workpiece_;
  const Timetable& table_;
  const Ray& ray_;
  RaySpan span_;
  std::optional<std::vector<RemovedPiece>> known_{};
  int asked_ = 0;
};

void examine(const Workpiece& workpiece, const Timetable& table, const Passages& passages,
             const Ray& ray, RaySpan span, Hits& hits) {
  Standing standing(workpiece, table, ray, span);
  const auto pieces = [&]() -> const std::vector<RemovedPiece>& { return standing.pieces(); };
  for (const Passage& passage : suspects(workpiece, passages.near(ray, span, pieces), ray)) {
    const IntervalSet covered = passages.core_along(passage, ray);
    if (covered.empty()) continue;
    const std::uint32_t block = passages.block_index(passage);
    const IntervalSet met = standing.after(block).intersected(covered);
    for (const Interval& piece : met.intervals()) {
      keep_longer(hits, {block, passage.body->body},
                  {piece.length(), ray.at(0.5 * (piece.lo + piece.hi))});
    }
  }
}

Hits hits_of_family(const Workpiece& workpiece, const Timetable& table, const Passages& passages,
                    const CellRays& rays) {
  std::vector<Hits> rows(static_cast<std::size_t>(rays.count_v));
  tbb::parallel_for(0, rays.count_v, [&](int v) {
    for (int u = 0; u < rays.count_u; ++u) {
      examine(workpiece, table, passages, rays.ray(u, v), rays.span(),
              rows[static_cast<std::size_t>(v)]);
    }
  });
  Hits all;
  for (const Hits& row : rows) {
    for (const auto& [key, hit] : row) keep_longer(all, key, hit);
  }
  return all;
}

// Rays that far apart along each axis.
std::array<Hits, 3> hits_of(const Workpiece& workpiece, const Timetable& table,
                            const Passages& passages, double pitch) {
  std::array<Hits, 3> families;
  if (passages.empty()) return families;
  for (int axis = 0; axis < 3; ++axis) {
    families[static_cast<std::size_t>(axis)] = hits_of_family(
        workpiece, table, passages, CellRays::over(workpiece.blank().bounds(), axis, pitch));
  }
  return families;
}

// The longest overlap along the direction in which the overlap is thinnest.
Hits thinnest(const std::array<Hits, 3>& families) {
  Hits all;
  for (const Hits& family : families) {
    for (const auto& [key, hit] : family) {
      const auto [at, is_new] = all.emplace(key, hit);
      if (!is_new && hit.length < at->second.length) at->second = hit;
    }
  }
  return all;
}

Collision described(const ToolPath& path, const Key& key, const Longest& hit) {
  const PathBlock& block = path.blocks[key.block];
  return {.kind = block.kind == PathKind::rapid ? CollisionKind::rapid_through_material
                                                : CollisionKind::body_in_material,
          .body = key.body,
          .block = key.block,
          .source_line = block.source_line,
          .source_file = block.source_file,
          .last_line = block.source_line,
          .tool = block.tool,
          .point = hit.point,
          .depth = hit.length + kCollisionMargin};
}

// The fine rays are so far apart, and the few that are asked first.
struct Pitches {
  double fine = 0.0, coarse = 0.0;  // mm
};
Pitches pitches_for(const BoundingBox& blank, const std::vector<NonCuttingBody>& bodies) {
  const double side = (blank.max - blank.min).maxCoeff();
  double radius = std::numeric_limits<double>::infinity();
  for (const NonCuttingBody& body : bodies) {
    for (const Profile& part : body.parts) radius = std::min(radius, part.max_radius());
  }
  const double fine = std::max(std::min(side / 60.0, 0.25 * radius), side / 250.0);
  // Wherever it is, a body in the material is met by rays a radius apart.
  return {fine, std::clamp(radius, fine, 8.0 * fine)};
}

// Blocks that follow each other with one body in the material: one collision.
struct BlockRun {
  CollisionKind kind = CollisionKind::body_in_material;
  int tool = 0;
  std::vector<std::pair<Key, Longest>> hits{};  // block after block
};
std::vector<BlockRun> block_runs_of(const Hits& hits, const ToolPath& path) {
  std::vector<BlockRun> found;
  std::map<CollisionBody, std::size_t> open;
  for (const auto& hit : hits) {
    const Collision here = described(path, hit.first, hit.second);
    const auto before = open.find(hit.first.body);
    if (before != open.end()) {
      BlockRun& last = found[before->second];
      if (last.hits.back().first.block + 1 == hit.first.block && last.kind == here.kind &&
          last.tool == here.tool) {
        last.hits.emplace_back(hit);
        continue;
      }
    }
    open[hit.first.body] = found.size();
    found.push_back({here.kind, here.tool, {hit}});
  }
  return found;
}

Collision described(const ToolPath& path, const BlockRun& run) {
  const auto deepest =
      std::ranges::max_element(run.hits, {}, [](const auto& hit) { return hit.second.length; });
  Collision whole = described(path, run.hits.front().first, deepest->second);
  whole.last_line = path.blocks[run.hits.back().first.block].source_line;
  return whole;
}

// Of blocks that few rays have shown to collide, along each axis, those that are not among the
// deepest of their run: what the whole run reports is found from others. A body that is in the
// material for thousands of blocks would be followed along each of many rays.
Hits told_by_few(const std::array<Hits, 3>& families, const ToolPath& path) {
  constexpr std::size_t kDeepest = 32;
  Hits told;
  for (BlockRun& run : block_runs_of(thinnest(families), path)) {
    std::ranges::stable_sort(run.hits, std::greater(),
                             [](const auto& hit) { return hit.second.length; });
    for (std::size_t k = kDeepest; k < run.hits.size(); ++k) {
      const auto& hit = run.hits[k];
      const bool is_in_all = std::ranges::all_of(
          families, [&hit](const Hits& family) { return family.contains(hit.first); });
      if (is_in_all) told.insert(hit);
    }
  }
  return told;
}

}  // namespace

std::vector<Collision> find_body_collisions(const Workpiece& workpiece,
                                            const std::vector<NonCuttingBody>& bodies) {
  const Passages passages(workpiece, bodies, {});
  if (passages.empty()) return {};
  const ToolPath& path = workpiece.removed().path();
  const Timetable table(path);
  const Pitches pitch = pitches_for(workpiece.blank().bounds(), bodies);
  Hits hits = told_by_few(hits_of(workpiece, table, passages, pitch.coarse), path);
  std::set<Key> known;
  for (const auto& [key, hit] : hits) known.insert(key);
  hits.merge(thinnest(hits_of(workpiece, table, Passages(workpiece, bodies, known), pitch.fine)));
  std::vector<Collision> found;
  for (const BlockRun& run : block_runs_of(hits, path)) found.push_back(described(path, run));
  return found;
}

}  // namespace frustum::stock
