// Runs a program: its blocks in order, subprograms and their repeats, into a stream of motions.
//
// Start    : the state of ModalState's defaults; no axis position is known but by `start`, no tool
//            is in the spindle. A motion's target holds only axes the program has placed; an absent
//            axis stays where it is.
// End      : M2, M30, the tape mark at the end, or the end of the text. What follows is not run.
// Units    : mm, rad, mm/min, 1/min, seconds (see motion.hpp).
// G4       : X and U in seconds; P in milliseconds, in seconds when written with a decimal point.
// M98      : P names the subprogram, L repeats it; without L, P with more than four digits is
//            repeats and number together (P00032000 is O2000 three times).
// /        : blocks that begin with it run, unless `block_delete` is on.
// Flow     : flow.hpp. What counts is what runs: blocks that are passed over are read for their
//            flow statements alone.
// Errors   : the first block that cannot be run ends the run with its diagnostic; the motions
//            before it have reached the sink already. A syntax error brings those of the rest of
//            the text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "parser/control_settings.hpp"
#include "parser/interpret/state/control_data.hpp"
#include "parser/interpret/state/modal_state.hpp"
#include "parser/motion.hpp"
#include "parser/program.hpp"
#include "parser/tool_table.hpp"

namespace frustum::parser {

// A block that is about to be run.
struct BlockAhead {
  const Block& block;
  const std::shared_ptr<const std::string>& file;  // as of SourcePlace
  std::size_t calls = 0;                           // 0: of the main program
};

struct InterpreterOptions {
  // The operator's switch: on, blocks that begin with / are left out (and reported as events).
  bool block_delete = false;
  // Where the axes are at the start, in program coordinates, as far as it is known (mm, rad).
  AxisTarget start{};
  // What D, H and T words refer to. G10 L1 of a program changes its own copy. Where it is empty the
  // program takes tools as the setup has them.
  ToolTable tools{};
  // Radius compensation with a tool whose diameter is not known: the programmed contour itself is
  // given out, as an assumption; else it is an error.
  bool contours_without_diameter = false;
  // A table that has lengths is the control's own: other tools do not exist.
  bool tools_are_all = true;
  // Where work offsets and the points of G28 and G30 are before the program, as far as that is
  // known of the setup.
  WorkOffsets work_offsets{};
  std::array<AxisTarget, 2> reference_points{};
  // Words of the machine's builder, and how numbers without a decimal point count.
  ControlSettings control{};
  // LinuxCNC: the unit of the machine, in which parameters such as #5221 and #5403 count.
  LengthUnit machine_unit = LengthUnit::millimetre;
  // Subprograms within subprograms.
  std::size_t max_call_depth = 32;
  // Folders with subprograms of their own file, in this order.
  std::vector<std::filesystem::path> search_path{};
  // A program that runs more blocks than this beyond the lines of its files, by repeats within
  // repeats, is taken for a mistake; max_blocks of `control` goes before it.
  std::uint64_t max_blocks = 2'000'000;
  // So is one that runs more than this without moving an axis.
  std::uint64_t max_idle_blocks = 1'000'000;
  // Looks on: called before each block that is run or passed over; false ends the run there.
  std::function<bool(const BlockAhead&)> watch{};
  // Takes the error of a block that cannot be run, which is then passed over as if it were not
  // there; false ends the run. Without it the first error ends the run.
  std::function<bool(Diagnostic&&)> go_on{};
};

struct RunSummary {
  ModalState state{};        // at the end
  std::uint64_t blocks = 0;  // that were run
};

[[nodiscard]] Result<RunSummary> interpret(const Program& program, const MotionSink& sink,
                                           const InterpreterOptions& options = {});

// All motions at once, for programs that fit into memory.
[[nodiscard]] Result<std::vector<Motion>> motions_of(const Program& program,
                                                     const InterpreterOptions& options = {});

}  // namespace frustum::parser
