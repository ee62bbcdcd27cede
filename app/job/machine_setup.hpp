// A machine with its work offsets and tools: from a job, and from the words of the command line.
//
// Units    : mm, rad inside; options in mm
// Errors   : what is wrong with the job, a machine, a length, a diameter or an offset, naming the
//            option
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine.hpp"
#include "parser/control_settings.hpp"
#include "parser/interpreter.hpp"
#include "parser/tool_table.hpp"

namespace frustum::app {

struct SetupWords {
  std::string machine{};                      // file or name; empty: the job's
  std::string job{};                          // empty: none
  std::vector<std::string> tool_lengths{};    // "1=150"
  std::vector<std::string> tool_diameters{};  // "1=10"
  std::vector<std::string> offsets{};         // "G54=-65,0,150"
  std::string start{};                        // "X0,Y0,Z100"; empty: the machine's home
  std::vector<std::string> words{};           // of the machine's builder: "M31"
  std::optional<std::uint64_t> max_blocks{};  // that run again; absent: the machine's
  std::string decimal_point{};                // "calculator" or "increment"; empty: the machine's
  std::string units{};                        // "mm" or "inch"; empty: the machine's
};

// What is known without a machine.
struct KnownSetup {
  std::optional<kinematics::Machine> machine{};
  kinematics::Setup setup{};
  parser::ToolTable tools{};             // diameters alone; lengths are the setup's
  bool first_offset_is_assumed = false;  // nothing says where G54 is
  // Where the axes are before the program, in its coordinates: of the words, else of the machine;
  // `home` where G54 is taken as assumed.
  parser::AxisTarget start{};
  parser::AxisTarget home{};
  parser::ControlSettings control{};
  bool decimal_point_is_known = false;

  // What an interpreter is told of it, lengths of tools too.
  void tell(parser::InterpreterOptions& options) const;
};
[[nodiscard]] Result<KnownSetup> known_setup_of(const SetupWords& words);

struct MachineSetup {
  kinematics::Machine machine;
  kinematics::Setup setup{};
  parser::ToolTable tools{};
  parser::ControlSettings control{};
};
[[nodiscard]] Result<MachineSetup> machine_setup_of(const SetupWords& words);

}  // namespace frustum::app
