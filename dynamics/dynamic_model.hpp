// A machine as rigid bodies on springs and dampers: the bed and one body for each axis, connected
// at points.
//
// Model    : between the body of an axis and the one before it, nearer to the bed:
//              carriage  of a linear axis: across it, along its normal and along direction x normal
//              bearing   of a rotary axis: along it, across it, and in rotation about all that is
//                        across it
//              drive     of every axis: along a linear one, in rotation about a rotary one
//            and between the bed and the ground: mounts, along the axes of the machine. All are
//            without force where the commands are. A point is fixed in the moving body, in its
//            frame, or in the body before, in the frame of the joint at zero
// Units    : SI: kg, m, N/m, N s/m, N m/rad, N m s/rad, kg m^2. The joints and the gauge point are
//            of kinematics: mm, rad
// Shape    : axes of the tool chain, then of the work chain, each from the bed outwards
// Errors   : none; model_file.hpp refuses what cannot be
// Accuracy : exact description; what it leaves out is in docs/dynamics.md
// Source   : ETH thesis on a five-axis test piece and on dynamics, chapters 5 to 8
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "dynamics/rigid_body.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::dynamics {

struct SpringDamper {
  double stiffness = 0.0;
  double damping = 0.0;
};

// In which body a point is fixed.
enum class Attached : std::uint8_t { moving, fixed };

struct Mount {
  Vec3 at = Vec3::Zero();  // in the frame of the machine
  Vec3 stiffness = Vec3::Zero();
  Vec3 damping = Vec3::Zero();
};

struct Carriage {
  Vec3 at = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // unit, perpendicular to the axis
  SpringDamper along_normal{};
  SpringDamper lateral{};
  Attached on = Attached::moving;
};

struct Bearing {
  Vec3 at = Vec3::Zero();
  SpringDamper axial{};
  SpringDamper radial{};
  SpringDamper tilt{};
  Attached on = Attached::moving;
};

struct Drive {
  Vec3 at = Vec3::Zero();
  SpringDamper spring{};
  Attached on = Attached::moving;
};

// A cascade of position and velocity loop.
struct Control {
  // What the motor acts on: the moving part itself, or a screw with a mass of its own.
  enum class Kind : std::uint8_t { direct, screw };
  struct Scale {
    Vec3 at = Vec3::Zero();
    Attached on = Attached::moving;
  };
  // In the machine file, for what is found of it later.
  struct Place {
    std::string file{};
    int line = 0, column = 0;
  };
  Kind kind = Kind::direct;
  double position_gain = 0.0;             // Kv, 1/s
  double velocity_gain = 0.0;             // Kp, N s/m or N m s/rad
  std::optional<double> integral_time{};  // Tn, s; none: no integral part
  double feed_forward_velocity = 0.0;
  double feed_forward_acceleration = 0.0;
  double reference_inertia = 0.0;  // kg or kg m^2
  double motor_inertia = 0.0;      // of a screw
  SpringDamper screw{};
  std::optional<Scale> scale{};  // none: the motor's encoder, of a direct drive the drive's point
  Place place{};
};

struct AxisModel {
  kinematics::Joint joint{};
  int previous = -1;  // index of the axis nearer to the bed; -1: the bed
  RigidBody body{};
  std::vector<Carriage> carriages{};
  std::vector<Bearing> bearings{};
  Drive drive{};
  std::optional<Control> control{};
};

struct DynamicModel {
  std::string name{};
  RigidBody bed{};
  std::vector<Mount> mounts{};
  std::vector<AxisModel> axes{};
  std::size_t tool_axes = 0;           // how many of them are of the tool chain
  Vec3 spindle_offset = Vec3::Zero();  // mm
  bool workpiece_on_ground = false;    // without a work chain: not on the bed

  [[nodiscard]] bool is_controlled() const;
  [[nodiscard]] bool has_work_chain() const { return axes.size() > tool_axes; }
  // "bed", or the letter of the axis that moves it; body 0 is the bed.
  [[nodiscard]] std::string body_name(std::size_t body) const;
  // Index of an axis; none: the machine lacks it.
  [[nodiscard]] std::optional<std::size_t> axis(kinematics::AxisLetter letter) const;
};

}  // namespace frustum::dynamics
