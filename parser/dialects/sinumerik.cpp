// Sinumerik 840D.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr std::string_view kNoFrames = "write the positions out, in G54 to G57 or with CYCLE800";
constexpr std::string_view kNoFlow = "write the blocks out in the order in which they run";
constexpr std::array kCodes{
    modal('G', 40, non_modal, NonModal::dwell),
    modal('G', 700, unit, LengthUnit::inch_but_feeds),
    modal('G', 710, unit, LengthUnit::millimetre),
    modal('G', 7000, unit, LengthUnit::inch),
    modal('G', 7100, unit, LengthUnit::millimetre),
    modal('G', 5000, work_offset, 0),
    modal('G', 5050, work_offset, 5),
    modal('G', 5060, work_offset, 6),
    passed('G', 90),  // exact stop on this block
    passed('G', 600, path_control),
    passed('G', 640, path_control),
    passed('G', 6410, path_control),
    passed('G', 6420, path_control),
    passed('G', 6430, path_control),
    passed('G', 6440, path_control),
    passed('G', 6450, path_control),
    passed('G', 6010),  // when an exact stop is reached
    passed('G', 6020),
    passed('G', 6030),
    passed('G', 970),
    modal('M', 170, stop, StopKind::program_end),
    named("SUPA", non_modal, NonModal::machine_coordinates),
    named("TRAORI", tool_tip, TipWord::on),
    named("TRAFOOF", tool_tip, TipWord::off),
    named("ORIAXES", orientation_path, OrientationPath::rotary_axes),
    named("ORIVECT", orientation_path, OrientationPath::great_circle),
    named("ORIPLANE", orientation_path, OrientationPath::great_circle),
    named("CYCLE800", tilted_plane, TiltWord::swivel, LetterSet("XYZABCQduvw")),
    named("CYCLE800()", tilted_plane, TiltWord::off),
    passed("ORIWKS"),  // directions are of the workpiece, as they always are here
    passed("STOPRE"),
    passed("FFWON"),
    passed("FFWOF"),
    passed("SOFT"),
    passed("BRISK"),
    passed("COMPON"),
    passed("COMPCURV"),
    passed("COMPCAD"),
    passed("COMPOF"),
    passed("UPATH"),
    passed("SPATH"),
    passed("DIAMOF"),
    passed("CFTCP"),
    passed("CFC"),
    passed("CFIN"),
    passed("KONT"),
    passed("NORM"),
    passed("FNORM"),
};

// What would change the part and is not simulated.
constexpr std::array kRefusedCodes{
    RefusedCode{'G', 50, 59, "write splines as short G1 blocks"},
    RefusedCode{'G', 330, 359, "leave threading out of the simulated program"},
    RefusedCode{'G', 410, 429, "program the path of the tool centre and use G40"},
    RefusedCode{'G', 740, 759, "move to the positions with SUPA and D0"},
    RefusedCode{'G', 1100, 1129, "write positions in X, Y and Z"},
    RefusedCode{'G', 5070, 5990, "use G54 to G57, G505 and G506"},
    RefusedCode{'G', 960, 969, "give the spindle speed in revolutions per minute"},
};
constexpr std::array kRefusedWords{
    RefusedWord{"TRANS", kNoFrames},
    RefusedWord{"ATRANS", kNoFrames},
    RefusedWord{"ROT", kNoFrames},
    RefusedWord{"AROT", kNoFrames},
    RefusedWord{"ROTS", kNoFrames},
    RefusedWord{"SCALE", kNoFrames},
    RefusedWord{"MIRROR", kNoFrames},
    RefusedWord{"AMIRROR", kNoFrames},
    RefusedWord{"ORIMKS", "give directions in the workpiece frame: ORIWKS"},
    RefusedWord{"ORIEULER", "give directions by A3= B3= C3="},
    RefusedWord{"ORIRPY", "give directions by A3= B3= C3="},
    RefusedWord{"REPEATB", kNoFlow},
    RefusedWord{"CASE", kNoFlow},
    RefusedWord{"CALL", kNoFlow},
    RefusedWord{"EXTCALL", kNoFlow},
    RefusedWord{"PROC", kNoFlow},
    RefusedWord{"DEF", "use R parameters: R1=2.5"},
    RefusedWord{"CIP", "write the arc with G2 or G3"},
    RefusedWord{"CT", "write the arc with G2 or G3"},
    RefusedWord{"DIAMON", "give X as a radius: DIAMOF"},
};

constexpr std::string_view kNeedsIsoMotion = "axis words need a motion word: G0, G1, G2 or G3";
constexpr std::string_view kNeedsArc =
    "I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K)";
constexpr std::string_view kNeedsTraori = "A3= B3= C3= give the tool vector after TRAORI";

constexpr std::array kLetters{
    LetterUse{'A', kNeedsIsoMotion},
    LetterUse{'B', kNeedsIsoMotion},
    LetterUse{'C', kNeedsIsoMotion},
    LetterUse{'H', "auxiliary functions H are not read; leave it out"},
    LetterUse{'I', kNeedsArc},
    LetterUse{'J', kNeedsArc},
    LetterUse{'K', kNeedsArc},
    LetterUse{'P', "TURN= belongs to G2 and G3"},
    LetterUse{'R', "CR= belongs to G2 and G3"},
    LetterUse{'X', kNeedsIsoMotion},
    LetterUse{'Y', kNeedsIsoMotion},
    LetterUse{'Z', kNeedsIsoMotion},
    LetterUse{'a', kNeedsTraori},
    LetterUse{'b', kNeedsTraori},
    LetterUse{'c', kNeedsTraori},
};
constexpr std::array kDwell{DwellWord{'F', DwellUnit::seconds},
                            DwellWord{'S', DwellUnit::revolutions}};

constexpr DialectRules kRules{
    .dialect = Dialect::sinumerik,
    .codes = {kCodes, kMachineCodes, kIsoCodes},
    .refused_codes = kRefusedCodes,
    .refused_words = kRefusedWords,
    .vector_letters = "abc",
    .vector_spelling = "A3= B3= C3=",
    .vector_hint = "switch it on with TRAORI",
    .dwell = kDwell,
    .dwell_hint = "give F in seconds, or S in revolutions",
    .tool_brings_length = true,
    .machine_coordinates_keep_length = true,
    .always_claimed = LetterSet("FSTD"),
    .letters = kLetters,
    .known_letters = "A B C D F G I J K M N R S T X Y Z A3 B3 C3 CR TURN",
};

}  // namespace

const DialectRules& sinumerik_rules() { return kRules; }

}  // namespace frustum::parser
