#include "post/nc_spelling.hpp"

namespace frustum::post {
namespace {

constexpr NcSpelling kFanuc{
    .title = "Fanuc",
    .extension = ".nc",
    .header = "%\nO1001 ($)\nG21 G90 G17 G40 G49 G80 G94",
    .footer = "%",
    .numbered_blocks = false,
    .comment_open = "(",
    .comment_close = ")",
    .message = "(MSG,$)",
    .upper_comments = true,
    .whole_numbers = WholeNumbers::with_point,
    .plus_signs = false,
    .traverse = "G0",
    .linear = "G1",
    .clockwise = "G2",
    .counterclockwise = "G3",
    .linear_with_vector = "G1",
    .traverse_feed = "",
    .modal = true,
    .planes = {"G17", "G18", "G19"},
    .tool_vector = {"I", "J", "K"},
    .before_machine_coordinates = "G53 ",
    .after_machine_coordinates = "",
    .circle_centre_block = false,
    .full_turns = "P#",
    .turns_beyond = 0,
    .feed_modes = {"G94", "G93", "G95"},
    .feed_words = {"F", "F", "F"},
    .no_compensation = "G49",
    .length = "G43 H#",
    .tool_centre_point = "G43.4 H#",
    .tool_vectors = "G43.5 H#",
    .leave_tool_centre_point = "",
    .compensation_by_tool = false,
    .orientation_paths = {},
    .rotary_paths = {},
    .tool_change = "T# M6",
    .tool_change_with_speed = "",
    .speed = "S# ",
    .spindle = {"M5", "M3", "M4"},
    .coolant = {"M9", "M8"},
    .work_offset = "G#",
    .first_work_offset = 54,
    .dwell = "G4 X#",
    .stops = {"M0", "M1", "M30"},
};

constexpr NcSpelling linuxcnc() {
  NcSpelling s = kFanuc;
  s.title = "LinuxCNC";
  s.extension = ".ngc";
  s.header = "%\n($)\nG21 G90 G91.1 G17 G40 G49 G80 G94";
  s.upper_comments = false;
  s.tool_vector = {};
  s.tool_vectors = "";
  s.tool_centre_point = "G43 H#\nM428";
  s.leave_tool_centre_point = "M429";
  s.dwell = "G4 P#";
  return s;
}

constexpr NcSpelling kLinuxCnc = linuxcnc();

}  // namespace

const NcSpelling* spelling_of(parser::Dialect dialect) {
  switch (dialect) {
    case parser::Dialect::fanuc:
      return &kFanuc;
    case parser::Dialect::linuxcnc:
      return &kLinuxCnc;
    default:
      return nullptr;
  }
}

}  // namespace frustum::post
