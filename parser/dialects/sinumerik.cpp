// Sinumerik 840D.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr std::string_view kNoFrames = "write the positions out, in G54 to G57 or with CYCLE800";
constexpr std::string_view kNoTransformation = "only TRAORI is simulated: write the path in X Y Z";
constexpr std::string_view kNoLead = "give the tool vector by A3= B3= C3=";
constexpr std::string_view kNoSplines = "write splines as short G1 blocks";
constexpr std::string_view kNoCycles = "write the cycle out as G0 and G1 blocks";
constexpr std::string_view kNoFlow = "write the blocks out in the order in which they run";
constexpr std::string_view kNoToolOffsets = "give the tool's true size in the job";
constexpr std::string_view kNoApproach = "approach and leave the contour by G1, G2 and G3 blocks";
constexpr std::string_view kNoContourApproach = "approach and leave the contour straight: NORM";
constexpr LetterSet kPoleWords{"XYZpq"};
constexpr LetterSet kDrillingWords{"zVuZdPKQrWfevmtwxeIJEkslghi"};
constexpr int kFirstFurtherOffset = 5050;  // G505
constexpr std::size_t kFurtherOffsets = 95;

// G505 to G599.
constexpr std::array<Code, kFurtherOffsets> further_offsets() {
  std::array<Code, kFurtherOffsets> codes{};
  for (std::size_t i = 0; i < kFurtherOffsets; ++i) {
    const int number = static_cast<int>(i);
    codes[i] = modal('G', kFirstFurtherOffset + 10 * number, work_offset, 5 + number);
  }
  return codes;
}
constexpr auto kFurtherOffsetCodes = further_offsets();

constexpr std::array kSinumerikCodes{
    modal('G', 40, non_modal, NonModal::dwell),
    modal('G', 700, unit, LengthUnit::inch_but_feeds),
    modal('G', 710, unit, LengthUnit::millimetre),
    modal('G', 7000, unit, LengthUnit::inch),
    modal('G', 7100, unit, LengthUnit::millimetre),
    modal('G', 410, radius_compensation, RadiusWord::left),
    modal('G', 420, radius_compensation, RadiusWord::right),
    modal('G', 5000, work_offset, 0),
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
    passed('G', 4500),  // arcs round outer corners, as they always are here
    passed('G', 970),
    passed('G', 620),  // slower in corners
    passed('G', 6210),
    passed('G', 2900),  // the language of Siemens, not ISO
    passed('M', 700),   // the spindle as an axis
    modal('G', 1100, non_modal, NonModal::pole_from_here, kPoleWords),
    modal('G', 1110, non_modal, NonModal::pole_from_origin, kPoleWords),
    modal('G', 1120, non_modal, NonModal::pole_from_pole, kPoleWords),
    modal('G', 330, motion, MotionMode::thread),
    modal('G', 3310, motion, MotionMode::tap_in),
    modal('G', 3320, motion, MotionMode::tap_out),
    modal('G', 630, non_modal, NonModal::floating_tap),
    modal('G', 740, non_modal, NonModal::to_reference_point, kAxisWords),
    modal('G', 750, non_modal, NonModal::to_fixed_point, kAxisWords),
    named("POS", non_modal, NonModal::positioning),
    named("CT", motion, MotionMode::arc_tangential),
    named("CIP", motion, MotionMode::arc_through),
    named("MCALL", hole_call, 0),
    named("HOLES1", hole_pattern, PatternWord::row, LetterSet("uvqfdk")),
    named("HOLES2", hole_pattern, PatternWord::circle, LetterSet("uvrqdk")),
    named("CYCLE801", hole_pattern, PatternWord::grid, LetterSet("uvqfdkl")),
    named("CYCLE81", drilling_cycle, DrillingWord::drill, kDrillingWords),
    named("CYCLE82", drilling_cycle, DrillingWord::drill_dwell, kDrillingWords),
    named("CYCLE83", drilling_cycle, DrillingWord::peck, kDrillingWords),
    named("CYCLE84", drilling_cycle, DrillingWord::tap, kDrillingWords),
    named("CYCLE840", drilling_cycle, DrillingWord::floating_tap, kDrillingWords),
    named("CYCLE85", drilling_cycle, DrillingWord::ream, kDrillingWords),
    named("CYCLE86", drilling_cycle, DrillingWord::bore_oriented, kDrillingWords),
    named("CYCLE87", drilling_cycle, DrillingWord::bore_stop, kDrillingWords),
    named("CYCLE88", drilling_cycle, DrillingWord::bore_dwell, kDrillingWords),
    named("CYCLE89", drilling_cycle, DrillingWord::bore, kDrillingWords),
    modal('M', 170, subprogram, SubprogramWord::leave),
    modal('G', 1530, non_modal, NonModal::machine_coordinates),
    named("SUPA", non_modal, NonModal::machine_coordinates),
    named("TRAORI", tool_tip, TipWord::on),
    named("TRAFOOF", tool_tip, TipWord::off),
    named("TRAOOF", tool_tip, TipWord::off),  // as it is misspelled
    named("ORIAXES", orientation_path, OrientationPath::rotary_axes),
    named("ORIVECT", orientation_path, OrientationPath::great_circle),
    named("ORIPLANE", orientation_path, OrientationPath::great_circle),
    named("CYCLE800", tilted_plane, TiltWord::swivel, LetterSet("XYZABCQduvws")),
    named("TRANS", program_frame, FrameWord::shift, kAxisWords),
    named("ATRANS", program_frame, FrameWord::shift_within, kAxisWords),
    named("ROT", program_frame, FrameWord::turn, LetterSet("XYZR")),
    named("AROT", program_frame, FrameWord::turn_within, LetterSet("XYZR")),
    named("SCALE", program_frame, FrameWord::scale, kLinearWords),
    named("ASCALE", program_frame, FrameWord::scale_within, kLinearWords),
    named("MIRROR", program_frame, FrameWord::mirror, kLinearWords),
    named("AMIRROR", program_frame, FrameWord::mirror_within, kLinearWords),
    named("CYCLE800()", tilted_plane, TiltWord::off),
    named("ORIWKS", orientation_reference, OrientationReference::workpiece),
    named("ORIMKS", orientation_reference, OrientationReference::machine),
    passed("FFWON"),
    passed("FFWOF"),
    passed("SOFT"),
    passed("BRISK"),
    passed("COMPON"),
    passed("COMPCURV"),
    passed("COMPCAD"),
    passed("COMPOF"),
    passed("COMPSURF"),
    passed("UPATH"),
    passed("DRIVE"),
    passed("DYNNORM"),
    passed("DYNPOS"),
    passed("DYNROUGH"),
    passed("DYNSEMIFIN"),
    passed("DYNFINISH"),
    passed("DYNPREC"),
    passed("ORISON"),
    passed("ORISOF"),
    passed("ORID"),
    passed("ORIC"),
    passed("OSC"),
    passed("OSD"),
    passed("OSOF"),
    passed("OSS"),
    passed("OST"),
    passed("CDON"),
    passed("CDOF"),
    passed("CDOF2"),
    passed("CPRECON"),
    passed("CPRECOF"),
    passed("RTLION"),
    passed("RTLIOF"),
    passed("WALIMON"),
    passed("WALIMOF"),
    passed("FIFOCTRL"),
    passed("STARTFIFO"),
    passed("STOPFIFO"),
    passed("SBLON"),
    passed("SBLOF"),
    passed("DISPLON"),
    passed("DISPLOF"),
    passed("CUT2D"),
    passed("CUT2DF"),
    passed("CUT3DC"),
    passed("CUT3DF"),
    passed("CUT3DFS"),
    passed("CUT3DFF"),
    passed("CUT3DCC"),
    passed("TOROTOF"),
    passed("PAROTOF"),
    passed("CUTCONOF"),
    passed("CPMOF"),
    passed("SOFTA"),
    passed("BRISKA"),
    passed("DRIVEA"),
    passed("FLIN"),
    passed("FCUB"),
    passed("ORISROF"),
    passed("CLGOF"),
    passed("SPATH"),
    passed("DIAMOF"),
    passed("CFTCP"),
    passed("CFC"),
    passed("CFIN"),
    passed("NORM"),
    passed("FNORM"),
};

// What would change the part and is not simulated.
constexpr std::array kSinumerikRefusedCodes{
    RefusedCode{'G', 50, 59, "write splines as short G1 blocks"},
    RefusedCode{'G', 340, 359, "write a thread of constant lead: G33"},
    RefusedCode{'G', 4510, 4510, "go round outer corners by an arc: G450"},
    RefusedCode{'G', 580, 599, "shift by TRANS and ATRANS"},
    RefusedCode{'G', 1400, 1489, kNoApproach},
    RefusedCode{'G', 2470, 2489, kNoApproach},
    RefusedCode{'G', 3400, 3489, kNoApproach},
    RefusedCode{'G', 2910, 2919, "the program goes on in the ISO language: read it as fanuc"},
    RefusedCode{'G', 200, 219, "words of the ISO language need G291, or reading as fanuc"},
    RefusedCode{'G', 280, 289, "words of the ISO language need G291, or reading as fanuc"},
    RefusedCode{'G', 430, 449, "words of the ISO language need G291, or reading as fanuc"},
    RefusedCode{'G', 490, 499, "words of the ISO language need G291, or reading as fanuc"},
    RefusedCode{'G', 800, 899, "words of the ISO language need G291, or reading as fanuc"},
    RefusedCode{'G', 960, 969, "give the spindle speed in revolutions per minute"},
};
constexpr std::array kSinumerikRefusedWords{
    RefusedWord{"ROTS", kNoFrames},
    RefusedWord{"AROTS", kNoFrames},
    RefusedWord{"TOFRAME", kNoFrames},
    RefusedWord{"TOROT", kNoFrames},
    RefusedWord{"PAROT", kNoFrames},
    RefusedWord{"TRACYL", kNoTransformation},
    RefusedWord{"TRANSMIT", kNoTransformation},
    RefusedWord{"TRAANG", kNoTransformation},
    RefusedWord{"TCARR", "swivel with CYCLE800"},
    RefusedWord{"LEAD", kNoLead},
    RefusedWord{"TILT", kNoLead},
    RefusedWord{"THETA", "give the direction of the tool alone: A3= B3= C3="},
    RefusedWord{"ORICURVE", "use ORIVECT or ORIAXES"},
    RefusedWord{"ORICONCW", "use ORIVECT or ORIAXES"},
    RefusedWord{"ORICONCCW", "use ORIVECT or ORIAXES"},
    RefusedWord{"ASPLINE", kNoSplines},
    RefusedWord{"BSPLINE", kNoSplines},
    RefusedWord{"CSPLINE", kNoSplines},
    RefusedWord{"POLY", kNoSplines},
    RefusedWord{"INVCW", kNoSplines},
    RefusedWord{"INVCCW", kNoSplines},
    RefusedWord{"DISC", "go round outer corners by an arc: G450 alone"},
    RefusedWord{"DISR", kNoApproach},
    RefusedWord{"DISCL", kNoApproach},
    RefusedWord{"FAD", kNoApproach},
    RefusedWord{"OFFN", "program the path of the tool centre and use G40"},
    RefusedWord{"DL", kNoToolOffsets},
    RefusedWord{"TOFF", kNoToolOffsets},
    RefusedWord{"TOFFL", kNoToolOffsets},
    RefusedWord{"TOFFR", kNoToolOffsets},
    RefusedWord{"TOFFLR", kNoToolOffsets},
    RefusedWord{"FB", "write the feed of the block by F, and the one before by F after it"},
    RefusedWord{"FZ", "give the feed per minute or per revolution by F"},
    RefusedWord{"SVC", "give the spindle speed in revolutions per minute by S"},
    RefusedWord{"FXS", "move to the position by G1"},
    RefusedWord{"MEAS", "leave probing out of the simulated program"},
    RefusedWord{"MEAW", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE61", kNoCycles},
    RefusedWord{"CYCLE60", kNoCycles},
    RefusedWord{"CYCLE62", kNoCycles},
    RefusedWord{"CYCLE64", kNoCycles},
    RefusedWord{"CYCLE70", kNoCycles},
    RefusedWord{"CYCLE71", kNoCycles},
    RefusedWord{"CYCLE73", kNoCycles},
    RefusedWord{"CYCLE74", kNoCycles},
    RefusedWord{"CYCLE75", kNoCycles},
    RefusedWord{"CYCLE78", kNoCycles},
    RefusedWord{"CYCLE79", kNoCycles},
    RefusedWord{"CYCLE90", kNoCycles},
    RefusedWord{"CYCLE802", kNoCycles},
    RefusedWord{"CYCLE899", kNoCycles},
    RefusedWord{"POCKET1", kNoCycles},
    RefusedWord{"POCKET2", kNoCycles},
    RefusedWord{"POCKET5", kNoCycles},
    RefusedWord{"CYCLE63", kNoCycles},
    RefusedWord{"CYCLE72", kNoCycles},
    RefusedWord{"CYCLE76", kNoCycles},
    RefusedWord{"CYCLE77", kNoCycles},
    RefusedWord{"POCKET3", kNoCycles},
    RefusedWord{"POCKET4", kNoCycles},
    RefusedWord{"SLOT1", kNoCycles},
    RefusedWord{"SLOT2", kNoCycles},
    RefusedWord{"LONGHOLE", kNoCycles},
    RefusedWord{"POSA", "move the axis by G0 or G1"},
    RefusedWord{"POSP", "move the axis by G0 or G1"},
    RefusedWord{"MOV", "move the axis by G0 or G1"},
    RefusedWord{"AX", "name the axis: X=5"},
    RefusedWord{"GEOAX", "use the axes X Y Z as the machine has them"},
    RefusedWord{"ROTAX", "use the axes X Y Z as the machine has them"},
    RefusedWord{"MEASURE", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE961", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE971", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE976", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE977", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE978", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE979", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE982", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE996", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE997", "leave probing out of the simulated program"},
    RefusedWord{"CYCLE998", "leave probing out of the simulated program"},
    RefusedWord{"ORIEULER", "give directions by A3= B3= C3="},
    RefusedWord{"ORIRPY", "give directions by A3= B3= C3="},
    RefusedWord{"GOTOS", "write a loop: LOOP and ENDLOOP"},
    RefusedWord{"KONT", kNoContourApproach},
    RefusedWord{"KONTC", kNoContourApproach},
    RefusedWord{"KONTT", kNoContourApproach},
    RefusedWord{"SF", "write threads of one start, which begin at the spindle's mark"},
};

// Cycles and words of lathes.
constexpr std::array<std::string_view, 17> kTurningWords{
    "DIAMON",   "DIAM90",   "DIAM90A",  "DIAMCHAN", "CYCLE92", "CYCLE93",
    "CYCLE94",  "CYCLE95",  "CYCLE96",  "CYCLE97",  "CYCLE98", "CYCLE930",
    "CYCLE940", "CYCLE950", "CYCLE951", "CYCLE952", "CYCLE99"};

constexpr std::string_view kNeedsIsoMotion =
    "axis words need a motion word: G0, G1, G2, G3, CIP, CT or G33";
constexpr std::string_view kSinumerikNeedsArc =
    "I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K)";
constexpr std::string_view kNeedsPolar =
    "AP= and RP= are the end of G0, G1, G2, G3 and CT, or a pole after G110, G111 and G112";
constexpr std::string_view kNeedsThrough = "I1= J1= K1= give a point of the arc after CIP";
constexpr std::string_view kNeedsTraori = "A3= B3= C3= give the tool vector after TRAORI";

constexpr std::array kSinumerikLetters{
    LetterUse{'A', kNeedsIsoMotion},
    LetterUse{'B', kNeedsIsoMotion},
    LetterUse{'C', kNeedsIsoMotion},
    LetterUse{'I', kSinumerikNeedsArc},
    LetterUse{'J', kSinumerikNeedsArc},
    LetterUse{'K', kSinumerikNeedsArc},
    LetterUse{'R', "CR= belongs to G2 and G3, RPL= to ROT"},
    LetterUse{'X', kNeedsIsoMotion},
    LetterUse{'Y', kNeedsIsoMotion},
    LetterUse{'Z', kNeedsIsoMotion},
    LetterUse{'a', kNeedsTraori},
    LetterUse{'b', kNeedsTraori},
    LetterUse{'c', kNeedsTraori},
    LetterUse{'e', "TURN= belongs to G2 and G3"},
    LetterUse{'n', "ANG= belongs to G0 and G1"},
    LetterUse{'o', "AR= belongs to G2 and G3"},
    LetterUse{'p', kNeedsPolar},
    LetterUse{'q', kNeedsPolar},
    LetterUse{'u', kNeedsThrough},
    LetterUse{'v', kNeedsThrough},
    LetterUse{'w', kNeedsThrough},
};
constexpr std::array kSinumerikDwell{DwellWord{'F', DwellUnit::seconds},
                                     DwellWord{'S', DwellUnit::revolutions}};

constexpr std::array<std::string_view, 4> kFileNames{"{}.spf", "{}.SPF", "{}.mpf", "{}.MPF"};

constexpr DialectRules kSinumerikRules{
    .dialect = Dialect::sinumerik,
    .codes = {kSinumerikCodes, kMachineCodes, kIsoCodes, kFurtherOffsetCodes},
    .refused_codes = kSinumerikRefusedCodes,
    .refused_words = kSinumerikRefusedWords,
    .turning_words = kTurningWords,
    .vector_letters = "abc",
    .vector_spelling = "A3= B3= C3=",
    .vector_hint = "switch it on with TRAORI",
    .dwell = kSinumerikDwell,
    .dwell_hint = "give F in seconds, or S in revolutions",
    .tool_brings_length = true,
    .machine_coordinates_keep_length = true,
    .words_behind_move = kStopsBehindMove,
    .first_motion = MotionMode::linear,
    .always_claimed = LetterSet("FSTD"),
    .unknown_m_words_are_builders = true,
    .mist_beside_flood = true,
    .feed_may_be_missing = true,
    .corner_words = LetterSet("rhimfl"),
    .letters = kSinumerikLetters,
    .known_letters = "A B C D F G I J K M N R S T X Y Z A3 B3 C3 CR TURN AP RP AR ANG I1 J1 K1",
    .parameters = {.named_locals = true,
                   .unset_is_zero = true,
                   .prefix = 'R',
                   .first = 0,
                   .last = 999,
                   .names_are_defined = true},
    .polar_words = LetterSet("pq"),
    .polar = {.about_pole = true,
              .origin_is_pole = true,
              .words_stay = true,
              .radius = "RP",
              .angle = "AP",
              .pole = "G111"},
    .leads_by_axis = true,
    .arcs_lead_on = true,
    .offset_loads_again = true,
    .planes_end_frames = true,
    .subprograms_are_programs = true,
    .file_names = kFileNames,
};

}  // namespace

const DialectRules& sinumerik_rules() { return kSinumerikRules; }

}  // namespace frustum::parser
