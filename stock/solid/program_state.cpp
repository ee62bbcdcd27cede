#include "stock/solid/program_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace frustum::stock {
namespace {

using kinematics::PathSegment;
using kinematics::ToolPath;

ProgramState state_after(const ToolPath& path, std::uint32_t segments, double time) {
  ProgramState program_state{.segments = segments, .time = time};
  if (segments > 0) {
    program_state.block = path.segments[segments - 1].block;
    program_state.source_line = path.blocks[*program_state.block].source_line;
  }
  return program_state;
}

ProgramState before(const ToolPath& path, const Timetable& table, std::uint32_t segment) {
  return state_after(path, segment, table.start(segment));
}

// Rays of a plane-filling triad through the point: one of them meets any surface at 55 degrees or
// less from its normal.
std::array<Ray, 3> rays_through(const Vec3& point, double back) {
  std::array<Ray, 3> rays;
  for (int k = 0; k < 3; ++k) {
    rays[static_cast<std::size_t>(k)] = {point - back * Vec3::Unit(k), Vec3::Unit(k)};
  }
  return rays;
}

}  // namespace

Timetable::Timetable(const ToolPath& path) : first_(path.blocks.size() + 1) {
  const auto count = static_cast<std::uint32_t>(path.segments.size());
  std::uint32_t next = 0;
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    while (next < count && path.segments[next].block < block) ++next;
    first_[block] = next;
  }
  first_.back() = count;

  starts_.reserve(count + 1);
  if (path.times.size() == path.poses.size() && !path.times.empty()) {
    for (const PathSegment& s : path.segments) starts_.push_back(path.times[s.first_pose]);
    starts_.push_back(count == 0 ? 0.0 : path.times[path.segments.back().first_pose + 1]);
    return;
  }
  double block_start = 0.0;
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    const std::uint32_t segments = first_[block + 1] - first_[block];
    for (std::uint32_t k = 0; k < segments; ++k) {
      starts_.push_back(block_start + path.blocks[block].duration * k / segments);
    }
    block_start += path.blocks[block].duration;
  }
  starts_.push_back(block_start);
}

double Timetable::time(std::uint32_t segment, double t) const {
  return starts_[segment] + t * (starts_[segment + 1] - starts_[segment]);
}

ProgramState start_of(const ToolPath& path) { return state_after(path, 0, 0.0); }

ProgramState end_of(const ToolPath& path) {
  return state_after(path, static_cast<std::uint32_t>(path.segments.size()), Timetable(path).end());
}

ProgramState after_block(const ToolPath& path, std::uint32_t block) {
  const Timetable table(path);
  return before(path, table, table.first_segment(block + 1));
}

Result<ProgramState> after_line(const ToolPath& path, std::uint32_t line) {
  if (line == 0)
    return error("program-line"_id, "line 0 of the program does not exist",
                 "lines are counted from 1");
  std::optional<std::uint32_t> last;
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    const std::uint32_t here = path.blocks[block].source_line;
    if (here <= line && (!last || here >= path.blocks[*last].source_line)) last = block;
  }
  return last ? after_block(path, *last) : start_of(path);
}

Result<ProgramState> at_time(const ToolPath& path, double seconds) {
  if (!(seconds >= 0.0)) {
    return error("program-time"_id, fmt::format("{} s is no time of the program", seconds),
                 "seconds since its start, 0 or more");
  }
  const Timetable table(path);
  std::uint32_t first = 0, count = static_cast<std::uint32_t>(path.segments.size());
  while (count > 0) {  // the segments that end in time are the first ones
    const std::uint32_t half = count / 2;
    if (table.time(first + half, 1.0) <= seconds) {
      first += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return before(path, table, first);
}

std::vector<ProgramState> equally_spaced(const ToolPath& path, int count,
                                         const ProgramState& until) {
  std::vector<ProgramState> program_states;
  for (int k = 1; k < count; ++k) {
    // A program that takes no time at all is divided by its segments.
    if (until.time > 0.0) {
      program_states.push_back(*at_time(path, until.time * k / count));
    } else {
      const std::uint64_t share = std::uint64_t{until.segments} * static_cast<std::uint64_t>(k);
      program_states.push_back(state_after(
          path, static_cast<std::uint32_t>(share / static_cast<std::uint64_t>(count)), 0.0));
    }
  }
  if (count > 0) program_states.push_back(until);
  return program_states;
}

std::optional<OriginatingBlock> originating_block_of(const WorkpieceAt& part, const Vec3& point,
                                                     Mm tolerance) {
  const double back = 2.0 * tolerance.value;
  const auto& path = part.workpiece().removed().path();
  std::optional<OriginatingBlock> best;
  for (const Ray& ray : rays_through(point, back)) {
    const IntervalSet material = part.material_along(ray, {0.0, 2.0 * back});
    for (const Interval& piece : material.intervals()) {
      for (const auto& [s, tag] : {std::pair(piece.lo, piece.lo_tag), {piece.hi, piece.hi_tag}}) {
        if (tag == -1) continue;
        const SurfacePoint surface = part.surface_at(ray, s, tag);
        const double distance = std::abs((s - back) * surface.normal.dot(ray.direction));
        // On an edge with the blank's own face the cut has made it.
        const auto rank = std::pair(!surface.segment.has_value(), distance);
        if (distance > tolerance.value) continue;
        if (best && std::pair(!best->block.has_value(), best->distance) <= rank) continue;
        best = {.source_line = surface.source_line, .distance = distance, .normal = surface.normal};
        if (surface.segment) best->block = path.segments[*surface.segment].block;
      }
    }
  }
  return best;
}

}  // namespace frustum::stock
