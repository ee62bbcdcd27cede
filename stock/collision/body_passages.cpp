#include "stock/collision/body_passages.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "cutter/search/ray_search.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/swept_box.hpp"
#include "stock/solid/box_scene.hpp"

namespace frustum::stock {
namespace {

using cutter::Profile;
using cutter::SegmentMotion;
using kinematics::PathSegment;
using kinematics::ToolPath;

// Passages of which their whole sweep is asked first.
constexpr std::size_t kMany = 200;

Box box_of(const NonCuttingBody& body, const ToolPath& path, const PathSegment& segment) {
  const auto box_of_part = [&](const Profile& part) {
    return cutter::swept_box({part.bottom(), part.height(), part.max_radius()},
                             SegmentMotion(path, segment, part.reach()));
  };
  Box all = box_of_part(body.parts.front());
  for (const Profile& part : body.parts) all = united(all, box_of_part(part));
  return all;
}

// All that a body covers on its way, found as what a cutter removes is.
class BodySweep {
 public:
  BodySweep(const ToolPath& path, std::vector<std::uint32_t> segments, const cutter::Body& body)
      : path_(path), sweep_{&body, cutter::PoseTree(path, std::move(segments), body)} {}

  // Whether it covers enough for a collision of any piece of a ray before the block that takes the
  // piece away. `all` is what there was of the material before the program.
  [[nodiscard]] bool meets(const Ray& ray, const IntervalSet& all,
                           const Passages::Pieces& pieces) const {
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

}  // namespace

IntervalSet core_along(const Ray& ray, const NonCuttingBody& body, const ToolPath& path,
                       const PathSegment& segment) {
  std::vector<Interval> all;
  for (const Profile& part : body.parts) {
    const SegmentMotion motion(path, segment, part.reach());
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

struct Passages::OfBody {
  const NonCuttingBody* body = nullptr;
  std::optional<BodySweep> sweep{};  // where the body is known as a whole
  std::vector<std::uint32_t> segments{};
  std::vector<Box> boxes{};  // of the segments
  BoxScene scene{};          // of the boxes
};

Passages::Passages(const Workpiece& workpiece, const std::vector<NonCuttingBody>& bodies,
                   const std::set<BodyInBlock>& known)
    : path_(workpiece.removed().path()), blank_(workpiece.blank()) {
  for (const NonCuttingBody& body : bodies) collect(body, known);
}
Passages::~Passages() = default;

bool Passages::empty() const { return bodies_.empty(); }

std::vector<Passage> Passages::near(const Ray& ray, RaySpan span, const Pieces& pieces) const {
  std::vector<Passage> found;
  const BoxCrossing crossing(ray);
  for (const OfBody& each : bodies_) {
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

void Passages::collect(const NonCuttingBody& body, const std::set<BodyInBlock>& known) {
  const BoundingBox blank = blank_.bounds();
  if (body.parts.empty()) return;
  OfBody near_blank{&body};
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

}  // namespace frustum::stock
