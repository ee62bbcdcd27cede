// What else of a tool path may come near to a contact, and how near it comes of one machine.
//
// Model    : a machine moves the cutter at a place of the path, to first order, by the sum of its
//            columns there; it moves the contact by the sum of the columns where that was made. The
//            difference along the normal brings them nearer. window_bounds.hpp bounds it for all
//            machines within their laws, with every column for the worst; here it is what one
//            machine has, however far outside of its laws that is. Between the ends of a part the
//            normal turns from the one to the other
// Units    : mm, rad; frame: workpiece
// Errors   : none
// Accuracy : first order, with 2 % of either motion for what is of second order
// Source   : ours
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "trials/population/lane_contact.hpp"

namespace frustum::trials {

// Of the tool for a unit of each column: tip, then turn.
using ColumnMotions = std::vector<std::array<float, 6>>;

struct NearPlace {
  Vec3 tip = Vec3::Zero();
  ColumnMotions motions{};
};

// A part of the path between two places, as the middle machine has it.
struct NearPart {
  static constexpr std::uint32_t kFar = 0xffffffff;
  struct End {
    std::uint32_t place = kFar;  // of NearPlaces; kFar: farther than `far`
    Eigen::Vector3f normal = Vec3::UnitZ().cast<float>();  // out of the cutter, to the contact
  };
  float distance = 0.0F;  // of the contact, at least
  // Cosine of half of the angle between the normals at both ends: along none between them is a
  // motion more than the larger of what it is along both, divided by this.
  float between = 1.0F;
  float lean = 0.0F;  // sine of the angle between the normals there and at the contact, at most
  std::array<End, 2> ends{};
};

// All that is beside a contact's own surroundings.
struct NearParts {
  bool is_known = false;
  double far = 0.0;  // what is neither in `parts` nor in `rest` is farther from the contact (mm)
  Closeness rest{};  // of what comes little nearer
  std::vector<NearPart> parts{};
  std::vector<std::array<float, 3>> own{};  // of the contact with its cutter, by column
};

// Motions at places all along the path. No point of a cutter, which is within `reach` of its tip,
// moves by more than it does at one of them and `spread` for a unit of each column.
struct PathMotions {
  std::vector<ColumnMotions> places{};
  std::vector<double> spread{};
  double reach = 0.0;
};

struct NearPlaces {
  std::vector<NearPlace> places{};
  PathMotions path{};
};

// One machine, by how far its weights are off the middle.
class MachineNearness {
 public:
  MachineNearness(const NearPlaces& places, std::vector<double> off);

  // Whether all parts keep out of the way of the contact, which the middle machine has at `point`:
  // its own is `drift` from where it was carried, and `moved` from there.
  [[nodiscard]] bool keep_away(const NearParts& near, const Vec3& point, double scale, double drift,
                               double moved);

 private:
  [[nodiscard]] const kinematics::PoseDisplacement& at(std::uint32_t place);

  const NearPlaces& places_;
  std::vector<double> off_;
  double largest_ = 0.0;
  std::vector<std::optional<kinematics::PoseDisplacement>> known_;
};

}  // namespace frustum::trials
