#include "stock/solid/program_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

namespace frustum::stock {
namespace {

using kinematics::PathSegment;
using kinematics::ToolPath;

ProgramState state_after(const ToolPath& path, std::uint32_t segments, double time) {
  ProgramState program_state{.segments = segments, .time = time};
  if (segments > 0) {
    program_state.block = path.segments[segments - 1].block;
    const kinematics::PathBlock& block = path.blocks[*program_state.block];
    program_state.source_line = block.source_line;
    program_state.source_file = block.source_file;
  }
  return program_state;
}

ProgramState before(const ToolPath& path, const Timetable& table, std::uint32_t segment) {
  return state_after(path, segment, table.start(segment));
}

Diagnostic no_line_zero() {
  return error("program-line"_id, "line 0 of the program does not exist",
               "lines are counted from 1");
}

// The last block of the line that is nearest above one, or that line itself.
class NearestAbove {
 public:
  explicit NearestAbove(std::uint32_t line) : line_(line) {}
  void see(std::uint32_t line, std::uint32_t block) {
    if (line == 0 || line > line_ || line < nearest_) return;
    nearest_ = line;
    block_ = block;
  }
  [[nodiscard]] const std::optional<std::uint32_t>& block() const { return block_; }

 private:
  std::uint32_t line_;
  std::uint32_t nearest_ = 0;
  std::optional<std::uint32_t> block_{};
};

bool names(const std::string& name, const std::string& file) {
  return name == file || name == std::filesystem::path(file).filename().string();
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
  if (line == 0) return no_line_zero();
  NearestAbove nearest(line);
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    const kinematics::PathBlock& from = path.blocks[block];
    nearest.see(from.main_line, block);
    if (from.source_file == nullptr) nearest.see(from.source_line, block);
  }
  return nearest.block() ? after_block(path, *nearest.block()) : start_of(path);
}

Result<ProgramState> after_line(const ToolPath& path, const std::string& file, std::uint32_t line) {
  if (line == 0) return no_line_zero();
  NearestAbove nearest(line);
  bool known = false;
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    const kinematics::PathBlock& from = path.blocks[block];
    if (from.source_file == nullptr || !names(file, *from.source_file)) continue;
    known = true;
    nearest.see(from.source_line, block);
  }
  if (!known) {
    return error("program-line"_id, fmt::format("no motion comes from the file '{}'", file),
                 "name the file of a subprogram that the program calls");
  }
  return nearest.block() ? after_block(path, *nearest.block()) : start_of(path);
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
        if (!surface.segment) continue;
        best->block = path.segments[*surface.segment].block;
        best->source_file = path.blocks[*best->block].source_file;
      }
    }
  }
  return best;
}

}  // namespace frustum::stock
