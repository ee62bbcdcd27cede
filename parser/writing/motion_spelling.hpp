// How a controller spells what a canonical motion says: the data in which dialects differ.
//
// Units    : none
// Errors   : none; a word that a dialect lacks is empty, and the writer says so when it is needed
// Source   : programming manuals of the controllers; what parser/ reads
//
// In a pattern `#` represents the number and a line feed begins another line of the program.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "parser/dialect.hpp"
#include "parser/writing/number_text.hpp"

namespace frustum::parser {

// What the lead of a thread counts along: its way; its axis, of which it has one; its longest axis,
// for each of which there is a letter.
enum class LeadBy : std::uint8_t { way, one_axis, longest_axis };

struct NcSpelling {
  std::string_view title;      // of the controller
  std::string_view extension;  // of program files

  // Around the program. `$` represents its name, `#` its number.
  std::string_view header;
  std::string_view modes;  // that it begins with
  std::string_view footer;
  bool numbered_blocks;  // every block begins with its number

  std::string_view comment_open, comment_close;
  std::string_view message;  // `$` represents the text; empty: as a comment
  bool upper_comments;

  WholeNumbers whole_numbers;
  bool plus_signs;  // of coordinates

  // Motions. `modal`: motion words and the words of axes that do not move are left out.
  std::string_view traverse, linear, clockwise, counterclockwise;
  std::string_view with_vector;    // of straight motions with a tool vector; empty: the same
  std::string_view traverse_feed;  // is where F would
  // Synchronised with the spindle, and the letter of the way of a revolution; empty: none.
  std::string_view thread, lead;
  LeadBy lead_by;
  // A rigid tap: to the bottom and back, the spindle reversing. A word in place of that of the
  // thread; or a cycle along Z, after which the spindle is at rest: {z} the bottom and {start} as
  // numbers, {depth} below zero, {lead}, {signed} below zero for a left-handed thread, {feed}
  // (F500), {speed}, {word} by the hand.
  std::string_view rigid_tap;
  std::string_view tap_cycle;
  std::array<std::string_view, 2> tap_words;  // right-handed, left-handed
  // In and out by the lead, the spindle turning by itself, from any place to any other: what a tap
  // in strokes is made of, with {z} and {signed}. `before_strokes` orients the spindle; empty:
  // there is no such word.
  std::array<std::string_view, 2> tap_strokes;
  std::string_view before_strokes;
  bool modal;
  std::array<std::string_view, 3> planes;       // XY ZX YZ
  std::array<std::string_view, 3> tool_vector;  // components; empty: none
  bool vectors_on_arcs;
  std::string_view home_return;
  std::string_view before_machine_coordinates, after_machine_coordinates;
  bool machine_coordinates_compensated;  // the tool length must be off for them
  // CC X.. Y.. before C, else I J K from the start; such arcs are flat, in X and Y, of one turn.
  bool circle_centre_block;
  std::string_view full_turns;  // of arcs of more than one turn; empty: each turn is a block
  int turns_beyond;             // the number written is the turns less this

  // Feeds: words that switch the mode, and how the value is written in it.
  std::array<std::string_view, 3> feed_modes;  // per minute, inverse time, per revolution
  std::array<std::string_view, 3> feed_words;  // `FT`: seconds
  bool feed_mode_blocks;                       // the mode is a block of its own
  bool arc_feed_is_in_plane;                   // arc_feed.hpp

  // States.
  std::string_view no_compensation, length, tool_centre_point, tool_vectors;
  std::string_view negative_length;  // which is subtracted; empty: none
  std::string_view leave_tool_centre_point;
  bool compensation_by_tool;  // the length is that of the tool in the spindle
  bool zero_is_spindle;       // H0 is
  std::array<std::string_view, 2> orientation_paths;  // rotary axes linear, great circle
  std::array<std::string_view, 4> rotary_paths;       // as programmed, shortest, in one direction
  std::string_view tool_change, tool_change_with_speed;
  std::string_view speed;  // of the spindle, beside the word that starts it
  std::array<std::string_view, 3> spindle;
  std::array<std::string_view, 2> coolant;
  std::array<std::string_view, 9> work_offsets;
  std::string_view any_work_offset;  // by its number
  std::string_view dwell;
  std::array<std::string_view, 3> stops;  // program, optional, end
};

// Nothing for dialects that machines do not read.
[[nodiscard]] const NcSpelling* spelling_of(Dialect dialect);

}  // namespace frustum::parser
