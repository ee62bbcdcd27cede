#include "cutter/search/path_climb.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/constants.hpp"

namespace frustum::cutter {
namespace {

// More would be another pass of the cutter.
constexpr std::int64_t kFarthest = 256;

// Blocks are looked at only where there are other tools: those of long programs are far away.
bool are_of_one_tool(const kinematics::ToolPath& path, const ToolSweep& sweep, std::uint32_t a,
                     std::uint32_t b) {
  if (a == b || sweep.tree.segments().size() == path.segments.size()) return true;
  return path.blocks[path.segments[a].block].tool == path.blocks[path.segments[b].block].tool;
}

class Climb {
 public:
  Climb(const RayQuestion& question, const Body& body, std::uint32_t segment, bool leaving)
      : question_(question), body_(body), segment_(segment), leaving_(leaving) {}

  [[nodiscard]] ClimbTop top() const {
    Place before = at(0), best = at(1);
    if (before.depth == -kInfinity && best.depth == -kInfinity) return {segment_, 0.0, false};
    const std::int64_t sense = best.depth > before.depth ? 1 : -1;
    if (sense < 0) std::swap(before, best);
    Place beyond = at(best.pose + sense);
    while (beyond.depth > best.depth) {
      const std::int64_t step = std::abs(beyond.pose - best.pose);
      const std::int64_t next = beyond.pose + sense * ahead(before, best, beyond, step);
      before = best;
      best = beyond;
      beyond = at(next);
    }
    return narrowed(before, best, beyond);
  }

 private:
  struct Place {
    std::int64_t pose;  // counted from the first of the segment
    double depth;
  };
  [[nodiscard]] Place at(std::int64_t pose) const { return {pose, depth(pose)}; }

  // Where the parabola through three places is highest, counted from the middle one in poses;
  // nothing where it has no top.
  [[nodiscard]] static std::optional<double> top_of(const Place& a, const Place& b,
                                                    const Place& c) {
    const auto to_a = static_cast<double>(a.pose - b.pose);
    const auto to_c = static_cast<double>(c.pose - b.pose);
    const double rise_a = (a.depth - b.depth) / to_a, rise_c = (c.depth - b.depth) / to_c;
    const double bend = (rise_c - rise_a) / (to_c - to_a);
    if (!(bend < 0.0) || std::isinf(bend)) return std::nullopt;
    return 0.5 * (to_c - rise_c / bend);
  }

  // By how many poses to go on, from a place beyond which it still rises: a little farther than
  // where the top seems to be.
  [[nodiscard]] static std::int64_t ahead(const Place& before, const Place& best,
                                          const Place& beyond, std::int64_t step) {
    constexpr double kMostGrowth = 64.0;
    const auto top = top_of(before, best, beyond);
    if (!top) return 2 * step;
    const double most = kMostGrowth * static_cast<double>(step);
    const double far = std::abs(*top) - static_cast<double>(step);
    return static_cast<std::int64_t>(std::clamp(std::ceil(far), 1.0, most));
  }

  // The segment beside the best of the poses from a to c; b is between them and not worse.
  [[nodiscard]] ClimbTop narrowed(Place a, Place b, Place c) const {
    for (int i = 0; std::abs(c.pose - a.pose) > 2; ++i) {
      const Place middle = at(between(a, b, c, i % 3 == 2));
      if (middle.depth > b.depth) {
        ((middle.pose > b.pose) == (c.pose > b.pose) ? a : c) = b;
        b = middle;
      } else {
        ((middle.pose > b.pose) == (c.pose > b.pose) ? c : a) = middle;
      }
    }
    const auto beside = [&](std::int64_t pose) {
      return a.pose == pose ? a : c.pose == pose ? c : at(pose);
    };
    return between_poses(beside(b.pose - 1), b, beside(b.pose + 1));
  }
  // By three poses in a row, the middle of which is the best.
  [[nodiscard]] ClimbTop between_poses(const Place& before, const Place& best,
                                       const Place& after) const {
    const bool is_after = after.depth > before.depth;
    const double t = std::clamp(top_of(before, best, after).value_or(0.0), -1.0, 1.0);
    const auto segment = segment_at(is_after ? best.pose : best.pose - 1);
    if (segment) return {*segment, is_after ? std::max(t, 0.0) : 1.0 + std::min(t, 0.0), true};
    const auto other = segment_at(best.pose);
    return {other.value_or(segment_), 0.0, true};
  }
  // A pose between a and c, but b: where the top seems to be, or `half` way on the longer side.
  [[nodiscard]] static std::int64_t between(const Place& a, const Place& b, const Place& c,
                                            bool half) {
    const std::int64_t longer =
        std::abs(c.pose - b.pose) > std::abs(b.pose - a.pose) ? c.pose : a.pose;
    const std::int64_t sense = longer > b.pose ? 1 : -1;
    const auto top = half ? std::nullopt : top_of(a, b, c);
    if (!top) return b.pose + sense * std::max<std::int64_t>(1, std::abs(longer - b.pose) / 2);
    const std::int64_t least = std::min(a.pose, c.pose) + 1, most = std::max(a.pose, c.pose) - 1;
    const std::int64_t next = std::clamp<std::int64_t>(b.pose + std::llround(*top), least, most);
    return next == b.pose ? b.pose + sense : next;
  }

  // Counted from the segment on; nothing where the path does not run on from pose to pose. Another
  // tool may do so.
  [[nodiscard]] std::optional<std::uint32_t> segment_at(std::int64_t offset) const {
    const auto& segments = question_.path->segments;
    const std::int64_t i = static_cast<std::int64_t>(segment_) + offset;
    const auto end = std::min<std::int64_t>(static_cast<std::int64_t>(segments.size()),
                                            question_.first_excluded);
    if (i < 0 || i >= end || std::abs(offset) > kFarthest) return std::nullopt;
    const std::int64_t pose = static_cast<std::int64_t>(segments[segment_].first_pose) + offset;
    if (static_cast<std::int64_t>(segments[static_cast<std::size_t>(i)].first_pose) != pose)
      return std::nullopt;
    return static_cast<std::uint32_t>(i);
  }

  // How far the cutter reaches at a pose, counted from the first of the segment; what is beside
  // the asked span is no reach.
  [[nodiscard]] double depth(std::int64_t offset) const {
    if (!segment_at(offset) && !segment_at(offset - 1)) return -kInfinity;
    const auto pose = static_cast<std::size_t>(
        static_cast<std::int64_t>(question_.path->segments[segment_].first_pose) + offset);
    double most = -kInfinity;
    for (const Profile& part : body_.parts()) {
      const auto chord = part.chord(question_.path->poses[pose], question_.ray);
      if (!chord || chord->lo > question_.span.hi || chord->hi < question_.span.lo) continue;
      most = std::max(most, leaving_ ? chord->hi : -chord->lo);
    }
    return most;
  }

  const RayQuestion& question_;
  const Body& body_;
  std::uint32_t segment_;
  bool leaving_;
};

}  // namespace

std::optional<std::uint32_t> next_at(const RayQuestion& question, const ToolSweep& sweep,
                                     std::uint32_t segment, double t) {
  if ((t != 0.0 && t != 1.0) || (t == 0.0 && segment == 0)) return std::nullopt;
  const kinematics::ToolPath& path = *question.path;
  const std::uint32_t next = t == 0.0 ? segment - 1 : segment + 1;
  if (next >= path.segments.size() || next >= question.first_excluded) return std::nullopt;
  const auto &here = path.segments[segment], &there = path.segments[next];
  const bool runs_on =
      t == 0.0 ? there.first_pose + 1 == here.first_pose : here.first_pose + 1 == there.first_pose;
  if (!runs_on || !are_of_one_tool(path, sweep, segment, next)) return std::nullopt;
  return next;
}

ClimbTop climbed(const RayQuestion& question, const ToolSweep& sweep, std::uint32_t segment,
                 bool leaving) {
  const ClimbTop top = Climb(question, *sweep.body, segment, leaving).top();
  if (are_of_one_tool(*question.path, sweep, top.segment, segment)) return top;
  return {segment, 0.0, false};
}

}  // namespace frustum::cutter
