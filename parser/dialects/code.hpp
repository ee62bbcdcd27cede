// A word that a program may use, and what it sets.
//
// A code is a G or M number, or a word without one (TRAORI, TOOL CALL). It belongs to a modal
// group, of which a block may hold one word. Codes that are known but change nothing that is
// simulated are events; codes that would change the part and are not simulated are refused with a
// remedy.
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "parser/language/block.hpp"
#include "parser/language/letter_set.hpp"

namespace frustum::parser {

enum class CodeGroup : std::uint8_t {
  motion,
  cycle,  // G80, which may be beside G0 in a safe line; alone it cancels the motion
  non_modal,
  plane,
  distance,
  arc_distance,
  feed_mode,
  feed_source,
  unit,
  diameter,
  radius_compensation,
  length_compensation,
  tool_tip,
  work_offset,
  tilted_plane,
  program_frame,
  polar,
  scaling,
  mirror,
  orientation_path,
  orientation_reference,
  rotary_path,
  rotary_display,
  path_control,
  retract,
  speed_mode,
  saved_modes,
  hole_cycle,
  hole_call,
  drilling_cycle,
  hole_pattern,
  bolt_holes,
  tapping,
  corner,
  approach,
  raised_error,
  tool_change,
  spindle,
  coolant,
  stop,
  subprogram,
  event,  // no group: several may be in a block
};
constexpr std::size_t kCodeGroups = static_cast<std::size_t>(CodeGroup::event);

// The values of the groups that have no enum of their own.
enum class ToolWord : std::uint8_t {
  change,
  is
};  // is: which one is in the spindle, without a change
enum class NonModal : std::uint8_t {
  none,
  dwell,
  home,
  machine_coordinates,
  align,  // the rotary axes to the normal of the tilted plane
  pole,   // the centre of the arcs that follow
  // what polar positions count from: from where the tool is, the origin, or the last pole
  pole_from_here,
  pole_from_origin,
  pole_from_pole,
  start,         // where the tool is before the program moves it
  second_home,   // G30
  retract_tool,  // M140: away along the tool
  keep_home,     // G28.1: where the axes are is home from now on
  keep_second_home,
  skip,            // G31: a probing move that may meet nothing
  check_home,      // G27
  from_home,       // G29: by the place that G28 went by
  data,            // G10
  tool_data,       // TOOL DEF
  shift_to_place,  // G92: so that the tool is where the words say
  shift,           // G52
  shift_off,
  shift_suspend,
  shift_resume,
  probing_cycle,       // TCH PROBE: the probe or the tool is measured
  floating_tap,        // G63: a line of its block alone
  to_reference_point,  // G74, and G75 to a point of the builder
  to_fixed_point,
  positioning  // POS[X]=: the axes go by themselves
};
[[nodiscard]] constexpr bool is_pole(NonModal word) {
  return word >= NonModal::pole && word <= NonModal::pole_from_pole;
}
// G65 and G66 are read by themselves, since their letters are arguments.
// Of Haas: a call of blocks of the same program (M97), a jump where a signal is off (M96).
enum class SubprogramWord : std::uint8_t {
  none,
  call,
  call_blocks,
  jump_by_signal,
  leave,
  macro,
  end_modal
};
// From length_only on they leave the tool-tip switch as it is.
enum class LengthWord : std::uint8_t {
  off,
  length,
  tool_centre_point,
  tool_vectors,
  length_only,
  length_only_off,
  dynamic,     // G43.1: the axis words are the tool's offset
  additional,  // G43.2: added to the offset in force
  negative     // G44: the length is subtracted
};
// By diameter: in D. In space: to the side of a tool that may be tilted, where its radius is known.
enum class RadiusWord : std::uint8_t {
  off,
  left,
  right,
  left_by_diameter,
  right_by_diameter,
  left_in_space,
  right_in_space
};
enum class TipWord : std::uint8_t { off, on };
enum class CoolantWord : std::uint8_t { off, flood };
enum class DiameterWord : std::uint8_t { radius, diameter };
enum class SpeedWord : std::uint8_t { revolutions, surface };
enum class SavedModesWord : std::uint8_t { save, drop, restore, save_for_call };
enum class CornerWord : std::uint8_t { rounding, chamfer };
// Ways on to a contour and off it (APPR, DEP): contour_approach.hpp.
enum class ApproachWord : std::uint8_t {
  line_along,   // the line goes on into the contour
  line_across,  // and stands upright on it
  arc,          // touches the contour; of so many degrees
  line_and_arc,
  leave_along,
  leave_across,
  leave_by_arc,
  leave_by_arc_and_line
};
[[nodiscard]] constexpr bool is_departure(ApproachWord word) {
  return word >= ApproachWord::leave_along;
}
enum class PolarWord : std::uint8_t { off, on };
enum class ScalingWord : std::uint8_t { off, on };
enum class MirrorWord : std::uint8_t { off, on };
enum class RetractWord : std::uint8_t { initial, level };
// What is done at each hole that the program names by itself: hole_cycle.hpp.
// `deep` and `deep_pecks` are those of deep_hole.hpp, 203 and 205.
enum class HoleWord : std::uint8_t {
  off,
  on,
  drill,
  peck,
  break_chip,
  tap,
  bore,
  deep,
  deep_pecks,
  bore_oriented,  // 202: the tool leaves the wall before it goes back
  old_peck,       // a part of the definition alone
  old_tap
};
// Where the hole cycle in force is done.
enum class HoleCall : std::uint8_t {
  here,
  at_moves,  // from now on where each move ends
  at_place,
  ring,
  grid,
  points  // those of PATTERN DEF
};
// What is done at the hole where the tool is: drilling_cycle.hpp.
enum class DrillingWord : std::uint8_t {
  drill,          // CYCLE81
  drill_dwell,    // CYCLE82
  peck,           // CYCLE83
  tap,            // CYCLE84
  floating_tap,   // CYCLE840: as the spindle turns at the hole
  ream,           // CYCLE85: in and out by feeds of its own
  bore_oriented,  // CYCLE86: the tool leaves the wall before it goes back
  bore_stop,      // CYCLE87: stops for the operator, CYCLE88 after a dwell
  bore_dwell,
  bore  // CYCLE89: feeds out
};
// Places at which the drilling cycle in force is called: hole_pattern.hpp.
enum class PatternWord : std::uint8_t { row, circle, grid, points };
// Places at which a canned cycle drills beside where the tool is (Haas).
enum class BoltWord : std::uint8_t { circle, arc, line };
// The programmable frame: the first four replace it, the others go on within it.
enum class FrameWord : std::uint8_t {
  shift,
  turn,
  scale,
  mirror,
  shift_within,
  turn_within,
  scale_within,
  mirror_within
};
// Where the frame of a tilted plane comes from.
enum class TiltWord : std::uint8_t {
  off,
  swivel,          // shift X Y Z; turns A B C in the order that Q names; shift u v w
  turn,            // G68: about the centre X Y by R, in the plane; about I J K by R, in space
  feature,         // G68.2: shift X Y Z, turned as P says (feature_frame.hpp)
  feature_within,  // G68.4: the same, in the frame at work
  spatial,         // turns A B C about the axes of the untilted X, Y, Z in this order
  turns,           // I J K about Z, the new X, the new Z
  vectors,         // X along A B C, Z along I J K
  points,          // X from X Y Z to I J K, Y to the side of u v w
  relative,        // a turn A, B or C in the frame at work
  projected,       // the lines of the plane above X and Y, turned by I and J; X turned by K
};

struct Code {
  char letter;  // G or M; '@' for a word without number
  int tenths;   // ten times the number: G43.4 has 434
  CodeGroup group;
  std::uint8_t value;     // enumerator of what the group sets
  LetterSet arguments;    // words that belong to this code
  bool event;             // known, not simulated
  std::string_view word;  // for '@'

  [[nodiscard]] std::string name() const;
};

// Rows of the tables: a word that sets something,
template <typename Value>
constexpr Code modal(char letter, int tenths, CodeGroup group, Value value,
                     LetterSet arguments = {}) {
  return {letter, tenths, group, static_cast<std::uint8_t>(value), arguments, false, {}};
}
template <typename Value>
constexpr Code named(std::string_view word, CodeGroup group, Value value,
                     LetterSet arguments = {}) {
  return {kNamedWord, 0, group, static_cast<std::uint8_t>(value), arguments, false, word};
}
// and one that is known and not simulated.
constexpr Code passed(char letter, int tenths, CodeGroup group = CodeGroup::event,
                      LetterSet arguments = {}) {
  return {letter, tenths, group, 0, arguments, true, {}};
}
constexpr Code passed(std::string_view word, CodeGroup group = CodeGroup::event) {
  return {kNamedWord, 0, group, 0, {}, true, word};
}

// Codes, or a word, that would change the part and that are not simulated.
struct RefusedCode {
  char letter;
  int first_tenths;
  int last_tenths;
  std::string_view remedy;
};
struct RefusedWord {
  std::string_view word;
  std::string_view remedy;
};

}  // namespace frustum::parser
