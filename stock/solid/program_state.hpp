// A state of the program, and the workpiece as it is then.
//
// Model    : a program state is between two segments of the tool path: those before it have cut,
//            those after it have not. Workpieces of any program state share one sweep; nothing is
//            cut twice
// Units    : mm, s; frame: workpiece
// Errors   : after_line() refuses line 0 and files that make no motion; at_time() refuses what is
//            no time
// Accuracy : that of Workpiece; segments are not divided, so that a program state is at most one
//            segment off
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/units.hpp"
#include "kinematics/path/tool_path.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock {

// Where each block of a path begins and ends in it, by segments and by the clock.
class Timetable {
 public:
  explicit Timetable(const kinematics::ToolPath& path);

  // The first segment of a block, or of the next one that has any; the number of blocks is the end.
  [[nodiscard]] std::uint32_t first_segment(std::uint32_t block) const { return first_[block]; }
  // Seconds since the start of the program at a fraction t of a segment. Of a path without times
  // they are the sums of the blocks' durations, segments of a block taking equally long.
  [[nodiscard]] double time(std::uint32_t segment, double t) const;
  // Of a segment; of the number of segments, the end of the program.
  [[nodiscard]] double start(std::uint32_t segment) const { return starts_[segment]; }
  [[nodiscard]] double end() const { return starts_.back(); }
  [[nodiscard]] std::uint32_t blocks() const {
    return static_cast<std::uint32_t>(first_.size() - 1);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<double> starts_;  // of each segment, and the end of the last
};

struct ProgramState {
  std::uint32_t segments = 0;  // have cut
  std::optional<std::uint32_t>
      block{};                    // the last of them belongs to it; nothing: before the first
  std::uint32_t source_line = 0;  // of that block
  std::shared_ptr<const std::string> source_file{};  // null: the file of the main program
  double time = 0.0;                                 // s since the start of the program
};

[[nodiscard]] ProgramState start_of(const kinematics::ToolPath& path);
[[nodiscard]] ProgramState end_of(const kinematics::ToolPath& path);
// Precondition: the path has that block.
[[nodiscard]] ProgramState after_block(const kinematics::ToolPath& path, std::uint32_t block);
// After the last motion of a line of the main program, with what it calls; of a line without
// motion, after that of the nearest line above that has one. Of a subprogram in the same file its
// own lines count too.
[[nodiscard]] Result<ProgramState> after_line(const kinematics::ToolPath& path, std::uint32_t line);
// The same of a subprogram that has a file of its own: after the last motion that the line ever
// made. The file is named by its path or by the last part of it.
[[nodiscard]] Result<ProgramState> after_line(const kinematics::ToolPath& path,
                                              const std::string& file, std::uint32_t line);
// The last program state that is not later than `seconds`.
[[nodiscard]] Result<ProgramState> at_time(const kinematics::ToolPath& path, double seconds);
// `count` program states at equal steps of time, the last of them `until`.
[[nodiscard]] std::vector<ProgramState> equally_spaced(const kinematics::ToolPath& path, int count,
                                                       const ProgramState& until);

// What there is of a workpiece at a program state: a RaySolid. The workpiece must outlive it.
class WorkpieceAt {
 public:
  WorkpieceAt(const Workpiece& workpiece, const ProgramState& program_state)
      : workpiece_(&workpiece), program_state_(program_state) {}
  // Finished.
  explicit WorkpieceAt(const Workpiece& workpiece)
      : WorkpieceAt(workpiece, end_of(workpiece.removed().path())) {}

  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    return workpiece_->material_along(ray, span, program_state_.segments);
  }
  [[nodiscard]] std::vector<IntervalSet> material_along_all(std::span<const Ray> rays,
                                                            std::size_t row, RaySpan span) const {
    return workpiece_->material_along_all(rays, row, span, program_state_.segments);
  }
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const {
    return workpiece_->surface_at(ray, s, tag);
  }
  [[nodiscard]] std::optional<SurfacePoint> first_surface(const Ray& ray, RaySpan span) const {
    return workpiece_->first_surface(ray, span, program_state_.segments);
  }
  [[nodiscard]] std::optional<SurfacePoint> first_surface(
      const Ray& ray, RaySpan span, const cutter::SweptCutter::Likely& likely) const {
    return workpiece_->first_surface(ray, span, likely, program_state_.segments);
  }
  [[nodiscard]] cutter::SweptNear near(const Vec3& centre, double radius,
                                       const cutter::SweptNear* within = nullptr) const {
    return workpiece_->removed().near(centre, radius, program_state_.segments, within);
  }
  [[nodiscard]] const Workpiece& workpiece() const { return *workpiece_; }
  [[nodiscard]] const ProgramState& program_state() const { return program_state_; }

 private:
  const Workpiece* workpiece_;
  ProgramState program_state_;
};

// What made the surface at a point that is on it within `tolerance`; nothing when none is so near.
struct OriginatingBlock {
  std::optional<std::uint32_t> block{};  // of the tool path; nothing: the blank's own surface
  std::uint32_t source_line = 0;         // 0: the blank
  std::shared_ptr<const std::string> source_file{};  // null: the file of the main program
  double distance = 0.0;        // mm from the point to the surface, normal to it
  Vec3 normal = Vec3::UnitZ();  // unit, out of the material
};
[[nodiscard]] std::optional<OriginatingBlock> originating_block_of(const WorkpieceAt& part,
                                                                   const Vec3& point,
                                                                   Mm tolerance = Mm{1e-3});

}  // namespace frustum::stock
