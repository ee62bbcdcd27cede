// All bodies that may meet on a machine: its own, the job's fixtures, the tools, the blank.
//
// Model    : each hangs on one part of the machine and never moves against it. The blank is whole,
//            as it is before the program begins; a tool's cutter is as long as it really is
// Units    : mm; frames as in kinematics/model/machine_body.hpp
// Errors   : meshes that cannot be read or bound no body (open, facing inwards), with their file;
//            bodies that reach 100 m or farther
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "cutter/body/cutter.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine.hpp"
#include "stock/collision/solid_body.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::stock {

struct SceneBody {
  enum class Kind : std::uint8_t { machine, fixture, tool, blank };
  Kind kind = Kind::machine;
  std::string name{};  // "table"; of a tool: cutter, shank, holder
  int tool = 0;        // only there while this tool is in the spindle; 0: always
  kinematics::MachinePart part{};
  Pose part_from_body{};
  std::shared_ptr<const SolidBody> solid{};
  std::vector<std::string> ignored{};
};

// A body of a machine file or a job.
[[nodiscard]] Result<SolidBody> solid_of(const kinematics::BodyShape& shape);

// Of the machine alone.
[[nodiscard]] Result<std::vector<SceneBody>> bodies_of(const kinematics::Machine& machine);

struct MachineScene {
  const kinematics::Machine* machine = nullptr;
  std::vector<SceneBody> bodies{};
  std::size_t stated = 0;  // by machine file and job
};
// `fixtures` are in the frame of the table. The machine must outlive the scene.
[[nodiscard]] Result<MachineScene> scene_of(const kinematics::Machine& machine,
                                            std::span<const kinematics::MachineBody> fixtures,
                                            const kinematics::Setup& setup,
                                            const std::map<int, cutter::Cutter>& tools,
                                            const Blank& blank);

// Whether two bodies are looked at: not on one part of the machine, not both of the tool, not a
// tool and the blank, which it cuts (stock/collision/collision.hpp), and not named to be ignored.
[[nodiscard]] bool may_meet(const SceneBody& a, const SceneBody& b);

}  // namespace frustum::stock
