#include "parser/interpret/filters/corner_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

// What may be in the block of the second move.
constexpr std::array kBesideMoves{CodeGroup::motion, CodeGroup::feed_source, CodeGroup::spindle,
                                  CodeGroup::coolant, CodeGroup::corner};

// Between a corner and the move after it.
Outcome check_between(const InterpreterState& state, const MotionFilters& filters,
                      const BlockWords& words) {
  const auto side = words.value_or(CodeGroup::radius_compensation, RadiusWord::off);
  const auto& on = state.modes.tool_side;  // also of a contour whose tool has no diameter
  const bool same_side = side == (!on                     ? RadiusWord::off
                                  : *on == ToolSide::left ? RadiusWord::left
                                                          : RadiusWord::right);
  for (std::size_t group = 0; group < kCodeGroups; ++group) {
    const GivenCode& other = words[static_cast<CodeGroup>(group)];
    const bool repeated =
        other.code != nullptr && same_side && other.code->group == CodeGroup::radius_compensation;
    const bool pole = group == static_cast<std::size_t>(CodeGroup::non_modal) &&
                      words.value_or(CodeGroup::non_modal, NonModal::none) == NonModal::pole;
    if (other.code == nullptr || other.code->event || repeated || pole ||
        std::find(kBesideMoves.begin(), kBesideMoves.end(), other.code->group) !=
            kBesideMoves.end()) {
      continue;
    }
    return fail(state, other.column, "corner-interrupted"_id,
                fmt::format("{} between {} and the move after it", other.code->name(),
                            filters.corners.corner()->name),
                "write the moves of the contour one after the other");
  }
  return Done{};
}

// ,R and ,C are in the block of the first move: its motions begin to wait, or need not any more.
Outcome prepare_corner(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  const bool has_word = words.has(kCornerRadius) || words.has(kCornerChamfer);
  if (filters.corners.corner()) return check_between(state, filters, words);
  if (!has_word && !filters.passes_corners) return Done{};
  filters.corners.release(filters.to_radius);
  if (has_word == filters.passes_corners) return Done{};
  filters.pass_corners(state, has_word);
  filters.corners.start(state.position.target());
  return Done{};
}

}  // namespace

Outcome insert_corner(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  if (state.rules.dialect == Dialect::fanuc) return prepare_corner(state, filters, words);
  if (!state.rules.inserts_corners) return Done{};
  const GivenCode& code = words[CodeGroup::corner];
  if (filters.corners.corner()) {
    if (auto done = check_between(state, filters, words); !done) return done;
  } else if (code.code == nullptr) {
    filters.corners.release(filters.to_radius);
  }
  if (code.code == nullptr) return Done{};
  Corner corner{.name = code.code->name()};
  corner.rounds = static_cast<CornerWord>(code.code->value) == CornerWord::rounding;
  corner.size = length_of(state, words['R'].value);
  corner.place = state.at_work.place_of(code.column);
  if (!(corner.size > 0.0)) {
    return fail(state, words['R'].column, "value-not-positive"_id,
                fmt::format("the size of {} is not above zero", corner.name),
                "give a size above zero, or leave it out");
  }
  if (words.has('f')) {
    if (!(words['f'].value > 0.0)) {
      return fail(state, words['f'].column, "feed-not-positive"_id,
                  fmt::format("{} is not above zero", words.text_of('f')),
                  "give a feed above zero");
    }
    corner.feed = length_of(state, words['f'].value);
  }
  if (auto failure = filters.corners.insert(corner)) return *std::move(failure);
  return Done{};
}

Outcome keep_corner(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  for (const char letter : {kCornerRadius, kCornerChamfer}) {
    if (!words.has(letter)) continue;
    if (words[letter].value == 0.0) continue;
    Corner corner{.name = words.text_of(letter), .rounds = letter == kCornerRadius};
    corner.size = length_of(state, words[letter].value);
    corner.place = state.at_work.place_of(words[letter].column);
    if (corner.size < 0.0) {
      return fail(state, words[letter].column, "value-not-positive"_id,
                  fmt::format("{} is not above zero", corner.name),
                  "give a size above zero, or leave it out");
    }
    if (auto failure = filters.corners.insert(corner)) return *std::move(failure);
  }
  return Done{};
}

}  // namespace frustum::parser
