#include "parser/interpret/filters/move_corners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

// Beside these in a block the contour goes on.
constexpr std::array kWithinContour{
    CodeGroup::motion,       CodeGroup::spindle,  CodeGroup::coolant,  CodeGroup::stop,
    CodeGroup::path_control, CodeGroup::distance, CodeGroup::feed_mode};

// What ends a contour that a corner waits in: another code than these, but for the plane in force.
const GivenCode* end_of_contour(const InterpreterState& state, const BlockWords& words) {
  for (std::size_t group = 0; group < kCodeGroups; ++group) {
    const GivenCode& code = words[static_cast<CodeGroup>(group)];
    if (code.code == nullptr || code.code->event) continue;
    const bool within = std::ranges::find(kWithinContour, code.code->group) != kWithinContour.end();
    const bool same_plane = code.code->group == CodeGroup::plane &&
                            words.value_or(CodeGroup::plane, Plane::xy) == state.modes.plane;
    if (!within && !same_plane) return &code;
  }
  return nullptr;
}

Result<double> corner_size(const InterpreterState& state, const BlockWords& words, char letter) {
  const double size = length_of(state, words[letter].value);
  if (size >= 0.0) return size;
  return fail(state, words[letter].column, "value-negative"_id,
              fmt::format("{} is negative", words.text_of(letter)),
              "give a size that is not negative");
}

}  // namespace

Outcome look_for_corner(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  if (state.rules.corner_words.empty()) return Done{};
  // Cycles have parameters under these letters.
  const bool of_cycle = words.has(CodeGroup::drilling_cycle) || words.has(CodeGroup::hole_pattern);
  const bool asked = !of_cycle && !(words.given() & state.rules.corner_words).empty();
  if (!asked && !filters.passes_corners) return Done{};
  if (const GivenCode* end = end_of_contour(state, words);
      filters.passes_corners && end != nullptr) {
    if (filters.corners.corner() && end->code->group == CodeGroup::radius_compensation) {
      return fail(state, end->column, "corner-interrupted"_id,
                  fmt::format("{} between {} and the move after it", end->code->name(),
                              filters.corners.corner()->name),
                  "write the moves of the contour one after the other");
    }
    filters.corners.release(filters.to_radius);
    filters.pass_corners(state, false);
  }
  for (const char letter : {'m', 'l'}) {
    if (!asked || !words.has(letter)) continue;
    const auto size = corner_size(state, words, letter);
    if (!size) return size.error();
    (letter == 'm' ? state.modes.corner.radius : state.modes.corner.feed) = *size;
  }
  const bool waits = filters.corners.corner().has_value();
  const bool wanted = asked || waits || state.modes.corner.radius > 0.0;
  if (!wanted) filters.corners.release(filters.to_radius);
  if (wanted && !filters.passes_corners) {
    filters.corners.begin(state.position.target(),
                          words.value_or(CodeGroup::plane, state.modes.plane));
  }
  if (wanted != filters.passes_corners) filters.pass_corners(state, wanted);
  return Done{};
}

Outcome ask_for_corner(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  if (!filters.passes_corners || state.rules.corner_words.empty() || !state.at_work.moved) {
    return Done{};
  }
  Corner corner{.if_any = true, .feed_of_next = true};
  std::uint32_t column = 1;
  for (const char letter : {'r', 'h', 'i'}) {
    if (!words.has(letter)) continue;
    if (!corner.name.empty()) {
      return fail(state, words[letter].column, "corner-twice"_id,
                  fmt::format("{} beside {}", words.text_of(letter), corner.name),
                  "a corner is rounded or broken: write one of them");
    }
    const auto size = corner_size(state, words, letter);
    if (!size) return size.error();
    corner.name = words.name_of(letter);
    corner.size = *size;
    corner.rounds = letter == 'r';
    corner.across = letter == 'h';
    column = words[letter].column;
  }
  if (corner.name.empty() && state.modes.corner.radius > 0.0) {
    corner.name = "RNDM";
    corner.size = state.modes.corner.radius;
    corner.rounds = true;
  }
  if (!(corner.size > 0.0)) return Done{};
  if (words.has('f') && words['f'].value > 0.0) {
    corner.feed = length_of(state, words['f'].value);
  } else if (state.modes.corner.feed > 0.0) {
    corner.feed = state.modes.corner.feed;
  } else {
    assume(state, column, "corner-feed",
           "a rounding or chamfer has the feed of the move after it (MD20201)");
  }
  corner.place = state.at_work.place_of(column);
  if (auto failure = filters.corners.insert(corner)) return *std::move(failure);
  return Done{};
}

}  // namespace frustum::parser
