#include "parser/writing/motion_spelling.hpp"

namespace frustum::parser {
namespace {

constexpr NcSpelling kFanucWords{
    .title = "Fanuc",
    .extension = ".nc",
    .header = "%\nO# ($)",
    .modes = "G21 G90 G17 G40 G49 G80 G94",
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
    .with_vector = "",
    .traverse_feed = "",
    .thread = "G33",
    .lead = "F",
    .lead_by = LeadBy::one_axis,
    .rigid_tap = "",
    .tap_cycle = "M29 S{speed}\nG99 {word} Z{z} R{start} {feed}\nG80",
    .tap_words = {"G84", "G74"},
    .tap_strokes = {},
    .before_strokes = {},
    .modal = true,
    .planes = {"G17", "G18", "G19"},
    .tool_vector = {"I", "J", "K"},
    .vectors_on_arcs = false,
    .home_return = "G91 G28",
    .before_machine_coordinates = "G53",
    .after_machine_coordinates = "",
    .machine_coordinates_compensated = false,
    .circle_centre_block = false,
    .full_turns = "",
    .turns_beyond = 0,
    .feed_modes = {"G94", "G93", "G95"},
    .feed_words = {"F", "F", "F"},
    .feed_mode_blocks = false,
    .arc_feed_is_in_plane = true,
    .no_compensation = "G49",
    .length = "G43 H#",
    .tool_centre_point = "G43.4 H#",
    .tool_vectors = "G43.5 H#",
    .negative_length = "G44 H#",
    .leave_tool_centre_point = "",
    .compensation_by_tool = false,
    .zero_is_spindle = false,
    .orientation_paths = {},
    .rotary_paths = {},
    .tool_change = "T# M6",
    .tool_change_with_speed = "",
    .speed = "S#",
    .spindle = {"M5", "M3", "M4"},
    .coolant = {"M9", "M8"},
    .work_offsets = {"G54", "G55", "G56", "G57", "G58", "G59", "", "", ""},
    .any_work_offset = "",
    .dwell = "G4 X#",
    .stops = {"M0", "M1", "M30"},
};

constexpr NcSpelling linuxcnc_words() {
  NcSpelling s = kFanucWords;
  s.title = "LinuxCNC";
  s.arc_feed_is_in_plane = false;
  s.zero_is_spindle = true;
  s.extension = ".ngc";
  s.header = "%\n($)";
  s.modes = "G21 G90 G91.1 G17 G40 G49 G80 G94";
  s.upper_comments = false;
  s.lead = "K";
  s.lead_by = LeadBy::way;
  s.rigid_tap = "G33.1";
  s.tap_cycle = "";
  s.full_turns = "P#";
  s.tool_vector = {};
  s.tool_vectors = "";
  s.negative_length = "";
  s.tool_centre_point = "G43 H#\nM428";
  s.leave_tool_centre_point = "M429";
  s.work_offsets[6] = "G59.1";
  s.work_offsets[7] = "G59.2";
  s.work_offsets[8] = "G59.3";
  s.dwell = "G4 P#";
  return s;
}

constexpr NcSpelling sinumerik_words() {
  NcSpelling s = kFanucWords;
  s.title = "Sinumerik";
  s.arc_feed_is_in_plane = false;
  s.extension = ".mpf";
  s.header = "; $";
  s.modes = "G710 G90 G17 G40 G94\nTRAFOOF";
  s.footer = "";
  s.comment_open = "; ";
  s.comment_close = "";
  s.message = "MSG(\"$\")";
  s.upper_comments = false;
  s.whole_numbers = WholeNumbers::without_point;
  s.tool_vector = {"A3=", "B3=", "C3="};
  s.vectors_on_arcs = true;
  s.lead = "IJK";
  s.lead_by = LeadBy::longest_axis;
  s.tap_cycle = "SPOS=0\nG331 Z{z} K{signed}\nG332 Z{start} K{signed}";
  s.tap_strokes = {"G331 Z{z} K{signed}", "G332 Z{z} K{signed}"};
  s.before_strokes = "SPOS=0";
  s.home_return = "";
  s.before_machine_coordinates = "SUPA";
  s.machine_coordinates_compensated = true;
  s.full_turns = "TURN=#";
  s.turns_beyond = 1;
  s.no_compensation = "D0";
  s.length = "D1";
  s.tool_centre_point = "D1\nTRAORI";
  s.tool_vectors = "D1\nTRAORI";
  s.negative_length = "";
  s.leave_tool_centre_point = "TRAFOOF";
  s.compensation_by_tool = true;
  s.orientation_paths = {"ORIAXES", "ORIVECT"};
  // A tool change switches the length on; here that is said by D1.
  s.tool_change = "T#\nM6\nD0";
  s.work_offsets = {"G54", "G55", "G56", "G57", "G505", "G506", "", "", ""};
  s.dwell = "G4 F#";
  return s;
}

constexpr NcSpelling kHeidenhainWords{
    .title = "Heidenhain",
    .extension = ".h",
    .header = "BEGIN PGM $ MM",
    .modes = "",
    .footer = "END PGM $ MM",
    .numbered_blocks = true,
    .comment_open = "; ",
    .comment_close = "",
    .message = "",
    .upper_comments = false,
    .whole_numbers = WholeNumbers::without_point,
    .plus_signs = true,
    .traverse = "L",
    .linear = "L",
    .clockwise = "C",
    .counterclockwise = "C",
    .with_vector = "LN",
    .traverse_feed = "R0 FMAX",
    .thread = "",
    .lead = "",
    .lead_by = LeadBy::way,
    .rigid_tap = "",
    .tap_cycle =
        "CYCL DEF 207 RIGID TAPPING Q200=+0 Q201={depth} Q239={signed} Q203={start} "
        "Q204=+0\nCYCL CALL",
    .tap_words = {},
    .tap_strokes = {},
    .before_strokes = {},
    .modal = false,
    .planes = {},
    .tool_vector = {"TX", "TY", "TZ"},
    .vectors_on_arcs = false,
    .home_return = "",
    .before_machine_coordinates = "",
    .after_machine_coordinates = "M91",
    .machine_coordinates_compensated = false,
    .circle_centre_block = true,
    .full_turns = "",
    .turns_beyond = 0,
    .feed_modes = {"M137", "", "M136"},
    .feed_words = {"F", "FT", "F"},
    // M137 counts when the move of its block is done, F before.
    .feed_mode_blocks = true,
    .arc_feed_is_in_plane = false,
    .no_compensation = "",
    .length = "",
    .tool_centre_point = "",  // the orientation path says it
    .tool_vectors = "",
    .negative_length = "",
    .leave_tool_centre_point = "FUNCTION RESET TCPM",
    .compensation_by_tool = true,
    .zero_is_spindle = false,
    .orientation_paths = {"FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS",
                          "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR"},
    .rotary_paths = {"M127", "M126"},
    .tool_change = "TOOL CALL # Z",
    .tool_change_with_speed = "TOOL CALL # Z S$",
    .speed = "TOOL CALL Z S#\n",
    .spindle = {"M5", "M3", "M4"},
    .coolant = {"M9", "M8"},
    .work_offsets = {},
    .any_work_offset = "CYCL DEF 247 DATUM SETTING Q339=+#",
    .dwell = "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL #",
    .stops = {"M0", "M1", "M30"},
};

constexpr NcSpelling kLinuxCncWords = linuxcnc_words();
constexpr NcSpelling kSinumerikWords = sinumerik_words();

}  // namespace

const NcSpelling* spelling_of(Dialect dialect) {
  switch (dialect) {
    case Dialect::fanuc:
      return &kFanucWords;
    case Dialect::linuxcnc:
      return &kLinuxCncWords;
    case Dialect::sinumerik:
      return &kSinumerikWords;
    case Dialect::heidenhain:
      return &kHeidenhainWords;
    case Dialect::cldata:
      break;
  }
  return nullptr;
}

}  // namespace frustum::parser
