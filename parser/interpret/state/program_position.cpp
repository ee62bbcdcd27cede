#include "parser/interpret/state/program_position.hpp"

#include <fmt/format.h>

namespace frustum::parser {
namespace {

constexpr std::array kLossTexts{"",
                                "the return home",
                                "the move in machine coordinates",
                                "the change of work offset",
                                "the change of tool length compensation",
                                "the tool vector",
                                "the change of the tilted plane",
                                "the turn of the frame",
                                "the cycle of the probe",
                                "the tool change",
                                kMistake};

}  // namespace

void ProgramPosition::forget(AxisLetter axis, PositionLoss loss, std::uint32_t line,
                             std::string_view word) {
  // An axis that was not known before keeps its first cause: that is where the remedy belongs. One
  // that stands where it was at the start does so until the machine moves it.
  Cause& cause = causes_[slot(axis)];
  const bool of_machine = loss == PositionLoss::home || loss == PositionLoss::machine_coordinates ||
                          loss == PositionLoss::tool_change;
  const bool moved = of_machine && cause.loss == PositionLoss::never_programmed;
  axes_[axis].reset();
  programmed_[axis].reset();
  if (axis == AxisLetter::Z) tool_change_.reset();
  if (!target_[axis] && !moved) return;
  target_[axis].reset();
  cause = {loss, line, std::string(word)};
}

std::string ProgramPosition::why_unknown(AxisLetter axis) const {
  const Cause& cause = causes_[slot(axis)];
  if (cause.loss == PositionLoss::never_programmed) {
    return fmt::format("{} has not been programmed yet", to_char(axis));
  }
  std::string what = kLossTexts.at(static_cast<std::size_t>(cause.loss));
  if (cause.loss == PositionLoss::home && !cause.word.empty()) {
    what = cause.word;
  } else if (!cause.word.empty()) {
    what += fmt::format(" ({})", cause.word);
  }
  return fmt::format("{} is not known since {} on line {}", to_char(axis), what, cause.line);
}

DiagnosticId ProgramPosition::unknown_id(AxisLetter axis) const {
  const Cause& cause = causes_[slot(axis)];
  return cause.loss == PositionLoss::mistake ? "follows-mistake"_id : "position-unknown"_id;
}

}  // namespace frustum::parser
