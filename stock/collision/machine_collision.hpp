// Bodies of a machine, fixtures, tools and the blank that meet while a program runs.
//
// Model    : every pair of bodies that the axes move against each other is watched along the
//            commanded motion of the nominal machine (stock/collision/pair_watch.hpp), tools while
//            they are in the spindle. Bodies of the machine that touch where the axes are at home
//            are left out with a warning. Whether tools meet the part is for
//            stock/collision/collision.hpp; all others meet the blank, cut or not
// Units    : mm
// Shape    : pairs x vertices of the motion, some ten nanoseconds each where nothing is near
// Errors   : meshes that cannot be read
// Accuracy : axes that do not move evenly within a block are within 5 um and 10 urad of even parts;
//            bodies within 0.02 mm count as meeting
// Threads  : oneTBB; the same bits for any number of threads
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/controller/setup.hpp"
#include "stock/collision/collision.hpp"
#include "stock/collision/machine_scene.hpp"

namespace frustum::stock {

struct ClosestApproach {
  double distance = 0.0;  // mm; 0: they meet
  std::string first{}, second{};
  std::uint32_t source_line = 0;
  std::shared_ptr<const std::string> source_file{};  // null: the file of the main program
};

struct MachineCollisions {
  std::size_t bodies = 0;  // that machine file and job state; 0: nothing was looked for
  std::vector<Collision> collisions{};  // in program order
  std::optional<ClosestApproach> closest{};
  Diagnostics warnings{};
};

[[nodiscard]] MachineCollisions find_machine_collisions(
    const MachineScene& scene, const kinematics::Setup& setup,
    const kinematics::CommandedProgram& program);

// The same motion by motion, for programs that are never held as a whole.
class MachineCollisionSearch {
 public:
  // The scene must outlive it.
  MachineCollisionSearch(const MachineScene& scene, const kinematics::AxisPositions& start);
  MachineCollisionSearch(MachineCollisionSearch&&) noexcept;
  ~MachineCollisionSearch();

  void follow(const kinematics::CommandedMove& move);
  [[nodiscard]] MachineCollisions finish(const kinematics::Setup& setup);

 private:
  class State;
  std::unique_ptr<State> state_;
};

// "table and column": bodies of the machine that touch where the axes are at home, which no search
// looks at.
struct TouchingPair {
  std::string first{}, second{};
};
[[nodiscard]] std::vector<TouchingPair> touching_at_home(const MachineScene& scene);

}  // namespace frustum::stock
