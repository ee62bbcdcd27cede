// Carries out one block after another: the state of the program, and the motions that follow from
// it.
//
// Order within a block, RS-274's: comments; parameters; units (LinuxCNC: after F); feed mode; F; S;
// T; M6; M3 M4 M5; M7 M8 M9; words that are only events; G4; plane; compensation; work offset;
// distance mode; G28 or the motion; M words that count after it; stops and calls.
// Units: writes mm, rad, mm/min; reads what the block's G20 or G21 says. G20 scales X Y Z, arc
// centres, R and F; never rotary words, tool vectors, or the F of a purely rotary move.
// Errors: with line, column and hint; the file is left to the caller. Nothing of the block that
// failed is to be relied on.
#pragma once

#include "core/result.hpp"
#include "parser/interpret/block_flow.hpp"
#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

class BlockExecutor {
 public:
  BlockExecutor(Dialect dialect, const AxisTarget& start, ControlData data, const MotionSink& sink);

  [[nodiscard]] InterpreterState& state() { return state_; }
  [[nodiscard]] const InterpreterState& state() const { return state_; }
  [[nodiscard]] Result<Flow> execute(const Block& block);
  // The program ends without a word that says so.
  [[nodiscard]] Outcome end_of_text();
  // The run ends here: no motion waits for the block after it any more.
  void settle() { filters_.corners.release(filters_.to_radius); }

 private:
  InterpreterState state_;
  MotionFilters filters_;
  BlockWords words_{};  // of the block at work
};

// After a block that could not be carried out: the axes that it names are where it says, as far as
// that is plain, and not known otherwise.
void pass_over(InterpreterState& state, const Block& block);

}  // namespace frustum::parser
