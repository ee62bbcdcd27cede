#include "tests/parser/random_program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/random.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kLetters = "ABCDEFGHIJKLMPQRSTUVWXYZ";
// What the dialects compute alike, and what each has of its own.
constexpr std::array kOneOperand{
    Operation::negate,   Operation::sine,        Operation::cosine,    Operation::tangent,
    Operation::arc_sine, Operation::arc_cosine,  Operation::absolute,  Operation::square_root,
    Operation::round,    Operation::exponential, Operation::logarithm, Operation::parameter};
constexpr std::array kTwoOperands{
    Operation::add,   Operation::subtract,         Operation::multiply, Operation::divide,
    Operation::power, Operation::arc_tangent,      Operation::equal,    Operation::not_equal,
    Operation::less,  Operation::greater_or_equal, Operation::greater,  Operation::less_or_equal};
constexpr std::array kMacroOneOperand{Operation::truncate, Operation::round_away,
                                      Operation::from_bcd, Operation::to_bcd, Operation::as_it_is};
constexpr std::array kMacroTwoOperands{Operation::remainder, Operation::bit_and, Operation::bit_or,
                                       Operation::bit_xor};
constexpr std::array kRs274OneOperand{Operation::fix, Operation::fup};
constexpr std::array kRs274TwoOperands{Operation::modulo, Operation::logical_and,
                                       Operation::logical_or, Operation::logical_xor};

template <std::size_t N, std::size_t M>
Operation any(Dice& dice, const std::array<Operation, N>& common,
              const std::array<Operation, M>& own) {
  const std::size_t choice = dice.below(N + M);
  return choice < N ? common.at(choice) : own.at(choice - N);
}
Operation one_operand(Dice& dice, Dialect dialect) {
  if (dialect != Dialect::fanuc) return any(dice, kOneOperand, kRs274OneOperand);
  const Operation operation = any(dice, kOneOperand, kMacroOneOperand);
  return operation == Operation::arc_sine ? Operation::arc_sine_from_zero : operation;
}
Operation two_operands(Dice& dice, Dialect dialect) {
  if (dialect != Dialect::fanuc) return any(dice, kTwoOperands, kRs274TwoOperands);
  const Operation operation = any(dice, kTwoOperands, kMacroTwoOperands);
  return operation == Operation::arc_tangent ? Operation::arc_tangent_from_zero : operation;
}

void push_expression(Dice& dice, Block& block, Dialect dialect, int depth) {
  const double leaf = depth == 0 ? 1.0 : 0.3;
  if (dice.chance(leaf)) {
    if (dice.chance(0.2)) {
      const std::array<std::string, 4> names{"a", "depth", "_x1", "tool-length"};
      block.names.push_back(names.at(dice.below(names.size())));
      block.steps.push_back({dice.chance(0.2) ? Operation::exists : Operation::named_parameter, 0,
                             static_cast<double>(block.names.size() - 1)});
    } else {
      block.steps.push_back({Operation::number, 0, dice.number()});
    }
    return;
  }
  push_expression(dice, block, dialect, depth - 1);
  if (dice.chance(0.5)) {
    block.steps.push_back({one_operand(dice, dialect), 0, 0.0});
  } else {
    push_expression(dice, block, dialect, depth - 1);
    block.steps.push_back({two_operands(dice, dialect), 0, 0.0});
  }
}

ExpressionRange add_expression(Dice& dice, Block& block, Dialect dialect) {
  const auto first = static_cast<std::uint32_t>(block.steps.size());
  push_expression(dice, block, dialect, 3);
  return {first, static_cast<std::uint32_t>(block.steps.size()) - first};
}

Word random_word(Dice& dice, Block& block, Dialect dialect) {
  Word word;
  word.letter = kLetters[dice.below(kLetters.size())];
  if (dialect == Dialect::fanuc && dice.chance(0.05)) {
    const bool rounds = dice.chance(0.5);
    word.letter = rounds ? kCornerRadius : kCornerChamfer;
    word.spelled = rounds ? ",R" : ",C";
  }
  if (dice.chance(0.7)) {
    word.number = dice.number();
    word.decimal_point = word.number != std::floor(word.number) || dice.chance(0.3);
    return word;
  }
  word.expression = add_expression(dice, block, dialect);
  // A number by itself is no expression.
  if (word.expression.count == 1 && block.steps.back().operation == Operation::number) {
    word.number = block.steps.back().number;
    word.decimal_point = word.number != std::floor(word.number);
    word.expression = {};
    block.steps.pop_back();
  }
  return word;
}

Assignment random_setting(Dice& dice, Block& block, Dialect dialect) {
  Assignment setting;
  if (dice.chance(0.3)) {
    block.names.emplace_back("width");
    setting.name = static_cast<std::uint32_t>(block.names.size() - 1);
  } else {
    setting.index = add_expression(dice, block, dialect);
  }
  setting.value = add_expression(dice, block, dialect);
  return setting;
}

Comment random_comment(Dice& dice, bool to_line_end, Dialect dialect) {
  constexpr std::array<std::string_view, 7> kParts{" ", "tool", "10 mm", "#1=2", "Fr\xC3\xA4ser",
                                                   "%", "N5"};
  Comment comment;
  comment.to_line_end = to_line_end;
  for (std::size_t i = dice.below(4); i > 0; --i)
    comment.text += kParts.at(dice.below(kParts.size()));
  if (to_line_end && dice.chance(0.5)) comment.text += "(not closed";
  if (!to_line_end && dialect == Dialect::fanuc && dice.chance(0.2)) comment.text += "(of (two))";
  return comment;
}

Block random_block(Dice& dice, std::uint32_t line, Dialect dialect) {
  Block block;
  block.line = line;
  if (dice.chance(0.02)) {
    block.tape_mark = true;
    if (dialect == Dialect::fanuc && dice.chance(0.5)) {
      block.comments.push_back({0, false, std::to_string(dice.below(1000)), "%"});
    }
  } else {
    block.deletable = dice.chance(0.1);
    if (dice.chance(0.4)) block.number = static_cast<std::uint32_t>(dice.below(100'000'000));
    // Program numbers must not repeat, so they follow the lines.
    if (dice.chance(0.05)) block.program = line;
    for (std::size_t i = dice.below(7); i > 0; --i)
      block.words.push_back(random_word(dice, block, dialect));
    for (std::size_t i = dice.below(3); i > 0; --i) {
      block.assignments.push_back(random_setting(dice, block, dialect));
    }
  }
  while (dice.chance(0.2)) block.comments.push_back(random_comment(dice, false, dialect));
  if (dice.chance(0.1)) block.comments.push_back(random_comment(dice, true, dialect));
  return block;
}

}  // namespace

double Dice::next() { return uniform({seed_, 0, RandomPurpose::test_data}, index_++); }

std::size_t Dice::below(std::size_t end) {
  return std::min(static_cast<std::size_t>(next() * static_cast<double>(end)), end - 1);
}

bool Dice::chance(double probability) { return next() < probability; }

double Dice::number() {
  const double sign = chance(0.4) ? -1.0 : 1.0;
  const double kind = next();
  double value = next();
  if (kind < 0.3) {
    value = std::floor(value * 1000);
  } else if (kind < 0.7) {
    value = std::round(value * 1e6) / 1e3;
  } else if (kind < 0.9) {
    value *= 100;
  } else {
    value = std::ldexp(value, static_cast<int>(below(600)) - 300);
  }
  return sign * value + 0.0;
}

std::vector<Block> random_blocks(std::uint64_t seed, Dialect dialect) {
  Dice dice(seed);
  std::vector<Block> blocks;
  std::uint32_t line = 0;
  for (std::size_t i = dice.below(12); i > 0; --i) {
    Block block = random_block(dice, ++line, dialect);
    if (!block.empty()) blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace frustum::parser
