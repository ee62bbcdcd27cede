// The controller: canonical motions in, commanded axis motions out.
//
// Model    : with tool centre point control the tip moves as programmed in the programmed frame
//            (straight, or on an arc) while the rotary axes move linearly or the tool axis runs on
//            the great circle; without it all axes move linearly. The controller sees the nominal
//            machine only; where the tool really goes, and when, is for kinematics/path/travel.hpp.
//            Modes and feeds in words: docs/controller.md
// Frames   : controller_state.hpp. Machine coordinates (G53) are axis positions
// Units    : mm, rad, s
// Errors   : over-travel (axis, value, limits), axes the machine lacks, unreachable directions,
//            tools and work offsets that the setup lacks, feed without a tool, feed per revolution
//            without a turning spindle, alignment without a plane, rotary positions off the great
//            circle; each with the NC line
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "core/result.hpp"
#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine.hpp"
#include "parser/motion.hpp"

namespace frustum::kinematics {

struct CommandOptions {
  bool check_travel = true;     // false: positions beyond the travels are commanded all the same
  bool feeds_need_tool = true;  // false: feed moves with an empty spindle are commanded too
};

// Takes what is commanded, step by step.
using CommandSink = std::function<void(CommandedStep&&)>;

// Motion by motion, for programs that are never held as a whole and for those who judge each move.
class Controller {
 public:
  // Machine and set-up must outlive it.
  Controller(const Machine& machine, const Setup& setup, CommandSink sink,
             const CommandOptions& options = {});
  ~Controller();
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  // One motion. What is wrong with it, with its place: it is then not made, and the next one starts
  // from where the axes are.
  [[nodiscard]] Diagnostics command(const parser::Motion& motion);
  // So far.
  [[nodiscard]] const Diagnostics& warnings() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

// A whole program; its first error ends it.
[[nodiscard]] Result<CommandedProgram> command(const Machine& machine, const Setup& setup,
                                               std::span<const parser::Motion> motions,
                                               const CommandOptions& options = {});

}  // namespace frustum::kinematics
