// APT CLDATA.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr LetterSet kCldataOffsetWord{"H"};
constexpr LetterSet kCldataHoleWords{"ZRuvQPfrI"};
constexpr LetterSet kCldataDeepHoleWords{"ZRuvQxPfrI"};
constexpr std::array kCldataCodes{
    named("UNITS/MM", unit, LengthUnit::millimetre),
    named("UNITS/INCHES", unit, LengthUnit::inch),
    named("MULTAX/ON", length_compensation, LengthWord::tool_vectors, kCldataOffsetWord),
    named("MULTAX/OFF", length_compensation, LengthWord::length, kCldataOffsetWord),
    named("LOADTL", tool_change, 0),
    named("SPINDL/CLW", spindle, SpindleDirection::clockwise),
    named("SPINDL/CCLW", spindle, SpindleDirection::counterclockwise),
    named("SPINDL/OFF", spindle, SpindleDirection::off),
    named("COOLNT/ON", coolant, CoolantWord::flood),
    named("COOLNT/OFF", coolant, CoolantWord::off),
    named("FEDRAT/MMPM", feed_mode, FeedMode::per_minute),
    named("FEDRAT/MMPR", feed_mode, FeedMode::per_revolution),
    named("GOTO", motion, MotionMode::linear),
    named("GODLTA", motion, MotionMode::linear),
    named("RAPID GOTO", motion, MotionMode::traverse),
    named("RAPID GODLTA", motion, MotionMode::traverse),
    named("CIRCLE-", motion, MotionMode::arc_clockwise),
    named("CIRCLE+", motion, MotionMode::arc_counterclockwise),
    named("CIRCLE/", motion, MotionMode::arc_about_axis),
    named("NURBS", motion, MotionMode::cubic_in_space),
    named("plane XY", plane, Plane::xy),
    named("plane ZX", plane, Plane::zx),
    named("plane YZ", plane, Plane::yz),
    named("FROM", non_modal, NonModal::start, LetterSet("XYZabc")),
    named("GOHOME", non_modal, NonModal::home),
    named("DELAY", non_modal, NonModal::dwell, LetterSet("P")),
    named("DELAY REV", non_modal, NonModal::dwell),
    named("CYCLE/OFF", hole_cycle, HoleWord::off),
    named("CYCLE/ON", hole_cycle, HoleWord::on),
    named("CYCLE/DRILL", hole_cycle, HoleWord::drill, kCldataHoleWords),
    named("CYCLE/DEEP", hole_cycle, HoleWord::peck, kCldataHoleWords),
    named("CYCLE/DEEP2", hole_cycle, HoleWord::deep_pecks, kCldataDeepHoleWords),
    named("CYCLE/BRKCHP", hole_cycle, HoleWord::break_chip, kCldataHoleWords),
    named("CYCLE/TAP", hole_cycle, HoleWord::tap, kCldataHoleWords | LetterSet("t")),
    named("CYCLE/BORE", hole_cycle, HoleWord::bore, kCldataHoleWords),
    named("STOP", stop, StopKind::program_stop),
    named("OPSTOP", stop, StopKind::optional_stop),
    named("END", stop, StopKind::program_end),
    named("FINI", stop, StopKind::program_end),
};

constexpr std::string_view kWriteOut = "let the CAM system write the path out as GOTO records";
constexpr std::string_view kTipPath = "let the CAM system write the path of the tool tip";
constexpr std::string_view kWherePartIs =
    "let the CAM system write the path where the part is, or set the work offset in the job";
constexpr std::string_view kTiltByVector = "give tool vectors in GOTO after MULTAX/ON";
constexpr std::array kCldataRefusedWords{
    RefusedWord{"SWITCH", kTipPath},
    RefusedWord{"TRANS", kWherePartIs},
    RefusedWord{"TRACUT", kWherePartIs},
    RefusedWord{"SCALE", kWherePartIs},
    RefusedWord{"MIRROR", kWherePartIs},
    RefusedWord{"REFSYS", kWherePartIs},
    RefusedWord{"ROTATE", kTiltByVector},
    RefusedWord{"ROTABL", kTiltByVector},
    RefusedWord{"ROTHED", kTiltByVector},
    RefusedWord{"TABLE", kTiltByVector},
    RefusedWord{"WAXIS", kWriteOut},
    RefusedWord{"ZAXIS", kWriteOut},
    RefusedWord{"LOOPST", kWriteOut},
    RefusedWord{"INCR", "give steps by GODLTA"},
    RefusedWord{"MODE", "give places by GOTO and steps by GODLTA"},
    RefusedWord{"COPY", kWriteOut},
    RefusedWord{"INDEX", kWriteOut},
    RefusedWord{"CALSUB", kWriteOut},
    RefusedWord{"DEFSUB", kWriteOut},
    RefusedWord{"IF", kWriteOut},
    RefusedWord{"JUMPTO", kWriteOut},
    RefusedWord{"READ", kWriteOut},
    RefusedWord{"DNTCUT", kWriteOut},
    RefusedWord{"TOOL", "call the tool by LOADTL/1"},
    RefusedWord{"CALL", kWriteOut},
    RefusedWord{"THREAD", kWriteOut},
    RefusedWord{"RETRCT", "write the retract as a GOTO record"},
    RefusedWord{"PREFUN", "say what the G word does by records of CLDATA"},
    RefusedWord{"GOFWD", kWriteOut},
    RefusedWord{"GOLFT", kWriteOut},
    RefusedWord{"GORGT", kWriteOut},
    RefusedWord{"TLLFT", kTipPath},
    RefusedWord{"TLRGT", kTipPath},
};

constexpr std::array kCldataLetters{
    LetterUse{'a', "tool vectors need MULTAX/ON"},
    LetterUse{'b', "tool vectors need MULTAX/ON"},
    LetterUse{'c', "tool vectors need MULTAX/ON"},
};
constexpr std::array kCldataDwell{DwellWord{'P', DwellUnit::seconds},
                                  DwellWord{'S', DwellUnit::revolutions}};

constexpr DialectRules kCldataRules{
    .dialect = Dialect::cldata,
    .codes = {kCldataCodes},
    .refused_words = kCldataRefusedWords,
    .vector_letters = "abc",
    .vector_spelling = "i, j, k",
    .vector_hint = "switch it on with MULTAX/ON",
    .dwell = kCldataDwell,
    .dwell_hint = "write DELAY/seconds or DELAY/n,REV",
    .tool_brings_length = true,
    .home_without_axes_is_all = true,
    .holes_at_moves = true,
    .always_claimed = LetterSet("FST"),
    .letters = kCldataLetters,
};

}  // namespace

const DialectRules& cldata_rules() { return kCldataRules; }

}  // namespace frustum::parser
