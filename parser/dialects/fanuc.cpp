// Fanuc and what ISO programs have in common with it.
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr LetterSet kFanucOffsetWord{"H"};
constexpr LetterSet kSmoothingWords{"PQR"};
constexpr std::array kFanucCodes{
    modal('G', 40, non_modal, NonModal::dwell, LetterSet("PXU")),
    modal('G', 531, non_modal, NonModal::align),
    modal('G', 680, tilted_plane, TiltWord::turn, LetterSet("XYZIJKR")),
    modal('G', 410, radius_compensation, RadiusWord::left, LetterSet("D")),
    modal('G', 420, radius_compensation, RadiusWord::right, LetterSet("D")),
    modal('G', 412, radius_compensation, RadiusWord::left_in_space, LetterSet("D")),
    modal('G', 422, radius_compensation, RadiusWord::right_in_space, LetterSet("D")),
    modal('G', 430, length_compensation, LengthWord::length, kFanucOffsetWord),
    modal('G', 440, length_compensation, LengthWord::negative, kFanucOffsetWord),
    modal('G', 434, length_compensation, LengthWord::tool_centre_point, kFanucOffsetWord),
    modal('G', 435, length_compensation, LengthWord::tool_vectors, kFanucOffsetWord),
    modal('G', 490, length_compensation, LengthWord::off),
    modal('G', 682, tilted_plane, TiltWord::feature, LetterSet("XYZIJKPQR")),
    modal('G', 684, tilted_plane, TiltWord::feature_within, LetterSet("XYZIJKPQR")),
    modal('G', 150, polar, PolarWord::off),
    modal('G', 160, polar, PolarWord::on),
    modal('G', 500, scaling, ScalingWord::off),
    modal('G', 510, scaling, ScalingWord::on, LetterSet("XYZIJKP")),
    modal('G', 501, mirror, MirrorWord::off, kLinearWords),
    modal('G', 511, mirror, MirrorWord::on, kLinearWords),
    modal('G', 690, tilted_plane, TiltWord::off),
    modal('G', 100, non_modal, NonModal::data, LetterSet("LPRXYZABC")),
    modal('G', 300, non_modal, NonModal::second_home, kAxisWords | LetterSet("P")),
    modal('G', 270, non_modal, NonModal::check_home, kAxisWords),
    modal('G', 290, non_modal, NonModal::from_home, kAxisWords),
    modal('G', 310, non_modal, NonModal::skip),
    modal('G', 330, motion, MotionMode::thread),
    modal('G', 700, unit, LengthUnit::inch),
    modal('G', 710, unit, LengthUnit::millimetre),
    modal('G', 921, non_modal, NonModal::shift_off, kAxisWords),
    modal('G', 541, work_offset, kExtendedWorkOffset, LetterSet("P")),
    passed('G', 50, CodeGroup::event, LetterSet("P")),        // high-speed machining
    passed('G', 51, CodeGroup::event, kSmoothingWords),       // look-ahead contour control
    passed('G', 80, CodeGroup::event, kSmoothingWords),       // look-ahead control
    passed('G', 90),                                          // exact stop on this block
    passed('G', 220, CodeGroup::event, LetterSet("XYZIJK")),  // limits of travel on
    passed('G', 230),                                         // and off
    passed('G', 620, path_control),                           // corners
    passed('G', 630, path_control),                           // tapping
    passed('M', 290, tapping),                                // rigid tap
    // Haas: blocks read ahead, smoothness, work offsets.
    passed('G', 1030, CodeGroup::event, LetterSet("P")),
    passed('G', 1870, CodeGroup::event, LetterSet("PE")),
    modal('G', 1540, work_offset, kExtendedWorkOffset, LetterSet("P")),
    modal('G', 650, subprogram, SubprogramWord::macro),
    modal('G', 660, subprogram, SubprogramWord::macro),
    modal('G', 670, subprogram, SubprogramWord::end_modal),
    modal('G', 760, motion, MotionMode::fine_bore),
    modal('M', 990, subprogram, SubprogramWord::leave, LetterSet("P")),
    // Haas, where they have P.
    modal('M', 960, subprogram, SubprogramWord::jump_by_signal, LetterSet("PQ")),
    modal('M', 970, subprogram, SubprogramWord::call_blocks, kCallWords),
};

// Haas: holes on a circle, an arc and a line. G70 and G71 are units without I and L.
constexpr std::array kFanucCodesBesideL{
    modal('G', 700, bolt_holes, BoltWord::circle),
    modal('G', 710, bolt_holes, BoltWord::arc),
    modal('G', 720, bolt_holes, BoltWord::line),
};

constexpr std::array kFanucDataWords{
    DataWord{1, DataInput::length, LetterSet("R")},
    DataWord{2, DataInput::work_offset, kAxisWords},
    DataWord{10, DataInput::length, LetterSet("R")},
    DataWord{11, DataInput::length_wear, LetterSet("R")},
    DataWord{12, DataInput::radius, LetterSet("R")},
    DataWord{13, DataInput::radius_wear, LetterSet("R")},
    DataWord{20, DataInput::extended_offset, kAxisWords},
};

// What would change the part and is not simulated.
constexpr std::array kFanucRefusedCodes{
    RefusedCode{'G', 52, 69, "write splines as short G1 blocks"},
    RefusedCode{'G', 71, 79, "write the path in X Y Z of the work, not on the unrolled cylinder"},
    RefusedCode{'G', 121, 139, "write the path in X Y Z of the work, with C where it turns"},
    RefusedCode{'G', 281, 289, "return to home with G28"},
    RefusedCode{'G', 311, 319, "probe by G31 and the end of the move"},
    RefusedCode{'G', 320, 329, "cut threads by G33, F the way of one revolution"},
    RefusedCode{'G', 331, 389, "leave threading cycles and measuring out of the simulated program"},
    RefusedCode{'G', 411, 419, "use G41 D, in a plane"},
    RefusedCode{'G', 421, 429, "use G42 D, in a plane"},
    RefusedCode{'G', 431, 439, "use G43 H, G43.4 H or G43.5 H"},
    RefusedCode{'G', 542, 549, "use G54 to G59"},
    RefusedCode{'G', 591, 599, "use G54 to G59"},
    RefusedCode{'G', 661, 669, "call the macro after each block that moves by G66 P"},
    RefusedCode{'M', 1980, 1980, "call it with M98 P: programs are looked for beside this one too"},
    RefusedCode{'G', 532, 539, "turn the tool with G53.1, then go to the place"},
    RefusedCode{
        'G', 683, 683,
        "where the tool points is the machine's to know: give the frame by G68.2 X Y Z I J K"},
    RefusedCode{'G', 681, 689,
                "write the positions out, or use G68.2 X Y Z I J K for a tilted plane"},
    // Haas: pockets and engraving.
    RefusedCode{'G', 120, 120, "write the pocket out as G2 and G1 blocks"},
    RefusedCode{'G', 130, 130, "write the pocket out as G3 and G1 blocks"},
    RefusedCode{'G', 1500, 1500, "write the pocket out as G1 to G3 blocks"},
    RefusedCode{'G', 470, 470,
                "write the letters out as G1 to G3 blocks: their shape is the control's"},
    RefusedCode{'G', 271, 279, "check the reference point by G27"},
    RefusedCode{'G', 291, 299, "go back by G29 or G0 blocks"},
    RefusedCode{'G', 750, 759, "write the cycle out as G0 and G1 blocks"},
};
constexpr std::string_view kFanucNeedsMotion =
    "axis words need a motion word (G0, G1, G2, G3) or G28";
constexpr std::string_view kNeedsVectors =
    "I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K), "
    "and the tool vector of G0 and G1 after G43.5";

constexpr std::array kFanucLetters{
    LetterUse{'A', kFanucNeedsMotion},
    LetterUse{'B', kFanucNeedsMotion},
    LetterUse{'C', kFanucNeedsMotion},
    LetterUse{'D', "D belongs to G41, G42 and G96"},
    LetterUse{'H', "H belongs to G43, G44, G43.4 and G43.5"},
    LetterUse{'I', kNeedsVectors},
    LetterUse{'J', kNeedsVectors},
    LetterUse{'K', kNeedsVectors},
    LetterUse{'L', "L belongs to G10 and M98"},
    LetterUse{'P', "P belongs to G4, G2, G3, M98, G10, G30, G54.1, G5.1, G8 and G64"},
    LetterUse{'Q', "Q belongs to G5.1, G8, G64, G68.2, G73, G76, G83 and G87"},
    LetterUse{'R', "R belongs to G2, G3 and G10"},
    LetterUse{'U', "U belongs to G4"},
    LetterUse{'X', kFanucNeedsMotion},
    LetterUse{'Y', kFanucNeedsMotion},
    LetterUse{'Z', kFanucNeedsMotion},
    LetterUse{'x', ",C belongs to a block of G1 to G3 that moves in the plane"},
    LetterUse{'y', ",R belongs to a block of G1 to G3 that moves in the plane"},
};
constexpr std::array kFanucDwell{DwellWord{'P', DwellUnit::milliseconds_without_point},
                                 DwellWord{'X', DwellUnit::seconds},
                                 DwellWord{'U', DwellUnit::seconds}};
constexpr std::array<std::string_view, 7> kFanucFiles{"{}",     "{}.nc",  "{}.NC", "{}.cnc",
                                                      "{}.tap", "{}.txt", "{}.eia"};

constexpr DialectRules kFanucRules{
    .dialect = Dialect::fanuc,
    .codes = {kFanucCodes, kMachineCodes, kIsoCodes, kRs274Codes},
    .codes_beside_l = kFanucCodesBesideL,
    .refused_codes = kFanucRefusedCodes,
    .vector_letters = "IJK",
    .vector_spelling = "I J K",
    .vector_hint = "switch it on with G43.5",
    .dwell = kFanucDwell,
    .dwell_hint = "give P in milliseconds, or X in seconds",
    .first_tool_may_be_prepared = true,
    .unit_may_be_missing = true,
    .words_behind_move = kStopsBehindMove,
    .always_claimed = LetterSet("FST"),
    .idle_at_zero = LetterSet("IJKRQ"),
    .unknown_m_words_are_builders = true,
    .last_motion_counts = true,
    .starts_with_rapid = true,
    .steps_may_begin = true,
    .offset_numbers_stand_alone = true,
    .length_adds_to_moves = true,
    .local_shift_is_apart = true,
    .arcs_may_lack_centre = true,
    .arc_feed_is_in_plane = true,
    .first_arc_shows_centre = true,
    .feed_may_be_missing = true,
    .letters = kFanucLetters,
    .known_letters = "A B C F G H I J K L M N O P Q R S T U X Y Z",
    .parameters = {.locals = 33,
                   .unset_is_vacant = true,
                   .first_system = 1000,
                   .last_system = 97'999,  // #98000 on are common ones (30i)
                   .first_stored = 500,
                   .last_stored = 999,
                   .last = 999'999},
    .cycles = {.tool_shift_by_q = true,
               .words_keep_their_mode = true,
               .cancel_brings_motion_back = true,
               .hand_retract_ends_at_r = true},
    .radius = {.source = RadiusSource::last_d},
    .data_words = kFanucDataWords,
    .thread_lead = 'F',
    .parameters_count_at_once = true,
    .data_follow_distance_mode = true,
    .file_names = kFanucFiles,
};

}  // namespace

const DialectRules& fanuc_rules() { return kFanucRules; }

}  // namespace frustum::parser
