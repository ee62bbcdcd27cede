// How near other parts of a tool path can come to a contact when the errors change within their
// laws.
//
// Model    : a point p that a cutter touches with the outward normal n. A column moves what is at p
//            by g_j(q) when the cutter is at place q of the path; relative to the contact's own
//            cutter it comes nearer along the normal n_q, towards p, by n_q . (g_j(q) - g_j(own)).
//            Weights at their limits, all for the worst, bound the sum
// Units    : mm, rad; frame: workpiece
// Errors   : none
// Accuracy : follow_plan.hpp
// Source   : ours
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "kinematics/controller/setup.hpp"
#include "stock/solid/workpiece.hpp"
#include "trials/population/column_motion.hpp"
#include "trials/population/lane_contact.hpp"
#include "trials/population/near_parts.hpp"
#include "trials/population/near_segments.hpp"

namespace frustum::trials {

struct PlaceOnPath {
  std::uint32_t id = 0;  // the same for the same place
  kinematics::ToolPose pose{};
  kinematics::AxisState state{};
};

struct ContactPlace {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  // out of the cutter
  kinematics::ToolPose pose{};
  std::vector<Vec3> motions{};  // of the point with its cutter, for a unit of each column
};

struct ApproachLine {
  Vec3 touching = Vec3::Zero(), normal = Vec3::UnitZ();
  double ball = 0.0, travel = 0.0, clearance = 0.0;
};

// Of the blocks of a tool path, both included.
struct BlockRange {
  std::uint32_t first = 0, last = 0;
  [[nodiscard]] bool has(std::uint32_t block) const { return first <= block && block <= last; }
};
[[nodiscard]] bool is_in(std::span<const BlockRange> ranges, std::uint32_t block);

// What lies beyond one end of a window.
struct SideBound {
  Closeness closeness{};
  double at_end = 0.0;  // mm, of the contact from the cutter there
  double lean = 0.0;    // sine of the angle between the normals there and at the contact
  // mm, of what the contact comes nearer to the end by drifting, over the population.
  double drift_deviation = 0.0;
  double rho = 1.0;  // mm, from the tool's axis
};

class WindowBounds {
 public:
  WindowBounds(const kinematics::Machine& machine, const kinematics::Setup& setup,
               const ColumnMotion& columns, const stock::Workpiece& workpiece);

  [[nodiscard]] double largest_motion() const { return largest_; }
  // Of the path.
  [[nodiscard]] const NearSegments& segments() const { return segments_; }
  [[nodiscard]] std::vector<Vec3> motions(const kinematics::AxisState& state, int tool,
                                          const kinematics::ToolPose& pose,
                                          const Vec3& point) const;
  // How far the cutters keep from a point on the blank, or more than matters to any machine.
  [[nodiscard]] double room(const Vec3& point) const;
  // Of the contact along its surface, over the population.
  [[nodiscard]] double drift_deviation(const ContactPlace& at) const;
  // Of the places beyond an end of the window, along the path.
  [[nodiscard]] SideBound side(const ContactPlace& at, const LaneFace& face, int tool,
                               const PlaceOnPath& end, std::span<const PlaceOnPath> beyond);
  // Of all blocks but those of the ranges, of the blank, and of the way that the ball comes.
  struct Others {
    Closeness closeness{};
    NearParts near{};
  };
  [[nodiscard]] Others others(const ContactPlace& at, std::span<const BlockRange> but, int tool,
                              const ApproachLine& line);
  // Those of all near parts that were found.
  [[nodiscard]] NearPlaces take_places() { return std::move(near_); }

 private:
  using Motions = ColumnMotions;
  using Known = std::map<std::uint32_t, Motions>;
  [[nodiscard]] double tool_length(int tool) const;
  // Of the sum over all columns, each at its point's motion of that size.
  [[nodiscard]] double deviation(const std::function<double(const Vec3&)>& size,
                                 const ContactPlace& at) const;
  [[nodiscard]] const Motions& motions_at(Known& known, std::uint32_t id,
                                          const kinematics::AxisState& state, int tool) const;
  // How much nearer along the normal each column brings what is at the point.
  [[nodiscard]] std::vector<double> nearer(const ContactPlace& at, const Vec3& normal,
                                           const kinematics::ToolPose& pose,
                                           const Motions& motions) const;
  [[nodiscard]] double sum_at_limits(std::span<const double> by) const;
  void measure_largest();
  void take_segment(Others& others, const ContactPlace& at, std::uint32_t segment);
  // At time t of a segment of the path.
  [[nodiscard]] Motions motions_of(const kinematics::PathSegment& segment, double t) const;
  [[nodiscard]] NearPart::End near_end(std::uint32_t segment, double t, const Vec3& normal);
  [[nodiscard]] bool is_inside_blank(const Vec3& point, double margin) const;

  const kinematics::Setup& setup_;
  const ColumnMotion& columns_;
  const stock::Workpiece& workpiece_;
  NearSegments segments_;
  double largest_ = 0.0;
  NearPlaces near_{};
  std::map<std::pair<std::uint32_t, double>, std::uint32_t> near_known_{};  // by segment and time
  Known of_poses_{}, of_places_{};  // of the path, and others
};

}  // namespace frustum::trials
