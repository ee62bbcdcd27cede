// Forward kinematics of eight machines at once, at places of the axes that are known beforehand.
//
// Model    : that of kinematics/model/chain.hpp, for the tip and the axis of the tool alone. What
//            does not differ between the machines is computed once a place: the motions of the
//            joints, their pivots, and the errors of one unit of each column; a machine's errors
//            are those times its weights
// Units    : mm, rad; frame: workpiece
// Shape    : places by columns; some 1 KiB a place
// Errors   : carries_all() is false for errors with a volumetric grid
// Accuracy : 1e-12 mm from chain.hpp (tests/trials/lane_chain_test.cpp)
// Source   : chain.hpp
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "trials/population/lanes.hpp"
#include "trials/population/population_laws.hpp"

namespace frustum::trials {

// One joint as the kernel walks it; offsets are into the numbers of a place.
struct LaneJoint {
  enum class Pivot : std::uint8_t { origin, point, end };
  bool rotary = false;
  bool rotor = false;  // component errors act before the joint turns
  bool on_work = false;
  bool tilted = false;     // linear: the line leans
  bool carries = false;    // location errors turn what the joint carries
  std::uint8_t about = 0;  // rotary: 0 X, 1 Y, 2 Z, 3 any other direction
  Pivot pivot = Pivot::origin;
  bool shifts = false, turns = false;       // component errors
  std::array<std::int32_t, 6> component{};  // places in the list of component errors; -1: none
  std::array<double, 3> point{};            // the pivot, unless it is the end
  std::array<double, 3> offset{};
  std::uint32_t motion_at = 0, pivot_at = 0;
};

// What of a machine does not depend on where its axes are.
struct LaneJointErrors {
  LaneVec3 place{};                        // offset with the location errors
  std::array<Lanes, 9> line{}, carried{};  // by rows
};
struct LaneMachines {
  std::vector<Lanes> weights{};  // by column
  std::array<LaneJointErrors, 5> joints{};
};

struct LaneChainTables {
  std::vector<LaneJoint> joints{};  // tool chain from the tool to the bed, work chain from there on
  bool zyx = true;
  std::array<double, 3> table{};                 // of the last joint of the work chain
  std::array<double, 9> workpiece_from_table{};  // rotation by rows
  std::array<double, 3> workpiece_origin{};      // of that pose
  std::uint32_t start_at = 0;                    // tip in the frame of the tool chain's end
  std::uint32_t base_at = 0, entries_at = 0;     // numbers of component errors
  std::vector<std::uint32_t> first_entry{};      // of each component error, and the end
  std::vector<std::uint32_t> column_of{};        // of each entry
  std::size_t stride = 0;
  std::vector<double> numbers{};  // stride a place
};

class LaneChain {
 public:
  LaneChain(const kinematics::Machine& machine, const PopulationLaws& laws,
            const Pose& table_from_workpiece);

  [[nodiscard]] bool carries_all() const { return !has_grid_; }
  // The place's index.
  std::uint32_t add(const kinematics::AxisState& at, double tool_length);
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] const LaneChainTables& tables() const { return tables_; }

  // Of up to eight draws; where there are fewer, the last one again.
  [[nodiscard]] LaneMachines machines(std::span<const Weights> draws) const;
  // poses[i] for each i of `places`.
  void find(const LaneMachines& machines, std::span<const std::uint32_t> places,
            std::span<LanePose> poses) const;

 private:
  struct Location {  // entries of location errors
    std::uint32_t joint = 0, direction = 0, column = 0;
    double per_weight = 0.0;
    bool carried = false;
  };
  void prepare(const kinematics::Joint& joint, bool on_work);
  void append(const kinematics::Joint& joint, const LaneJoint& lane,
              const kinematics::AxisState& at, const Vec3& end, double* numbers) const;

  kinematics::Machine machine_;
  kinematics::GeometricErrors fixed_;
  std::vector<kinematics::GeometricErrors> units_{};
  LaneChainTables tables_{};
  std::vector<const kinematics::Joint*> joints_{};  // as tables_.joints
  struct Component {
    const kinematics::Joint* joint = nullptr;
    std::size_t direction = 0;
  };
  std::vector<Component> components_{};
  std::vector<Location> locations_{};
  std::size_t count_ = 0;
  bool has_grid_ = false;
};

}  // namespace frustum::trials
