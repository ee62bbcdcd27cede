// Macro calls of Custom Macro (G65, G66, G67), and the system variables that a program sets.
//
// Arguments: each letter has a parameter of its own. A second I J K, and each further one, goes on at #7, #10, ..; what
// is written later counts. M is an argument, G, L, N, O and P are none.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kArguments = 33;
constexpr int kMaxTriples = 10;
constexpr int kFirstSystemVariable = 1000;

// Of A to Z; 0 where the letter is no argument.
constexpr std::array<int, 26> kParameterOf{1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                           0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

bool is_centre(char letter) { return letter == 'I' || letter == 'J' || letter == 'K'; }

// What a setting of a system variable does.
enum class VariableUse : std::uint8_t { alarm, message, event, clock };
struct SystemVariable {
  int first;
  int last;
  VariableUse use;
};
constexpr std::array kVariables{
    SystemVariable{1000, 1135, VariableUse::event},  // signals to the machine
    SystemVariable{3000, 3000, VariableUse::alarm},
    SystemVariable{3001, 3002, VariableUse::clock},
    SystemVariable{3003, 3005, VariableUse::event},  // single block, feed hold, settings
    SystemVariable{3006, 3006, VariableUse::message},
    SystemVariable{3007, 3007, VariableUse::clock},
    SystemVariable{3011, 3012, VariableUse::clock},
    SystemVariable{3901, 3902, VariableUse::event},  // parts made and to make
};

}  // namespace

// The word of the call: G65 or G66, written as a number.
const Word* BlockExecutor::macro_word(const Block& block) const {
  if (rules_.dialect != Dialect::fanuc) return nullptr;
  for (const Word& word : block.words) {
    if (word.letter != 'G' || !word.expression.empty()) continue;
    if (word.number == 65.0 || word.number == 66.0) return &word;
  }
  return nullptr;
}

Result<Flow> BlockExecutor::call_macro(const Block& block, const Word& code) {
  const std::string name = "G" + decimal_text(code.number);
  const ExpressionContext context{block.steps, block.names, parameters_};
  if (!block.assignments.empty()) {
    return fail(block.assignments.front().column, "macro-beside"_id,
                fmt::format("a setting beside {}", name), "write two blocks");
  }
  CallSubprogram call{0, false, 1, code.column, std::vector<double>(kArguments, kVacant)};
  call.modal = code.number == 66.0;
  const auto count_of = [&](const Word& word, double value, int least, int most) -> Result<int> {
    const double nearest = std::round(value);
    if (std::abs(value - nearest) > 1e-4) {
      return fail(word.column, "not-whole"_id,
                  fmt::format("{}{} is not a whole number", word.letter, decimal_text(value)),
                  fmt::format("give {} without decimals", word.letter));
    }
    if (nearest < least || nearest > most) {
      return fail(word.column, "out-of-range"_id,
                  fmt::format("{}{} is out of range", word.letter, decimal_text(value)),
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
      if (!computed) return in_this_block(computed.error().front());
      value = *computed;
    }
    const char letter = word.letter;
    if (is_vacant(value)) {
      emit(word.column, Event{"vacant", std::string(1, letter)});
      continue;
    }
    if (letter == 'G') {
      return fail(word.column, "macro-beside"_id,
                  fmt::format("G{} beside {}", decimal_text(value), name), "write two blocks");
    }
    if (given.has(letter) && !is_centre(letter)) {
      return fail(word.column, "word-twice"_id, fmt::format("{} is given twice in a block", letter),
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
        return fail(word.column, "macro-argument"_id,
                    fmt::format("{} is no argument of a macro", letter),
                    "arguments are the letters but G, L, N, O and P");
      }
      if (is_centre(letter)) {
        if (last_centre != 0 && letter <= last_centre) ++triple;
        last_centre = letter;
        if (triple >= kMaxTriples) {
          return fail(word.column, "macro-argument"_id, "more than ten I J K of a macro call",
                      "give up to ten of each");
        }
        parameter += 3 * triple;
      }
      call.arguments->at(static_cast<std::size_t>(parameter) - 1) = value;
    }
    given.add(letter);
  }
  if (!named) {
    return fail(code.column, "word-missing"_id, name + " without P",
                fmt::format("name the subprogram, for example {} P2000", name));
  }
  return Flow{std::move(call)};
}

std::vector<double> BlockExecutor::local_values() const {
  std::vector<double> values(kArguments, kVacant);
  for (std::size_t i = 0; i < kArguments; ++i) {
    const auto value = parameters_.read(static_cast<double>(i + 1));
    if (value) values.at(i) = *value;
  }
  return values;
}

// Whether the variable is the control's: what it does is done, and nothing is stored.
Result<bool> BlockExecutor::set_system_variable(std::uint32_t column, int index, double value) {
  if (rules_.dialect != Dialect::fanuc || index < kFirstSystemVariable) return false;
  const auto known =
      std::find_if(kVariables.begin(), kVariables.end(), [index](const SystemVariable& variable) {
        return index >= variable.first && index <= variable.last;
      });
  if (known == kVariables.end()) {
    return fail(column, "not-simulated"_id,
                fmt::format("system variable #{} is not simulated", index),
                "leave the setting out of the simulated program");
  }
  const std::string text = block_->comments.empty() ? std::string{} : block_->comments.front().text;
  const std::string number = is_vacant(value) ? "0" : decimal_text(value);
  switch (known->use) {
    case VariableUse::alarm:
      return fail(
          column, "program-alarm"_id,
          fmt::format("the program raises alarm {}{}{}", number, text.empty() ? "" : ": ", text),
          "it stops itself here; see what it checks before");
    case VariableUse::clock:
      return fail(
          column, "not-simulated"_id, fmt::format("system variable #{} is not simulated", index),
          "the clocks and the panel are the machine's: leave them out of the simulated program");
    case VariableUse::message:
      emit(column, Event{"message", text});
      emit(column, Stop{StopKind::program_stop});
      return true;
    case VariableUse::event:
      emit(column, Event{fmt::format("#{}", index), number});
      return true;
  }
  return true;
}

}  // namespace frustum::parser
