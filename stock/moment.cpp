#include "stock/moment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace frustum::stock {
namespace {

using kinematics::Stretch;
using kinematics::ToolPath;

Moment moment_after(const ToolPath& path, std::uint32_t stretches, double time) {
  Moment moment{.stretches = stretches, .time = time};
  if (stretches > 0) {
    moment.block = path.stretches[stretches - 1].block;
    moment.source_line = path.blocks[*moment.block].source_line;
  }
  return moment;
}

Moment before(const ToolPath& path, const Timetable& table, std::uint32_t stretch) {
  return moment_after(path, stretch, table.start(stretch));
}

// Rays of a plane-filling triad through the point: one of them meets any surface at 55 degrees or less
// from its normal.
std::array<Ray, 3> rays_through(const Vec3& point, double back) {
  std::array<Ray, 3> rays;
  for (int k = 0; k < 3; ++k) {
    rays[static_cast<std::size_t>(k)] = {point - back * Vec3::Unit(k), Vec3::Unit(k)};
  }
  return rays;
}

}  // namespace

Timetable::Timetable(const ToolPath& path) : first_(path.blocks.size() + 1) {
  const auto count = static_cast<std::uint32_t>(path.stretches.size());
  std::uint32_t next = 0;
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    while (next < count && path.stretches[next].block < block) ++next;
    first_[block] = next;
  }
  first_.back() = count;

  starts_.reserve(count + 1);
  if (path.times.size() == path.poses.size() && !path.times.empty()) {
    for (const Stretch& s : path.stretches) starts_.push_back(path.times[s.first_pose]);
    starts_.push_back(count == 0 ? 0.0 : path.times[path.stretches.back().first_pose + 1]);
    return;
  }
  double block_start = 0.0;
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    const std::uint32_t stretches = first_[block + 1] - first_[block];
    for (std::uint32_t k = 0; k < stretches; ++k) {
      starts_.push_back(block_start + path.blocks[block].duration * k / stretches);
    }
    block_start += path.blocks[block].duration;
  }
  starts_.push_back(block_start);
}

double Timetable::time(std::uint32_t stretch, double t) const {
  return starts_[stretch] + t * (starts_[stretch + 1] - starts_[stretch]);
}

Moment start_of(const ToolPath& path) { return moment_after(path, 0, 0.0); }

Moment end_of(const ToolPath& path) {
  return moment_after(path, static_cast<std::uint32_t>(path.stretches.size()),
                      Timetable(path).end());
}

Moment after_block(const ToolPath& path, std::uint32_t block) {
  const Timetable table(path);
  return before(path, table, table.first_stretch(block + 1));
}

Result<Moment> after_line(const ToolPath& path, std::uint32_t line) {
  if (line == 0) return error("line 0 of the program does not exist", "lines are counted from 1");
  std::optional<std::uint32_t> last;
  for (std::uint32_t block = 0; block < path.blocks.size(); ++block) {
    const std::uint32_t here = path.blocks[block].source_line;
    if (here <= line && (!last || here >= path.blocks[*last].source_line)) last = block;
  }
  return last ? after_block(path, *last) : start_of(path);
}

Result<Moment> at_time(const ToolPath& path, double seconds) {
  if (!(seconds >= 0.0)) {
    return error(fmt::format("{} s is no time of the program", seconds),
                 "seconds since its start, 0 or more");
  }
  const Timetable table(path);
  std::uint32_t first = 0, count = static_cast<std::uint32_t>(path.stretches.size());
  while (count > 0) {  // the stretches that end in time are the first ones
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

std::vector<Moment> equally_spaced(const ToolPath& path, int count, const Moment& until) {
  std::vector<Moment> moments;
  for (int k = 1; k < count; ++k) {
    // A program that takes no time at all is divided by its stretches.
    if (until.time > 0.0) {
      moments.push_back(*at_time(path, until.time * k / count));
    } else {
      const std::uint64_t share = std::uint64_t{until.stretches} * static_cast<std::uint64_t>(k);
      moments.push_back(moment_after(
          path, static_cast<std::uint32_t>(share / static_cast<std::uint64_t>(count)), 0.0));
    }
  }
  if (count > 0) moments.push_back(until);
  return moments;
}

std::optional<Maker> maker_of(const WorkpieceAt& part, const Vec3& point, Mm tolerance) {
  const double back = 2.0 * tolerance.value;
  const auto& path = part.workpiece().removed().path();
  std::optional<Maker> best;
  for (const Ray& ray : rays_through(point, back)) {
    const IntervalSet material = part.material_along(ray, {0.0, 2.0 * back});
    for (const Interval& piece : material.intervals()) {
      for (const auto& [s, tag] : {std::pair(piece.lo, piece.lo_tag), {piece.hi, piece.hi_tag}}) {
        if (tag == -1) continue;
        const SurfacePoint surface = part.surface_at(ray, s, tag);
        const double distance = std::abs((s - back) * surface.normal.dot(ray.direction));
        // On an edge with the blank's own face the cut has made it.
        const auto rank = std::pair(!surface.stretch.has_value(), distance);
        if (distance > tolerance.value) continue;
        if (best && std::pair(!best->block.has_value(), best->distance) <= rank) continue;
        best = {.source_line = surface.source_line, .distance = distance, .normal = surface.normal};
        if (surface.stretch) best->block = path.stretches[*surface.stretch].block;
      }
    }
  }
  return best;
}

}  // namespace frustum::stock
