#include "parser/interpret/macro_call.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/decimal.hpp"
#include "parser/interpret/block_flow.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kArguments = 33;

constexpr int kMaxTriples = 10;

// Of A to Z; 0 where the letter is no argument.
constexpr std::array<int, 26> kParameterOf{1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                           0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

bool is_centre(char letter) { return letter == 'I' || letter == 'J' || letter == 'K'; }

}  // namespace

const Word* macro_word(const InterpreterState& state, const Block& block) {
  if (state.rules.dialect != Dialect::fanuc) return nullptr;
  for (const Word& word : block.words) {
    if (word.letter != 'G' || !word.expression.empty()) continue;
    if (word.number == 65.0 || word.number == 66.0) return &word;
  }
  return nullptr;
}

Result<Flow> call_macro(InterpreterState& state, const Block& block, const Word& code) {
  const std::string name = "G" + shortest_decimal(code.number);
  const ExpressionContext context{block.steps, block.names, state.parameters};
  if (!block.assignments.empty()) {
    return fail(state, block.assignments.front().column, "macro-beside"_id,
                fmt::format("a setting beside {}", name), "write two blocks");
  }
  CallSubprogram call{0, false, 1, code.column, std::vector<double>(kArguments, kVacant)};
  call.modal = code.number == 66.0;
  const auto count_of = [&](const Word& word, double value, int least, int most) -> Result<int> {
    const double nearest = std::round(value);
    if (std::abs(value - nearest) > 1e-4) {
      return fail(state, word.column, "not-whole"_id,
                  fmt::format("{}{} is not a whole number", word.letter, shortest_decimal(value)),
                  fmt::format("give {} without decimals", word.letter));
    }
    if (nearest < least || nearest > most) {
      return fail(state, word.column, "out-of-range"_id,
                  fmt::format("{}{} is out of range", word.letter, shortest_decimal(value)),
                  fmt::format("{} goes from {} to {}", word.letter, least, most));
    }
    return static_cast<int>(nearest);
  };
  LetterSet given;
  bool named = false;
  int triple = 0;
  char last_centre = 0;
  for (const Word& word : block.words) {
    if (&word == &code) continue;
    double value = word.number;
    if (!word.expression.empty()) {
      const auto computed = evaluate(context, word.expression);
      if (!computed) return in_this_block(state, computed.error().front());
      value = *computed;
    }
    const char letter = word.letter;
    if (is_vacant(value)) {
      emit(state, word.column, Event{"vacant", std::string(1, letter)});
      continue;
    }
    if (letter == 'G') {
      return fail(state, word.column, "macro-beside"_id,
                  fmt::format("G{} beside {}", shortest_decimal(value), name), "write two blocks");
    }
    if (given.has(letter) && !is_centre(letter)) {
      return fail(state, word.column, "word-twice"_id,
                  fmt::format("{} is given twice in a block", letter),
                  "leave one of them out, or write two blocks");
    }
    if (letter == 'P') {
      const auto program = count_of(word, value, 1, kMaxProgramNumber);
      if (!program) return program.error();
      call.program = static_cast<std::uint32_t>(*program);
      call.column = word.column;
      named = true;
    } else if (letter == 'L') {
      const auto count = count_of(word, value, 0, kMaxRepeats);
      if (!count) return count.error();
      call.counted = true;
      call.count = static_cast<std::uint32_t>(*count);
    } else {
      int parameter = letter >= 'A' && letter <= 'Z'
                          ? kParameterOf.at(static_cast<std::size_t>(letter - 'A'))
                          : 0;
      if (parameter == 0) {
        return fail(state, word.column, "macro-argument"_id,
                    fmt::format("{} is no argument of a macro", letter),
                    "arguments are the letters but G, L, N, O and P");
      }
      if (is_centre(letter)) {
        if (last_centre != 0 && letter <= last_centre) ++triple;
        last_centre = letter;
        if (triple >= kMaxTriples) {
          return fail(state, word.column, "macro-argument"_id,
                      "more than ten I J K of a macro call", "give up to ten of each");
        }
        parameter += 3 * triple;
      }
      call.arguments->at(static_cast<std::size_t>(parameter) - 1) = value;
    }
    given.add(letter);
  }
  if (!named) {
    return fail(state, code.column, "word-missing"_id, name + " without P",
                fmt::format("name the subprogram, for example {} P2000", name));
  }
  return Flow{std::move(call)};
}

std::vector<double> local_values(const InterpreterState& state) {
  std::vector<double> values(kArguments, kVacant);
  for (std::size_t i = 0; i < kArguments; ++i) {
    const auto value = state.parameters.read(static_cast<double>(i + 1));
    if (value) values.at(i) = *value;
  }
  return values;
}

}  // namespace frustum::parser
