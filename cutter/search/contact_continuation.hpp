// A contact found once and followed when the tool path changes a little: the same answer, much
// faster.
//
// Model    : a continuation keeps a contact of the nominal path, the segments around it and the
//            distance to all others. On a changed path the contact is solved anew in its own
//            segment or the next ones. Planes that touch the cutter prove, pose by pose, that
//            nothing else of the window reaches beyond; the distance proves it for the rest. What
//            cannot be proven is not answered: then the whole sweep is to be asked
// Units    : mm; frame: workpiece
// Errors   : on() refuses a path with other segments, blocks or tools than the nominal one
// Accuracy : that of SweptCutter::end_of_void
// Source   : ours
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "cutter/search/separating_plane.hpp"
#include "cutter/search/swept_cutter.hpp"
#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {

// A probe's ray and what it found on the nominal path.
struct ContactContinuation {
  Ray ray{};
  double start = 0.0;  // mm along the ray: the void is asked for from here
  SweepContact contact{};
  std::uint32_t first = 0, last = 0;  // the window of segments around the contact
  double clearance =
      0.0;  // no other segment comes nearer to the contact point (mm); 0: do not follow
};

// The continuation of a contact that end_of_void(ray, start, ...) found.
[[nodiscard]] ContactContinuation continuation_of(const SweptCutter& nominal, const Ray& ray,
                                                  double start, const SweepContact& contact);

class ChangedPath {
 public:
  [[nodiscard]] static Result<ChangedPath> on(const SweptCutter& nominal,
                                              kinematics::ToolPath path);

  // Where the probe meets the part that this path cuts; nothing: not proven, ask the whole sweep.
  // Precondition: the continuation is one of the nominal path.
  [[nodiscard]] std::optional<SweepContact> follow(const ContactContinuation& continuation) const;

  // No point of a cutter is farther from its nominal place at any pose (mm).
  [[nodiscard]] double displacement() const { return displacement_; }
  [[nodiscard]] const kinematics::ToolPath& path() const { return path_; }

 private:
  // Segments in a row, up or down the path.
  struct Side {
    std::uint32_t from = 0, count = 0;
    bool up = true;
  };
  ChangedPath(std::shared_ptr<const std::map<int, Cutter>> tools, kinematics::ToolPath path,
              double displacement, std::vector<double> departures);
  [[nodiscard]] SegmentMotion motion_of(std::uint32_t segment) const;
  [[nodiscard]] bool holds_back(const TangentPlane& plane, const SeparatingPlane& end,
                                const Vec3& point, const Side& side) const;

  kinematics::ToolPath path_;
  std::shared_ptr<const std::map<int, Cutter>> tools_;  // by tool number: bodies are pointed to
  std::vector<const Body*> body_of_block_{};
  double displacement_;
  // Of each segment: how much less than linear the distance of a plane may be that goes with a
  // cutter (mm).
  std::vector<double> departures_{};
};

}  // namespace frustum::cutter
