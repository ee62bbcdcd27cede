#include "parser/interpret/movement_of_block.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "parser/interpret/frames/tool_compensation.hpp"
#include "parser/interpret/moves/angle_words.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {
namespace {

constexpr LetterSet kMoveWords{"XYZABCIJKRabcpquvw"};
// What a word of the machine's builder may have beside it.
constexpr LetterSet kBuilderArguments{"PQRLEDHIJKSUVW"};

LetterSet centre_letters(Plane plane) {
  constexpr std::array kLetters{LetterSet("IJ"), LetterSet("IK"), LetterSet("JK")};
  return kLetters.at(static_cast<std::size_t>(plane));
}

// The pitch of a helix, beside its end.
LetterSet pitch_letter(const InterpreterState& state, const BlockWords& words) {
  constexpr std::array kLetters{LetterSet("K"), LetterSet("J"), LetterSet("I")};
  const auto plane = static_cast<std::size_t>(words.value_or(CodeGroup::plane, state.modes.plane));
  const LetterSet letter = kLetters.at(plane);
  const bool given = state.rules.dialect == Dialect::fanuc && words[letter.first()].value != 0.0 &&
                     words.has("ZYX"[plane]);
  return given ? letter : LetterSet{};
}

LetterSet letters_of_spline(MotionMode mode) {
  switch (mode) {
    case MotionMode::cubic_spline:
      return kAxisWords | LetterSet("IJPQ");
    case MotionMode::quadratic_spline:
      return kAxisWords | LetterSet("IJ");
    case MotionMode::nurbs:
      return kAxisWords | LetterSet("PL");
    case MotionMode::nurbs_by_knots:
      return kAxisWords | LetterSet("PQRK");
    default:
      return {};
  }
}

LetterSet corner_letters(const InterpreterState& state) {
  return state.rules.dialect == Dialect::fanuc ? LetterSet("xy") : LetterSet{};
}

LetterSet angle_letter(const InterpreterState& state, char letter) {
  LetterSet letters;
  if (state.rules.dialect == Dialect::sinumerik) letters.add(letter);
  return letters;
}

LetterSet motion_words(const InterpreterState& state, const BlockWords& words,
                       const Movement& movement) {
  switch (movement.motion) {
    default:
      // R Q P: depths and dwell; L K: how many; I J K: the shift of G87.
      if (!is_cycle(movement.motion)) return {};
      return kAxisWords | LetterSet("RQPLIJK") | state.rules.polar_words;
    case MotionMode::thread:
      if (state.rules.leads_by_axis) return kAxisWords | LetterSet("IJK");
      return state.rules.thread_lead == 'K' ? kAxisWords | LetterSet("K") : kAxisWords;
    case MotionMode::tap_in:
    case MotionMode::tap_out:
      return kAxisWords | LetterSet("IJK");
    case MotionMode::rigid_tap:
      return kLinearWords | LetterSet("K");
    case MotionMode::thread_cycle:
      return kLinearWords | LetterSet("PIJKRQHEL");
    case MotionMode::probe_towards:
    case MotionMode::probe_towards_if_any:
    case MotionMode::probe_away:
    case MotionMode::probe_away_if_any:
      return kAxisWords;
    case MotionMode::traverse:
    case MotionMode::linear: {
      const bool vectors =
          guides_tip(state, words) && movement.non_modal != NonModal::machine_coordinates;
      LetterSet letters = kAxisWords | state.rules.polar_words;
      if (vectors) letters = letters | LetterSet(state.rules.vector_letters);
      letters = letters | angle_letter(state, kHeading);
      if (movement.motion == MotionMode::linear)
        letters = letters | corner_letters(state) | LetterSet("t");
      return letters;
    }
    case MotionMode::cubic_spline:
    case MotionMode::quadratic_spline:
    case MotionMode::nurbs:
    case MotionMode::nurbs_end:
    case MotionMode::nurbs_by_knots:
      return letters_of_spline(movement.motion);
    case MotionMode::cubic_in_space:
    case MotionMode::arc_about_axis: {
      const LetterSet letters = kAxisWords | LetterSet("IJKPuvw");
      return guides_tip(state, words) ? letters | LetterSet(state.rules.vector_letters) : letters;
    }
    case MotionMode::arc_through:
    case MotionMode::arc_tangential: {
      LetterSet letters = kAxisWords;
      letters = letters | (movement.motion == MotionMode::arc_through ? LetterSet("uvw")
                                                                      : state.rules.polar_words);
      return guides_tip(state, words) ? letters | LetterSet(state.rules.vector_letters) : letters;
    }
    case MotionMode::arc_clockwise:
    case MotionMode::arc_counterclockwise: {
      const LetterSet letters = kAxisWords | LetterSet("RPet") | corner_letters(state) |
                                angle_letter(state, kOpening) | state.rules.polar_words |
                                pitch_letter(state, words) |
                                centre_letters(words.value_or(CodeGroup::plane, state.modes.plane));
      // Where I J K are the tool vector, an arc has them for its centre.
      const bool vectors = guides_tip(state, words) && state.rules.vector_letters != "IJK";
      return vectors ? letters | LetterSet(state.rules.vector_letters) : letters;
    }
  }
}

// A non-modal word that uses the axis words, with what else the block says.
struct NonModalWord {
  const InterpreterState& state;
  const BlockWords& words;
  const GivenCode& given;
  MotionMode mode;

  [[nodiscard]] NonModal word() const { return static_cast<NonModal>(given.code->value); }
  [[nodiscard]] std::string name() const { return given.code->name(); }
  [[nodiscard]] bool names_no_axis() const { return (words.given() & kAxisWords).empty(); }
  [[nodiscard]] Diagnostic without_axes(std::string hint) const {
    return fail(state, given.column, "axes-missing"_id, name() + " names no axis", std::move(hint));
  }
};

// Only a rapid move goes with it.
Outcome check_alone(const NonModalWord& used) {
  const GivenCode& motion = used.words[CodeGroup::motion];
  if (motion.code == nullptr || used.mode == MotionMode::traverse) return Done{};
  return fail(used.state, motion.column, "axis-words-shared"_id,
              fmt::format("{} and {} both use the axis words", used.name(), motion.code->name()),
              "write two blocks");
}

Result<Movement> to_home(const NonModalWord& used) {
  if (auto done = check_alone(used); !done) return std::move(done).error();
  const bool all = used.state.rules.home_without_axes_is_all || used.state.rules.starts_with_rapid;
  if (used.names_no_axis() && !all) {
    return used.without_axes(
        fmt::format("give the axes to send home, for example G91 {} Z0", used.name()));
  }
  return Movement{used.word(), MotionMode::none, used.given.column};
}

Result<Movement> to_end(const NonModalWord& used) {
  if (auto done = check_alone(used); !done) return std::move(done).error();
  if (used.names_no_axis()) {
    return used.without_axes(
        fmt::format("give the end of the move, for example {} Z0", used.name()));
  }
  const bool skips = used.word() == NonModal::skip;
  return Movement{used.word(), skips ? MotionMode::probe_towards_if_any : MotionMode::none,
                  used.given.column};
}

Result<Movement> in_machine_coordinates(const NonModalWord& used) {
  const std::uint32_t column = used.given.column;
  // G53 of Sinumerik holds for its block, which moves nothing.
  const bool rests = used.names_no_axis() && (used.state.rules.starts_with_rapid ||
                                              used.state.rules.dialect == Dialect::sinumerik);
  if (rests) return Movement{used.word(), MotionMode::none, column};
  MotionMode mode = used.mode;
  const bool of_block = used.words.has(CodeGroup::motion);
  if (used.state.rules.starts_with_rapid && !of_block && mode != MotionMode::linear) {
    mode = MotionMode::traverse;
  }
  if (mode != MotionMode::traverse && mode != MotionMode::linear) {
    return fail(used.state, column, "machine-coordinates"_id,
                used.name() + " without a straight move",
                "machine coordinates belong to a straight move, for example G53 G0 Z0");
  }
  if (used.names_no_axis()) return used.without_axes("give the axes to move, for example Z0");
  const bool steps = used.words.value_or(CodeGroup::distance, used.state.modes.distance) ==
                     DistanceMode::incremental;
  for (const AxisLetter axis : kAxisLetters) {
    const GivenWord& word = used.words[to_char(axis)];
    if (!used.words.has(to_char(axis))) continue;
    if (steps && word.measure == Measure::modal) {
      return fail(used.state, column, "machine-coordinates"_id, used.name() + " in G91",
                  "machine coordinates need G90");
    }
    const bool step = word.measure == Measure::incremental;
    if (step && used.state.rules.dialect != Dialect::heidenhain) {
      return fail(
          used.state, word.column, "machine-coordinates"_id,
          fmt::format("{} is a step beside {}", used.words.text_of(to_char(axis)), used.name()),
          "give the place in machine coordinates");
    }
  }
  return Movement{used.word(), mode, column};
}

// A move of the block alone.
Result<Movement> along_line(const NonModalWord& used) {
  if (used.names_no_axis()) {
    return used.without_axes(
        fmt::format("give the end of the move, for example {} Z-10", used.name()));
  }
  const bool taps = used.word() == NonModal::floating_tap;
  return Movement{used.word(), taps ? MotionMode::linear : MotionMode::traverse, used.given.column};
}

// The non-modal words whose axis words are a place to go to.
struct PlaceWord {
  NonModal word;
  Result<Movement> (*movement)(const NonModalWord& used);
};
constexpr std::array kPlaceWords{
    PlaceWord{NonModal::home, to_home},
    PlaceWord{NonModal::second_home, to_home},
    PlaceWord{NonModal::skip, to_end},
    PlaceWord{NonModal::check_home, to_end},
    PlaceWord{NonModal::floating_tap, along_line},
    PlaceWord{NonModal::positioning, along_line},
    PlaceWord{NonModal::to_reference_point, to_home},
    PlaceWord{NonModal::to_fixed_point, to_home},
    PlaceWord{NonModal::from_home, to_end},
    PlaceWord{NonModal::machine_coordinates, in_machine_coordinates},
};

// Groups whose words, where they have arguments, take the axis words.
constexpr std::array kGroupsWithAxes{
    CodeGroup::tilted_plane, CodeGroup::program_frame,  CodeGroup::scaling, CodeGroup::mirror,
    CodeGroup::hole_cycle,   CodeGroup::drilling_cycle, CodeGroup::corner,  CodeGroup::hole_pattern,
    CodeGroup::approach,     CodeGroup::hole_call};

// Whether the axis words are of another word than the motion's.
bool axes_are_taken(const BlockWords& words) {
  for (const CodeGroup group : kGroupsWithAxes) {
    const Code* code = words[group].code;
    if (code != nullptr && !code->arguments.empty()) return true;
  }
  return false;
}

// Of LinuxCNC, motions other than lines and arcs name their end in the block of their word.
Outcome check_end_of_motion(const InterpreterState& state, const GivenCode& motion,
                            MotionMode mode) {
  if (state.rules.dialect != Dialect::linuxcnc || motion.code == nullptr ||
      mode <= MotionMode::arc_counterclockwise) {
    return Done{};
  }
  return fail(state, motion.column, "axes-missing"_id, motion.code->name() + " names no axis",
              "give the end of the motion on the block");
}

}  // namespace

MotionMode motion_of(const InterpreterState& state, const BlockWords& words) {
  const MotionMode after_cancel =
      state.rules.cycles.cancel_brings_motion_back ? state.modes.before_cycle : MotionMode::none;
  const auto mode = words.value_or(CodeGroup::motion,
                                   words.has(CodeGroup::cycle) ? after_cancel : state.modes.motion);
  if (mode != MotionMode::none) return mode;
  return state.rules.starts_with_rapid ? MotionMode::traverse : state.rules.first_motion;
}

Result<Movement> movement_of(const InterpreterState& state, const BlockWords& words) {
  const MotionMode mode = motion_of(state, words);
  const GivenCode& motion = words[CodeGroup::motion];
  const GivenCode& given = words[CodeGroup::non_modal];
  const auto non_modal = words.value_or(CodeGroup::non_modal, NonModal::none);
  const Movement none{non_modal, MotionMode::none, given.column};
  if (non_modal != NonModal::none) {
    for (const PlaceWord& place : kPlaceWords) {
      if (place.word == non_modal) return place.movement({state, words, given, mode});
    }
    if (motion.code == nullptr) return none;
  }
  if (axes_are_taken(words)) return none;
  const bool of_nurbs = mode >= MotionMode::nurbs && mode <= MotionMode::nurbs_by_knots;
  if (motion.code != nullptr && of_nurbs) return Movement{non_modal, mode, motion.column};
  const GivenCode& length = words[CodeGroup::length_compensation];
  const bool axes_of_tool =
      length.code != nullptr && !(length.code->arguments & kAxisWords).empty();
  if (axes_of_tool && motion.code == nullptr) return none;
  // Without an end the arc about the pole goes once round.
  const bool circle =
      state.rules.arcs_turn_about_pole && motion.code != nullptr &&
      (mode == MotionMode::arc_clockwise || mode == MotionMode::arc_counterclockwise);
  const LetterSet move_words = words.given() & kMoveWords;
  if (move_words.empty() && !circle) {
    if (auto done = check_end_of_motion(state, motion, mode); !done) return std::move(done).error();
    return none;
  }
  return Movement{
      non_modal, mode,
      motion.code != nullptr ? motion.column : words[words.first_of(move_words)].column};
}

Result<LetterSet> check_claims(const InterpreterState& state, const BlockWords& words,
                               const Movement& movement) {
  LetterSet claimed = state.rules.always_claimed;
  LetterSet twice;
  const auto claim = [&](LetterSet letters) {
    twice = twice | (claimed & letters);
    claimed = claimed | letters;
  };
  for (std::uint64_t groups = words.groups(); groups != 0; groups &= groups - 1) {
    const Code* code = words[static_cast<CodeGroup>(std::countr_zero(groups))].code;
    if (!code->event) claim(code->arguments);
  }
  for (const GivenCode& event : words.events()) claim(event.code->arguments);
  claim(motion_words(state, words, movement));

  if (const char letter = words.first_of(words.given() & twice); letter != 0) {
    return fail(state, words[letter].column, "word-ambiguous"_id,
                fmt::format("{} could belong to two words of the block", words.text_of(letter)),
                "write two blocks");
  }
  claimed = claimed | state.rules.corner_words;
  if (state.rules.offset_numbers_stand_alone) claimed = claimed | LetterSet("HD");
  LetterSet idle;
  if (!words.builder().empty()) idle = kBuilderArguments;
  if (movement.motion >= MotionMode::traverse && movement.motion <= MotionMode::arc_tangential) {
    for (LetterSet left = state.rules.idle_at_zero; !left.empty(); left = left.without_first()) {
      if (words[left.first()].value == 0.0) idle.add(left.first());
    }
  }
  idle = words.given().without(claimed) & idle;
  const char letter = words.first_of(words.given().without(claimed | idle));
  if (letter == 0) return idle;
  const std::string_view use = letter_use(state.rules, letter);
  if (use.empty()) {
    return fail(state, words[letter].column, "unknown-word"_id,
                "unknown word " + words.text_of(letter),
                fmt::format("known are the letters {}", state.rules.known_letters));
  }
  return fail(state, words[letter].column, "word-unused"_id,
              fmt::format("{} has no meaning in this block", words.text_of(letter)),
              std::string(use));
}

}  // namespace frustum::parser
