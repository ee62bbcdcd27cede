// APT CLDATA.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr LetterSet kOffsetWord{"H"};
constexpr std::array kCodes{
    named("UNITS/MM", unit, LengthUnit::millimetre),
    named("UNITS/INCHES", unit, LengthUnit::inch),
    named("MULTAX/ON", length_compensation, LengthWord::tool_vectors, kOffsetWord),
    named("MULTAX/OFF", length_compensation, LengthWord::length, kOffsetWord),
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
    named("plane XY", plane, Plane::xy),
    named("plane ZX", plane, Plane::zx),
    named("plane YZ", plane, Plane::yz),
    named("FROM", non_modal, NonModal::start, LetterSet("XYZabc")),
    named("GOHOME", non_modal, NonModal::home),
    named("DELAY", non_modal, NonModal::dwell, LetterSet("P")),
    named("DELAY REV", non_modal, NonModal::dwell),
    named("STOP", stop, StopKind::program_stop),
    named("OPSTOP", stop, StopKind::optional_stop),
    named("END", stop, StopKind::program_end),
    named("FINI", stop, StopKind::program_end),
};

constexpr std::array kRefusedWords{
    RefusedWord{"CYCLE", "write the cycle out as GOTO records"},
    RefusedWord{"CUTCOM", "let the CAM system write the path of the tool tip"},
    RefusedWord{"TRANS", "let the CAM system write the path where the part is"},
    RefusedWord{"ROTATE", "give tool vectors in GOTO after MULTAX/ON"},
    RefusedWord{"ORIGIN", "set the work offset in the job"},
    RefusedWord{"COPY", "write the path out"},
    RefusedWord{"TRACUT", "write the path out"},
    RefusedWord{"CALSUB", "write the path out"},
    RefusedWord{"RETRCT", "write the retract as a GOTO record"},
    RefusedWord{"MOVARC", "write the arc as CIRCLE and GOTO"},
    RefusedWord{"TLAXIS", "give the tool vector in GOTO after MULTAX/ON"},
};

constexpr std::array kLetters{
    LetterUse{'a', "tool vectors need MULTAX/ON"},
    LetterUse{'b', "tool vectors need MULTAX/ON"},
    LetterUse{'c', "tool vectors need MULTAX/ON"},
};
constexpr std::array kDwell{DwellWord{'P', DwellUnit::seconds},
                            DwellWord{'S', DwellUnit::revolutions}};

constexpr DialectRules kRules{
    .dialect = Dialect::cldata,
    .codes = {kCodes},
    .refused_words = kRefusedWords,
    .vector_letters = "abc",
    .vector_spelling = "i, j, k",
    .vector_hint = "switch it on with MULTAX/ON",
    .dwell = kDwell,
    .dwell_hint = "write DELAY/seconds or DELAY/n,REV",
    .tool_brings_length = true,
    .home_without_axes_is_all = true,
    .always_claimed = LetterSet("FST"),
    .letters = kLetters,
};

}  // namespace

const DialectRules& cldata_rules() { return kRules; }

}  // namespace frustum::parser
