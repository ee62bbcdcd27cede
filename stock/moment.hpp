// A moment of the program, and the workpiece as it is then.
//
// Model    : a moment stands between two stretches of the tool path: those before it have cut, those
//            after it have not. Workpieces of any moment share one sweep; nothing is cut twice
// Units    : mm, s; frame: workpiece
// Errors   : after_line() refuses line 0; at_time() refuses what is no time
// Accuracy : that of Workpiece; stretches are not divided, so that a moment is at most one stretch off
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "core/units.hpp"
#include "kinematics/tool_path.hpp"
#include "stock/workpiece.hpp"

namespace frustum::stock {

// Where each block of a path begins and ends in it, by stretches and by the clock.
class Timetable {
 public:
  explicit Timetable(const kinematics::ToolPath& path);

  // The first stretch of a block, or of the next one that has any; the number of blocks is the end.
  [[nodiscard]] std::uint32_t first_stretch(std::uint32_t block) const { return first_[block]; }
  // Seconds since the start of the program at a fraction t of a stretch. Of a path without times they
  // are the sums of the blocks' durations, stretches of a block taking equally long.
  [[nodiscard]] double time(std::uint32_t stretch, double t) const;
  // Of a stretch; of the number of stretches, the end of the program.
  [[nodiscard]] double start(std::uint32_t stretch) const { return starts_[stretch]; }
  [[nodiscard]] double end() const { return starts_.back(); }
  [[nodiscard]] std::uint32_t blocks() const {
    return static_cast<std::uint32_t>(first_.size() - 1);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<double> starts_;  // of each stretch, and the end of the last
};

struct Moment {
  std::uint32_t stretches = 0;  // have cut
  std::optional<std::uint32_t>
      block{};                    // the last of them belongs to it; nothing: before the first
  std::uint32_t source_line = 0;  // of that block
  double time = 0.0;              // s since the start of the program
};

[[nodiscard]] Moment start_of(const kinematics::ToolPath& path);
[[nodiscard]] Moment end_of(const kinematics::ToolPath& path);
// Precondition: the path has that block.
[[nodiscard]] Moment after_block(const kinematics::ToolPath& path, std::uint32_t block);
// After the last motion of an NC line; of a line without motion, after that of the nearest line above
// that has one.
[[nodiscard]] Result<Moment> after_line(const kinematics::ToolPath& path, std::uint32_t line);
// The last moment that is not later than `seconds`.
[[nodiscard]] Result<Moment> at_time(const kinematics::ToolPath& path, double seconds);
// `count` moments at equal steps of time, the last of them `until`.
[[nodiscard]] std::vector<Moment> equally_spaced(const kinematics::ToolPath& path, int count,
                                                 const Moment& until);

// What of a workpiece stands at a moment: a RaySolid. The workpiece must outlive it.
class WorkpieceAt {
 public:
  WorkpieceAt(const Workpiece& workpiece, const Moment& moment)
      : workpiece_(&workpiece), moment_(moment) {}
  // Finished.
  explicit WorkpieceAt(const Workpiece& workpiece)
      : WorkpieceAt(workpiece, end_of(workpiece.removed().path())) {}

  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    return workpiece_->material_along(ray, span, moment_.stretches);
  }
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const {
    return workpiece_->surface_at(ray, s, tag);
  }
  [[nodiscard]] std::optional<SurfacePoint> first_surface(const Ray& ray, RaySpan span) const {
    return workpiece_->first_surface(ray, span, moment_.stretches);
  }
  [[nodiscard]] const Workpiece& workpiece() const { return *workpiece_; }
  [[nodiscard]] const Moment& moment() const { return moment_; }

 private:
  const Workpiece* workpiece_;
  Moment moment_;
};

// What made the surface at a point that lies on it within `tolerance`; nothing when none is so near.
struct Maker {
  std::optional<std::uint32_t> block{};  // of the tool path; nothing: the blank's own surface
  std::uint32_t source_line = 0;         // 0: the blank
  double distance = 0.0;                 // mm from the point to the surface, normal to it
  Vec3 normal = Vec3::UnitZ();           // unit, out of the material
};
[[nodiscard]] std::optional<Maker> maker_of(const WorkpieceAt& part, const Vec3& point,
                                            Mm tolerance = Mm{1e-3});

}  // namespace frustum::stock
