// Sinumerik 840D.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"
#include "parser/dialects/sinumerik_refusals.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

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
    passed("FLIN"),
    passed("FCUB"),
    passed("ORISROF"),
    passed("CLGOF"),
    passed("SPATH"),
    passed("CP"),
    passed("LFON"),
    passed("LFOF"),
    passed("LFTXT"),
    passed("LFWP"),
    passed("LFPOS"),
    passed("DIAMOF"),
    passed("CFTCP"),
    passed("CFC"),
    passed("CFIN"),
    passed("NORM"),
    passed("FNORM"),
    passed("BNAT"),
    passed("BTAN"),
    passed("BAUTO"),
    passed("ENAT"),
    passed("ETAN"),
    passed("EAUTO"),
    passed("DIAMCYCOF"),
    passed("FTOCON"),
    passed("FTOCOF"),
    passed("SPOF"),
    passed("PDELAYON"),
    passed("PDELAYOF"),
    passed("SPIF1"),
    passed("SPIF2"),
    passed("TCOABS"),
    passed("ORIROTA"),
    passed("ORIROTR"),
    passed("ORIROTT"),
    passed("ORIROTC"),
    passed("TOWSTD"),
    passed("TOWMCS"),
    passed("TOWWCS"),
    passed("TOWBCS"),
    passed("TOWTCS"),
    passed("TOWKCS"),
    passed("FENDNORM"),
    passed("WALCS0"),
    passed("OSSE"),
    passed("ICYCON"),
    passed("ICYCOF"),
};

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
