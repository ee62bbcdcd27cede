// A contact found once and followed when the tool path changes a little: the same answer, much faster.
//
// Model    : a trail keeps a contact of the nominal path, the stretches around it and the distance to all
//            others. On a changed path the contact is solved anew in its own stretch or the next ones. Planes
//            that touch the cutter prove, pose by pose, that nothing else of the window reaches beyond; the
//            distance proves it for the rest. What cannot be proven is not answered: then the whole sweep is
//            to be asked
// Units    : mm; frame: workpiece
// Errors   : on() refuses a path with other stretches, blocks or tools than the nominal one
// Accuracy : that of SweptCutter::end_of_void
// Source   : ours
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "cutter/end_guard.hpp"
#include "cutter/stretch_sweep.hpp"
#include "cutter/swept_cutter.hpp"

namespace frustum::cutter {

// A probe's ray and what it found on the nominal path.
struct ContactTrail {
  Ray ray{};
  double start = 0.0;  // mm along the ray: the void is asked for from here
  SweepContact contact{};
  std::uint32_t first = 0, last = 0;  // the window of stretches around the contact
  double clearance =
      0.0;  // no other stretch comes nearer to the contact point (mm); 0: do not follow
};

// The trail of a contact that end_of_void(ray, start, ...) found.
[[nodiscard]] ContactTrail trail_of(const SweptCutter& nominal, const Ray& ray, double start,
                                    const SweepContact& contact);

class ChangedPath {
 public:
  [[nodiscard]] static Result<ChangedPath> on(const SweptCutter& nominal,
                                              kinematics::ToolPath path);

  // Where the probe meets the part that this path cuts; nothing: not proven, ask the whole sweep.
  // Precondition: the trail is one of the nominal path.
  [[nodiscard]] std::optional<SweepContact> follow(const ContactTrail& trail) const;

  // No point of a cutter is farther from its nominal place at any pose (mm).
  [[nodiscard]] double displacement() const { return displacement_; }
  [[nodiscard]] const kinematics::ToolPath& path() const { return path_; }

 private:
  // Stretches in a row, up or down the path.
  struct Side {
    std::uint32_t from = 0, count = 0;
    bool up = true;
  };
  ChangedPath(std::shared_ptr<const std::map<int, Cutter>> tools, kinematics::ToolPath path,
              double displacement, std::vector<double> departures);
  [[nodiscard]] StretchMotion motion_of(std::uint32_t stretch) const;
  [[nodiscard]] bool holds_back(const TouchingPlane& plane, const EndGuard& end, const Vec3& point,
                                const Side& side) const;

  kinematics::ToolPath path_;
  std::shared_ptr<const std::map<int, Cutter>> tools_;  // by tool number: bodies are pointed to
  std::vector<const Body*> body_of_block_{};
  double displacement_;
  // Of each stretch: how much less than linear the distance of a plane may be that goes with a cutter (mm).
  std::vector<double> departures_{};
};

}  // namespace frustum::cutter
