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
#include <utility>

#include "stock/collision/body_depth.hpp"
#include "stock/collision/body_passages.hpp"
#include "stock/collision/collision.hpp"
#include "stock/solid/removal.hpp"

namespace frustum::stock {
namespace {

using kinematics::PathBlock;
using kinematics::PathKind;
using kinematics::PathSegment;
using kinematics::ToolPath;

using Hits = std::map<BodyInBlock, Overlap>;

void keep_longer(Hits& hits, const BodyInBlock& key, const Overlap& hit) {
  Overlap& best = hits[key];
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
  const ToolPath& path = workpiece.removed().path();
  Standing standing(workpiece, table, ray, span);
  const auto pieces = [&]() -> const std::vector<RemovedPiece>& { return standing.pieces(); };
  for (const Passage& passage : suspects(workpiece, passages.near(ray, span, pieces), ray)) {
    const PathSegment& segment = path.segments[passage.segment];
    const IntervalSet covered = core_along(ray, *passage.body, path, segment);
    if (covered.empty()) continue;
    const std::uint32_t block = segment.block;
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

Collision described(const ToolPath& path, const BodyInBlock& key, const Overlap& hit) {
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

// Of less there is nothing (mm).
constexpr double kThin = 1e-6;

// The fine rays are so far apart, and the few that are asked first.
struct Pitches {
  double fine = 0.0, coarse = 0.0;  // mm
};
Pitches pitches_for(const BoundingBox& blank, const std::vector<NonCuttingBody>& bodies) {
  const double side = (blank.max - blank.min).maxCoeff();
  double radius = std::numeric_limits<double>::infinity();
  for (const NonCuttingBody& body : bodies) {
    for (const cutter::Profile& part : body.parts) radius = std::min(radius, part.max_radius());
  }
  const double fine = std::max(std::min(side / 60.0, 0.25 * radius), side / 250.0);
  // Wherever it is, a body in the material is met by rays a radius apart.
  return {fine, std::clamp(radius, fine, 8.0 * fine)};
}

// Blocks that follow each other with one body in the material: one collision.
struct BlockRun {
  CollisionKind kind = CollisionKind::body_in_material;
  int tool = 0;
  std::vector<std::pair<BodyInBlock, Overlap>> hits{};  // block after block
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

// Of each block the longest overlap along the direction in which it is shortest. Of a block that
// rays along an axis have missed it is that at the place that others have found; on a plane between
// two cuts, which has no thickness, there is none.
Hits thinnest(const std::array<Hits, 3>& families, const DepthSearch& search) {
  Hits all;
  for (const Hits& family : families) {
    for (const auto& [key, hit] : family) {
      const auto [at, is_new] = all.emplace(key, hit);
      if (!is_new && hit.length < at->second.length) at->second = hit;
    }
  }
  for (auto& [key, hit] : all) {
    const auto has_it = [&key = key](const Hits& family) { return family.contains(key); };
    if (!std::ranges::all_of(families, has_it)) hit = search.depth_at(key, hit.point);
  }
  std::erase_if(all, [](const auto& hit) { return hit.second.length < kThin; });
  return all;
}

// Of the blocks that seem to be the deepest of their run the depth is searched for.
Collision described(const ToolPath& path, BlockRun run, const DepthSearch& search) {
  constexpr std::size_t kDeepest = 4;
  const BodyInBlock first = run.hits.front().first, last = run.hits.back().first;
  const auto deepest =
      run.hits.begin() + static_cast<std::ptrdiff_t>(std::min(kDeepest, run.hits.size()));
  std::ranges::partial_sort(run.hits, deepest, std::greater(), [](const auto& hit) {
    return std::pair(hit.second.length, -static_cast<std::int64_t>(hit.first.block));
  });
  Overlap most;
  for (auto hit = run.hits.begin(); hit != deepest; ++hit) {
    const Overlap depth = search.depth_near(hit->first, hit->second.point);
    if (depth.length > most.length) most = depth;
  }
  Collision whole = described(path, first, most);
  whole.last_line = path.blocks[last.block].source_line;
  return whole;
}

}  // namespace

std::vector<Collision> find_body_collisions(const Workpiece& workpiece,
                                            const std::vector<NonCuttingBody>& bodies) {
  const Passages passages(workpiece, bodies, {});
  if (passages.empty()) return {};
  const ToolPath& path = workpiece.removed().path();
  const Timetable table(path);
  const Pitches pitch = pitches_for(workpiece.blank().bounds(), bodies);
  const DepthSearch search(workpiece, table, bodies, 0.5 * pitch.coarse, 0.5 * pitch.fine);
  // Most blocks that collide are found by few rays.
  Hits hits = thinnest(hits_of(workpiece, table, passages, pitch.coarse), search);
  std::set<BodyInBlock> known;
  for (const auto& [key, hit] : hits) known.insert(key);
  const Passages others(workpiece, bodies, known);
  hits.merge(thinnest(hits_of(workpiece, table, others, pitch.fine), search));
  std::vector<Collision> found;
  for (BlockRun& run : block_runs_of(hits, path)) {
    found.push_back(described(path, std::move(run), search));
  }
  return found;
}

}  // namespace frustum::stock
