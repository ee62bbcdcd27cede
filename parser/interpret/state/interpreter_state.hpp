// All that the interpreter of a program keeps from one block to the next, and how its parts say
// what is wrong or give a motion. What is done with it are free functions: frames/, moves/,
// cycles/, and the order within a block in block_executor.hpp.
//
// Units : mm, rad, mm/min
// Errors: diagnostics with line, column and hint; the file is left to the caller
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "parser/control_settings.hpp"
#include "parser/dialects/dialect_rules.hpp"
#include "parser/interpret/state/control_data.hpp"
#include "parser/interpret/state/modal_state.hpp"
#include "parser/interpret/state/program_position.hpp"
#include "parser/interpret/state/spline_in_progress.hpp"
#include "parser/interpret/state/system_parameters.hpp"
#include "parser/language/block.hpp"
#include "parser/language/letter_set.hpp"
#include "parser/language/parameters.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct Done {};
using Outcome = Result<Done>;

// The block that is carried out.
struct BlockAtWork {
  const Block* block = nullptr;
  std::shared_ptr<const std::string> file{};  // as SourcePlace::file has it
  // Of the main program, where it has called what is at work; 0: the block is the main program's.
  std::uint32_t call_line = 0;
  bool moved = false;  // it has moved an axis

  [[nodiscard]] SourcePlace place_of(std::uint32_t column) const {
    return place_of(*block, column);
  }
  [[nodiscard]] SourcePlace place_of(const Block& of, std::uint32_t column) const {
    SourcePlace place = of.place_of(column);
    place.file = file;
    place.main_line = call_line == 0 ? place.line : call_line;
    return place;
  }
};

// Modes that M70 and M73 keep, of the main program and each call.
struct SavedModes {
  std::optional<ModalState> state{};
  bool comes_back = false;
  bool of_g_words = false;                   // feed, spindle and coolant stay as they are
  LengthUnit unit = LengthUnit::millimetre;  // at the call
};

// After G40 the tool stays beside the contour until a move in the plane.
struct ContourExit {
  AxisTarget place{};
  bool arc_waits = false;  // the move that leaves it may not be an arc
};

// Where the motions go.
struct Output {
  MotionSink take{};
  std::uint64_t moves = 0;              // of axes, that have gone out
  std::optional<Diagnostic> failure{};  // of a motion that could not be made
  std::map<int, std::array<std::optional<double>, 3>>
      programmed_offsets{};                          // as the motions have them
  std::set<std::string, std::less<>> assumptions{};  // that have been told
};

struct InterpreterState {
  InterpreterState(Dialect dialect, const AxisTarget& start, ControlData control_data);
  InterpreterState(const InterpreterState&) = delete;  // its parameters look at it
  InterpreterState& operator=(const InterpreterState&) = delete;

  const DialectRules& rules;
  ControlSettings control{};
  ControlData data;
  ModalState modes{};
  ProgramPosition position;
  std::vector<SavedModes> saved_modes{1};
  SystemParameters system{rules.dialect, modes, position, data};
  Parameters parameters{rules.parameters, &system};
  BlockAtWork at_work{};
  SplineInProgress spline{};
  ContourExit contour_exit{};
  Output output{};
};

// What is wrong with the block at work, at one of its columns.
[[nodiscard]] Diagnostic fail(const InterpreterState& state, std::uint32_t column, DiagnosticId id,
                              std::string message, std::string hint);
[[nodiscard]] Diagnostic fail(const InterpreterState& state, std::uint32_t column,
                              const Diagnostic& found);
// With the line and column of the file instead of the block's.
[[nodiscard]] Diagnostic in_this_block(const InterpreterState& state, Diagnostic diagnostic);

void emit(InterpreterState& state, std::uint32_t column, Command command);
// The program depends on what a control decides by its parameters: an event of the grade `assumed`,
// the first time of each name. `text` says what was taken.
void assume(InterpreterState& state, std::uint32_t column, std::string_view name,
            std::string_view text);

// The program does not know any more where these axes are, since the word.
void forget(InterpreterState& state, LetterSet axes, PositionLoss loss, std::string_view word = {});
// The frame of the pole's coordinates is another one now.
void lose_pole(InterpreterState& state);

}  // namespace frustum::parser
