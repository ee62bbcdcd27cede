// What the program knows of where the axes are, in program coordinates, and why it does not know
// more.
//
// A program that has not yet said where an axis goes, or has moved it by machine coordinates, or
// has changed the frame under it, does not know where it is. Such an axis is absent from the
// targets (it stays where it is) until it is programmed absolutely again; what needs its position
// (G91, arcs) is an error that says why it is not known.
// Units: mm, rad.
// Errors: none; why_unknown() words the hint.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

enum class PositionLoss : std::uint8_t {
  never_programmed,
  home,                 // the word says which: G28, G74
  machine_coordinates,  // G53, SUPA, M91
  work_offset,
  length_compensation,
  tool_vector,  // I J K moved the rotary axes
  tilted_plane,
  turned_frame,  // G68
  probing_cycle,
  tool_change,
  mistake,  // a block that could not be run
};

// A tool change after which Z is not known, and where Z was before it, as far as that was known.
struct HeightBeforeTool {
  std::uint32_t line = 0;
  std::optional<double> height{};
};

// What why_unknown() calls a block that could not be run.
constexpr const char* kMistake = "the mistake";

class ProgramPosition {
 public:
  explicit ProgramPosition(const AxisTarget& start = {}) : target_(start) {
    for (const AxisLetter axis : kAxisLetters) placed_[slot(axis)] = start[axis].has_value();
  }

  // All known axes: what a motion's target carries.
  [[nodiscard]] const AxisTarget& target() const { return target_; }
  [[nodiscard]] const std::optional<double>& operator[](AxisLetter axis) const {
    return target_[axis];
  }

  void set(AxisLetter axis, double value) {
    target_[axis] = value;
    placed_[slot(axis)] = true;
    axes_[axis].reset();
    programmed_[axis].reset();
    if (axis == AxisLetter::Z) tool_change_.reset();
  }
  // The tool change since which nothing has placed Z.
  [[nodiscard]] const std::optional<HeightBeforeTool>& tool_change() const { return tool_change_; }
  void keep_tool_change(const HeightBeforeTool& change) { tool_change_ = change; }
  // Where the program was along an axis before a tool length shifted it, which steps go on from.
  [[nodiscard]] const std::optional<double>& programmed(AxisLetter axis) const {
    return programmed_[axis];
  }
  void keep_programmed(AxisLetter axis, double value) { programmed_[axis] = value; }
  // Where an axis stands, in machine coordinates, while its program coordinate is not known.
  [[nodiscard]] const std::optional<double>& standing(AxisLetter axis) const { return axes_[axis]; }
  void stand(AxisLetter axis, double value) { axes_[axis] = value; }
  // `word`: what the program has written, where messages name it.
  void forget(AxisLetter axis, PositionLoss loss, std::uint32_t line, std::string_view word = {});
  [[nodiscard]] bool never_known(AxisLetter axis) const { return !placed_[slot(axis)]; }
  // Nothing has placed the axis so far, nor moved it.
  [[nodiscard]] bool never_moved(AxisLetter axis) const {
    return never_known(axis) && causes_[slot(axis)].loss == PositionLoss::never_programmed;
  }
  // "X is not known since G28 on line 12", "X has not been programmed yet".
  [[nodiscard]] std::string why_unknown(AxisLetter axis) const;
  // Of an error that says so: "position-unknown", or "follows-mistake" where a block that could not
  // be run is the cause.
  [[nodiscard]] DiagnosticId unknown_id(AxisLetter axis) const;

 private:
  struct Cause {
    PositionLoss loss = PositionLoss::never_programmed;
    std::uint32_t line = 0;
    std::string word{};
  };
  static constexpr std::size_t slot(AxisLetter axis) { return static_cast<std::size_t>(axis); }

  AxisTarget target_{};
  AxisTarget axes_{};
  AxisTarget programmed_{};
  std::optional<HeightBeforeTool> tool_change_{};
  std::array<bool, kAxisLetters.size()> placed_{};
  std::array<Cause, kAxisLetters.size()> causes_{};
};

}  // namespace frustum::parser
