// Shanks and holders against material. Along each ray of a grid the history of the material is
// known, piece by piece: a body that reaches a piece before the block that removes it has collided.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

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

// All passages that come near the blank. Their boxes are one scene a body, in which a ray finds
// them.
class Passages {
 public:
  // But those that are `known` to collide.
  Passages(const Workpiece& workpiece, const std::vector<NonCuttingBody>& bodies,
           const std::set<Key>& known)
      : path_(workpiece.removed().path()) {
    for (const NonCuttingBody& body : bodies) collect(workpiece.blank().bounds(), body, known);
  }

  [[nodiscard]] bool empty() const { return bodies_.empty(); }
  [[nodiscard]] std::vector<Passage> near(const Ray& ray, RaySpan span) const {
    std::vector<Passage> found;
    const BoxCrossing crossing(ray);
    for (const BodyBoxes& each : bodies_) {
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
    std::vector<std::uint32_t> segments{};
    std::vector<Box> boxes{};  // of the segments
    BoxScene scene{};          // of the boxes
  };

  void collect(const BoundingBox& blank, const NonCuttingBody& body, const std::set<Key>& known) {
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
    bodies_.push_back(std::move(near_blank));
  }

  const ToolPath& path_;
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
    return left.empty() || length_within(left, passage.span) < 0.5 * kCollisionMargin;
  });
  return near;
}

void examine(const Workpiece& workpiece, const Timetable& table, const Passages& passages,
             const Ray& ray, RaySpan span, Hits& hits) {
  std::vector<RemovedPiece> pieces;
  for (const Passage& passage : suspects(workpiece, passages.near(ray, span), ray)) {
    const IntervalSet covered = passages.core_along(passage, ray);
    if (covered.empty()) continue;
    if (pieces.empty()) pieces = history(workpiece, table, ray, span);
    const std::uint32_t block = passages.block_index(passage);
    std::vector<Interval> standing;
    for (const RemovedPiece& r : pieces) {
      if (r.block > block) standing.push_back(r.piece);
    }
    const IntervalSet met = IntervalSet(std::move(standing)).intersected(covered);
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

double radius_of(const NonCuttingBody& body) {
  double radius = 0.0;
  for (const Profile& part : body.parts) radius = std::max(radius, part.max_radius());
  return radius;
}

double pitch_for(const BoundingBox& blank, const std::vector<NonCuttingBody>& bodies) {
  const double side = (blank.max - blank.min).maxCoeff();
  double pitch = side / 60.0;
  for (const NonCuttingBody& body : bodies) {
    for (const Profile& part : body.parts) pitch = std::min(pitch, 0.25 * part.max_radius());
  }
  return std::max(pitch, side / 250.0);
}

// Of overlaps that few rays have found along each axis those deeper than the body's radius: nobody
// asks how deep these are to the last bit, and a body that is in the material all the way would be
// followed along each of many rays.
Hits deep_ones(const std::array<Hits, 3>& families, const ToolPath& path,
               const std::vector<NonCuttingBody>& bodies) {
  std::map<std::pair<int, CollisionBody>, double> radius;
  for (const NonCuttingBody& body : bodies) radius[{body.tool, body.body}] = radius_of(body);
  Hits deep = thinnest(families);
  std::erase_if(deep, [&](const auto& found) {
    const Key& key = found.first;
    return found.second.length <= radius.at({path.blocks[key.block].tool, key.body}) ||
           std::ranges::any_of(families,
                               [&key](const Hits& family) { return !family.contains(key); });
  });
  return deep;
}

}  // namespace

std::vector<Collision> find_body_collisions(const Workpiece& workpiece,
                                            const std::vector<NonCuttingBody>& bodies) {
  const Passages passages(workpiece, bodies, {});
  if (passages.empty()) return {};
  const ToolPath& path = workpiece.removed().path();
  const Timetable table(path);
  const double pitch = pitch_for(workpiece.blank().bounds(), bodies);
  constexpr double kCoarse = 4.0;  // a sixteenth of the rays
  Hits hits = deep_ones(hits_of(workpiece, table, passages, kCoarse * pitch), path, bodies);
  std::set<Key> known;
  for (const auto& [key, hit] : hits) known.insert(key);
  hits.merge(thinnest(hits_of(workpiece, table, Passages(workpiece, bodies, known), pitch)));
  // Blocks that follow each other make one collision, of each body.
  std::vector<Collision> found;
  std::map<CollisionBody, std::pair<std::size_t, std::uint32_t>> open;  // its index and last block
  for (const auto& [key, hit] : hits) {
    const Collision here = described(path, key, hit);
    const auto before = open.find(key.body);
    const bool goes_on = before != open.end() && before->second.second + 1 == key.block &&
                         found[before->second.first].kind == here.kind &&
                         found[before->second.first].tool == here.tool;
    if (!goes_on) {
      open[key.body] = {found.size(), key.block};
      found.push_back(here);
      continue;
    }
    Collision& whole = found[before->second.first];
    before->second.second = key.block;
    whole.last_line = here.source_line;
    if (here.depth > whole.depth) {
      whole.depth = here.depth;
      whole.point = here.point;
    }
  }
  return found;
}

}  // namespace frustum::stock
