// Klartext of Heidenhain.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr LetterSet kHeidenhainHoleWords{"zuvVQwPfrW"};
constexpr LetterSet kSurfaceNormal{"nos"};
constexpr std::array kHeidenhainCodes{
    passed('M', 60),  // the change itself is TOOL CALL
    named("BEGIN PGM MM", unit, LengthUnit::millimetre),
    named("BEGIN PGM INCH", unit, LengthUnit::inch),
    named("END PGM", stop, StopKind::program_end),
    named("STOP", stop, StopKind::program_stop),
    named("L", motion, MotionMode::linear),
    named("L FMAX", motion, MotionMode::traverse),
    named("L A+Q120 B+Q121 C+Q122", non_modal, NonModal::align),
    named("LN", motion, MotionMode::linear, kSurfaceNormal),
    named("LN FMAX", motion, MotionMode::traverse, kSurfaceNormal),
    named("CC", non_modal, NonModal::pole, LetterSet("XYZ")),
    named("C DR-", motion, MotionMode::arc_clockwise),
    named("C DR+", motion, MotionMode::arc_counterclockwise),
    named("CR DR-", motion, MotionMode::arc_clockwise),
    named("CR DR+", motion, MotionMode::arc_counterclockwise),
    named("CT", motion, MotionMode::arc_counterclockwise, LetterSet("k")),
    named("RND", corner, CornerWord::rounding, LetterSet("Rf")),
    named("CHF", corner, CornerWord::chamfer, LetterSet("Rf")),
    named("APPR LT", approach, ApproachWord::line_along, LetterSet("XYZABCpqld")),
    named("APPR LN", approach, ApproachWord::line_across, LetterSet("XYZABCpqld")),
    named("APPR CT", approach, ApproachWord::arc, LetterSet("XYZABCpqRid")),
    named("APPR LCT", approach, ApproachWord::line_and_arc, LetterSet("XYZABCpqRd")),
    named("DEP LT", approach, ApproachWord::leave_along, LetterSet("Zld")),
    named("DEP LN", approach, ApproachWord::leave_across, LetterSet("Zld")),
    named("DEP CT", approach, ApproachWord::leave_by_arc, LetterSet("ZRid")),
    named("DEP LCT", approach, ApproachWord::leave_by_arc_and_line, LetterSet("XYZABCpqRd")),
    named("TOOL CALL", tool_change, 0),
    named("TOOL DEF", non_modal, NonModal::tool_data, LetterSet("eLR")),
    named("F AUTO", feed_source, 0),
    named("R0", radius_compensation, RadiusWord::off),
    named("RL", radius_compensation, RadiusWord::left),
    named("RR", radius_compensation, RadiusWord::right),
    named("CYCL DEF 247", work_offset, 0, LetterSet("P")),
    named("CYCL DEF 7", non_modal, NonModal::shift, LetterSet("XYZABC")),
    named("CYCL DEF 8", mirror, MirrorWord::on, LetterSet("XYZ")),
    named("CYCL DEF 8 OFF", mirror, MirrorWord::off),
    named("CYCL DEF 11", scaling, ScalingWord::on, LetterSet("XYZP")),
    named("CYCL DEF 26", scaling, ScalingWord::on, LetterSet("XYZIJK")),
    named("CYCL DEF 19", tilted_plane, TiltWord::spatial, LetterSet("ABCd")),
    named("CYCL DEF 19 OFF", tilted_plane, TiltWord::off),
    named("CYCL DEF 10", tilted_plane, TiltWord::turn, LetterSet("XYR")),
    named("CYCL DEF 200", hole_cycle, HoleWord::drill, kHeidenhainHoleWords),
    named("CYCL DEF 201", hole_cycle, HoleWord::bore, kHeidenhainHoleWords),
    named("CYCL DEF 207", hole_cycle, HoleWord::tap, kHeidenhainHoleWords),
    named("CYCL DEF 203", hole_cycle, HoleWord::deep, kHeidenhainHoleWords | LetterSet("DLKH")),
    named("CYCL DEF 205", hole_cycle, HoleWord::deep_pecks,
          kHeidenhainHoleWords | LetterSet("DLEHgh")),
    named("CYCL DEF 206", hole_cycle, HoleWord::tap, kHeidenhainHoleWords),
    named("CYCL DEF 209", hole_cycle, HoleWord::tap, kHeidenhainHoleWords | LetterSet("EH")),
    named("CYCL DEF 202", hole_cycle, HoleWord::bore_oriented,
          kHeidenhainHoleWords | LetterSet("no")),
    named("CYCL DEF 240", hole_cycle, HoleWord::drill, kHeidenhainHoleWords),
    named("CYCL DEF 241", hole_cycle, HoleWord::bore, kHeidenhainHoleWords),
    named("CYCL DEF 1.1", hole_cycle, HoleWord::old_peck, LetterSet("u")),
    named("CYCL DEF 1.2", hole_cycle, HoleWord::old_peck, LetterSet("z")),
    named("CYCL DEF 1.3", hole_cycle, HoleWord::old_peck, LetterSet("Q")),
    named("CYCL DEF 1.4", hole_cycle, HoleWord::old_peck, LetterSet("P")),
    named("CYCL DEF 1.5", hole_cycle, HoleWord::old_peck, LetterSet("f")),
    named("CYCL DEF 2.1", hole_cycle, HoleWord::old_tap, LetterSet("u")),
    named("CYCL DEF 2.2", hole_cycle, HoleWord::old_tap, LetterSet("z")),
    named("CYCL DEF 2.3", hole_cycle, HoleWord::old_tap, LetterSet("P")),
    named("CYCL DEF 2.4", hole_cycle, HoleWord::old_tap, LetterSet("f")),
    named("CYCL DEF 17.1", hole_cycle, HoleWord::old_tap, LetterSet("u")),
    named("CYCL DEF 17.2", hole_cycle, HoleWord::old_tap, LetterSet("z")),
    named("CYCL DEF 17.3", hole_cycle, HoleWord::old_tap, LetterSet("r")),
    named("CYCL CALL", hole_call, HoleCall::here),
    named("CYCL CALL POS", hole_call, HoleCall::at_place, LetterSet("XYZ")),
    named("CYCL CALL PAT", hole_call, HoleCall::points),
    named("PATTERN DEF", hole_pattern, PatternWord::points),
    named("CYCL DEF 220", hole_call, HoleCall::ring, LetterSet("xydabcKuVvel")),
    named("CYCL DEF 221", hole_call, HoleCall::grid, LetterSet("xyabcKLuVve")),
    modal('M', 990, hole_call, HoleCall::here),
    modal('M', 890, hole_call, HoleCall::at_moves),
    named("M140 MB MAX", non_modal, NonModal::retract_tool, LetterSet("f")),
    named("M140", non_modal, NonModal::retract_tool, LetterSet("zf")),
    named("FN 14", raised_error, 0, LetterSet("E")),
    named("TCH PROBE", non_modal, NonModal::probing_cycle),
    named("DWELL", non_modal, NonModal::dwell, LetterSet("P")),
    named("PLANE SPATIAL", tilted_plane, TiltWord::spatial, LetterSet("ABCdm")),
    named("PLANE PROJECTED", tilted_plane, TiltWord::projected, LetterSet("IJKdm")),
    named("PLANE EULER", tilted_plane, TiltWord::turns, LetterSet("IJKdm")),
    named("PLANE VECTOR", tilted_plane, TiltWord::vectors, LetterSet("ABCIJKdm")),
    named("PLANE POINTS", tilted_plane, TiltWord::points, LetterSet("XYZIJKuvwdm")),
    named("PLANE RELATIV", tilted_plane, TiltWord::relative, LetterSet("ABCdm")),
    named("PLANE RESET", tilted_plane, TiltWord::off, LetterSet("dm")),
    named("FUNCTION TCPM", tool_tip, TipWord::on),
    named("FUNCTION RESET TCPM", tool_tip, TipWord::off),
    named("PATHCTRL AXIS", orientation_path, OrientationPath::rotary_axes),
    named("PATHCTRL VECTOR", orientation_path, OrientationPath::great_circle),
    modal('M', 910, non_modal, NonModal::machine_coordinates),
    modal('M', 920, non_modal, NonModal::machine_coordinates),
    modal('M', 1260, rotary_path, RotaryPath::shortest),
    modal('M', 1270, rotary_path, RotaryPath::as_programmed),
    modal('M', 1280, tool_tip, TipWord::on),
    modal('M', 1290, tool_tip, TipWord::off),
    modal('M', 1360, feed_mode, FeedMode::per_revolution),
    modal('M', 1370, feed_mode, FeedMode::per_minute),
    passed('M', 900),                             // corners at a constant speed
    passed('M', 940, CodeGroup::rotary_display),  // less than a turn again
    passed('M', 970),   // small steps of a contour, which matter beside it only
    passed('M', 980),   // open corners, likewise
    passed('M', 1010),  // another tool when this one is worn
    passed('M', 1020),
    passed('M', 1030),  // the feed down
    passed('M', 1050),
    passed('M', 1060),
    passed('M', 1070),  // no stop at oversized tools
    passed('M', 1080),
    passed('M', 1090),  // the feed of the edge at arcs
    passed('M', 1100),
    passed('M', 1110),
    passed('M', 1120),  // transitions between moves
    passed('M', 1130),
    passed('M', 1160),  // the feed of rotary axes
    passed('M', 1170),
    passed('M', 1180),  // the handwheel beside the program
    passed('M', 1200),  // looks ahead along a contour
    passed('M', 1240),
    passed('M', 1340),  // stops at corners of rotary axes
    passed('M', 1350),
    passed('M', 1380),  // which axes tilt
    passed('M', 1410),  // a probe is not watched
    passed('M', 1420),
    passed('M', 1450),
    passed('M', 1480),  // the tool leaves the part at a stop of the machine
    passed('M', 1490),
    passed('M', 1500),
    passed('M', 1970),  // corners of a contour, which matter beside it only
};

// What would change the part and is not simulated.
constexpr std::array kHeidenhainRefusedCodes{
    RefusedCode{'M', 930, 939, "use M91, the machine's own coordinates"},
    RefusedCode{'M', 950, 969, "write the path out as L and C blocks"},
    RefusedCode{'M', 1040, 1049, "set the datum by CYCL DEF 247"},
    RefusedCode{'M', 1140, 1159, "give the path of the tool tip with M128 instead"},
    RefusedCode{'M', 1300, 1309, "program in the tilted plane, or use PLANE RESET"},
    RefusedCode{'M', 1430, 1449, "use FUNCTION TCPM or M128"},
    RefusedCode{'M', 2000, 2049, "programs of laser cutting are not simulated"},
};
constexpr std::array kHeidenhainRefusedWords{
    RefusedWord{"FL", "write the contour with its end points, as L and C blocks"},
    RefusedWord{"FLT", "write the contour with its end points, as L and C blocks"},
    RefusedWord{"FC", "write the contour with its end points, as L and C blocks"},
    RefusedWord{"FCT", "write the contour with its end points, as L and C blocks"},
    RefusedWord{"FPOL", "write the contour with its end points, as L and C blocks"},
    RefusedWord{"FSELECT", "write the contour with its end points, as L and C blocks"},
    RefusedWord{"POLARKIN", "write the path in X and Y"},
    RefusedWord{"SQL", "set what it would read by FN 0: Q1 = +5"},
    RefusedWord{"SPL", "write splines as short L blocks"},
};

constexpr std::string_view kNeedsStatement =
    "axis words belong to L, LN, C, CR and CC; I before one makes it incremental";
constexpr std::string_view kNeedsTcpm = "TX TY TZ give the tool vector in LN after M128";

constexpr std::array kHeidenhainLetters{
    LetterUse{'A', kNeedsStatement},
    LetterUse{'B', kNeedsStatement},
    LetterUse{'C', kNeedsStatement},
    LetterUse{'P', "it belongs to a dwell or a preset"},
    LetterUse{'R', "R and a number give the radius of CR"},
    LetterUse{'X', kNeedsStatement},
    LetterUse{'Y', kNeedsStatement},
    LetterUse{'Z', kNeedsStatement},
    LetterUse{'a', kNeedsTcpm},
    LetterUse{'b', kNeedsTcpm},
    LetterUse{'c', kNeedsTcpm},
    LetterUse{'d', "it belongs to PLANE"},
    LetterUse{'m', "it belongs to PLANE"},
    LetterUse{'p', "PR gives a radius in LP, CP and CTP"},
    LetterUse{'q', "PA gives an angle in LP, CP and CTP"},
    LetterUse{'t', "FT gives the time of a cutting block"},
};
// M5, M9, M127, M129, M137, and the tool change that is only reported.
constexpr std::array kBehindMove{50, 60, 90, 1270, 1290, 1370};
constexpr std::array kHeidenhainDwell{DwellWord{'P', DwellUnit::seconds}};

constexpr std::array<std::string_view, 3> kHeidenhainFiles{"{}.h", "{}.H", "{}.nc"};

constexpr DialectRules kHeidenhainRules{
    .dialect = Dialect::heidenhain,
    .codes = {kHeidenhainCodes, kMachineCodes},
    .refused_codes = kHeidenhainRefusedCodes,
    .refused_words = kHeidenhainRefusedWords,
    .vector_letters = "abc",
    .vector_spelling = "TX TY TZ",
    .vector_hint = "switch it on with M128",
    .dwell = kHeidenhainDwell,
    .dwell_hint = "give the time in seconds",
    .tool_brings_length = true,
    .inch_feed = 0.1,
    .tool_brings_feed = true,
    .tools_are_named_beside_numbers = true,
    .words_behind_move = kBehindMove,
    .arcs_turn_about_pole = true,
    .inserts_corners = true,
    .always_claimed = LetterSet("FSTjU"),
    .unknown_m_words_are_builders = true,
    .steps_may_begin = true,
    .feed_may_be_missing = true,
    .letters = kHeidenhainLetters,
    .known_letters = "X Y Z A B C F FT M R",
    .parameters = {.local_names = "QL", .conditions_may_be_unknown = true},
    .polar_words = LetterSet("pq"),
    .polar = {.about_pole = true, .radius = "PR", .angle = "PA", .pole = "CC"},
    .arcs_lead_on = true,
    .calls_whole_files = true,
    .file_names = kHeidenhainFiles,
};

}  // namespace

const DialectRules& heidenhain_rules() { return kHeidenhainRules; }

}  // namespace frustum::parser
