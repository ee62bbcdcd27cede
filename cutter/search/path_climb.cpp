#include "cutter/search/path_climb.hpp"

#include <algorithm>
#include <cstdint>

#include "core/constants.hpp"

namespace frustum::cutter {
namespace {

// More would be another pass of the cutter.
constexpr std::int64_t kFarthest = 256;

class Climb {
 public:
  Climb(const RayQuestion& question, const Body& body, std::uint32_t segment, bool leaving)
      : question_(question), body_(body), segment_(segment), leaving_(leaving) {}

  [[nodiscard]] std::uint32_t top() const {
    const double here = depth(0), next = depth(1);
    if (here == -kInfinity && next == -kInfinity) return segment_;
    // Poses `at` and `beyond` in the sense of the climb; the best is between `from` and `beyond`.
    const std::int64_t sense = next > here ? 1 : -1;
    Place from{next > here ? 0 : 1, std::min(here, next)};
    Place best{next > here ? 1 : 0, std::max(here, next)};
    std::int64_t step = 1;
    for (;;) {
      const Place beyond = at(best.pose + sense * step);
      if (!(beyond.depth > best.depth)) return narrowed(from, best, beyond);
      from = best;
      best = beyond;
      step *= 2;
    }
  }

 private:
  struct Place {
    std::int64_t pose;  // counted from the first of the segment
    double depth;
  };
  [[nodiscard]] Place at(std::int64_t pose) const { return {pose, depth(pose)}; }

  // The segment beside the best of the poses from a to c; b is between them and better.
  [[nodiscard]] std::uint32_t narrowed(Place a, Place b, Place c) const {
    while (std::abs(c.pose - a.pose) > 2) {
      const bool upper = std::abs(c.pose - b.pose) > std::abs(b.pose - a.pose);
      const Place middle = at(upper ? (b.pose + c.pose) / 2 : (a.pose + b.pose) / 2);
      if (middle.pose == b.pose) break;
      if (middle.depth > b.depth) {
        (upper ? a : c) = b;
        b = middle;
      } else {
        (upper ? c : a) = middle;
      }
    }
    const auto beside = [&](std::int64_t pose) {
      return a.pose == pose ? a.depth : c.pose == pose ? c.depth : depth(pose);
    };
    const std::int64_t after = beside(b.pose + 1) > beside(b.pose - 1) ? b.pose : b.pose - 1;
    return segment_at(after).value_or(segment_at(b.pose).value_or(segment_));
  }

  // Counted from the segment on; nothing where the path of this tool does not run on.
  [[nodiscard]] std::optional<std::uint32_t> segment_at(std::int64_t offset) const {
    const auto& segments = question_.path->segments;
    const std::int64_t i = static_cast<std::int64_t>(segment_) + offset;
    const auto end = std::min<std::int64_t>(static_cast<std::int64_t>(segments.size()),
                                            question_.first_excluded);
    if (i < 0 || i >= end || std::abs(offset) > kFarthest) return std::nullopt;
    const auto& here = segments[segment_];
    const auto& there = segments[static_cast<std::size_t>(i)];
    const auto& blocks = question_.path->blocks;
    const bool runs_on = static_cast<std::int64_t>(there.first_pose) ==
                             static_cast<std::int64_t>(here.first_pose) + offset &&
                         blocks[there.block].tool == blocks[here.block].tool;
    if (!runs_on) return std::nullopt;
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

std::optional<std::uint32_t> next_at(const RayQuestion& question, std::uint32_t segment, double t) {
  if ((t != 0.0 && t != 1.0) || (t == 0.0 && segment == 0)) return std::nullopt;
  const kinematics::ToolPath& path = *question.path;
  const std::uint32_t next = t == 0.0 ? segment - 1 : segment + 1;
  if (next >= path.segments.size() || next >= question.first_excluded) return std::nullopt;
  const auto &here = path.segments[segment], &there = path.segments[next];
  const bool runs_on =
      t == 0.0 ? there.first_pose + 1 == here.first_pose : here.first_pose + 1 == there.first_pose;
  if (!runs_on || path.blocks[there.block].tool != path.blocks[here.block].tool)
    return std::nullopt;
  return next;
}

std::uint32_t climbed(const RayQuestion& question, const Body& body, std::uint32_t segment,
                      bool leaving) {
  return Climb(question, body, segment, leaving).top();
}

}  // namespace frustum::cutter
