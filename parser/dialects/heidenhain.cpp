// Klartext of Heidenhain.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr LetterSet kHeidenhainHoleWords{"zuvVQwPfrW"};
constexpr std::array kHeidenhainCodes{
    passed('M', 60),  // the change itself is TOOL CALL
    named("BEGIN PGM MM", unit, LengthUnit::millimetre),
    named("BEGIN PGM INCH", unit, LengthUnit::inch),
    named("END PGM", stop, StopKind::program_end),
    named("STOP", stop, StopKind::program_stop),
    named("L", motion, MotionMode::linear),
    named("L FMAX", motion, MotionMode::traverse),
    named("LN", motion, MotionMode::linear),
    named("LN FMAX", motion, MotionMode::traverse),
    named("CC", non_modal, NonModal::pole, LetterSet("XY")),
    named("C DR-", motion, MotionMode::arc_clockwise),
    named("C DR+", motion, MotionMode::arc_counterclockwise),
    named("CR DR-", motion, MotionMode::arc_clockwise),
    named("CR DR+", motion, MotionMode::arc_counterclockwise),
    named("CT", motion, MotionMode::arc_counterclockwise, LetterSet("k")),
    named("RND", corner, CornerWord::rounding, LetterSet("Rf")),
    named("CHF", corner, CornerWord::chamfer, LetterSet("Rf")),
    named("TOOL CALL", tool_change, 0),
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
    named("CYCL CALL", hole_call, 0),
    modal('M', 990, hole_call, 0),
    named("FN 14", raised_error, 0, LetterSet("E")),
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
    modal('M', 1260, rotary_path, RotaryPath::shortest),
    modal('M', 1270, rotary_path, RotaryPath::as_programmed),
    modal('M', 1280, tool_tip, TipWord::on),
    modal('M', 1290, tool_tip, TipWord::off),
    modal('M', 1360, feed_mode, FeedMode::per_revolution),
    modal('M', 1370, feed_mode, FeedMode::per_minute),
    passed('M', 900),   // corners at a constant speed
    passed('M', 1070),  // no stop at oversized tools
    passed('M', 1080),
};

// What would change the part and is not simulated.
constexpr std::array kHeidenhainRefusedCodes{
    RefusedCode{'M', 890, 899, "call the cycle by M99 or CYCL CALL at each hole"},
    RefusedCode{'M', 920, 929, "use M91, the machine's own coordinates"},
    RefusedCode{'M', 970, 1039, "write the path out as L and C blocks"},
    RefusedCode{'M', 1090, 1120, "give the feed of the tool tip, without M109 to M112"},
    RefusedCode{'M', 1160, 1180, "give the feed of the tool tip with M128 instead"},
    RefusedCode{'M', 1300, 1309, "program in the tilted plane, or use PLANE RESET"},
    RefusedCode{'M', 1380, 1449, "use FUNCTION TCPM or M128"},
};
constexpr std::array kHeidenhainRefusedWords{
    RefusedWord{"APPR", "write the approach as L and C blocks"},
    RefusedWord{"DEP", "write the departure as L and C blocks"},
    RefusedWord{"CYCL", "write the cycle out as L blocks"},
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

constexpr std::array<std::string_view, 2> kHeidenhainFiles{"{}.h", "{}.H"};

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
    .words_behind_move = kBehindMove,
    .arcs_turn_about_pole = true,
    .inserts_corners = true,
    .always_claimed = LetterSet("FST"),
    .letters = kHeidenhainLetters,
    .known_letters = "X Y Z A B C F FT M R",
    .parameters = {.local_names = "QL"},
    .polar_words = LetterSet("pq"),
    .polar = {.about_pole = true, .radius = "PR", .angle = "PA", .pole = "CC"},
    .arcs_lead_on = true,
    .calls_whole_files = true,
    .file_names = kHeidenhainFiles,
};

}  // namespace

const DialectRules& heidenhain_rules() { return kHeidenhainRules; }

}  // namespace frustum::parser
