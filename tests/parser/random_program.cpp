#include "tests/parser/random_program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/random.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kLetters = "ABCDEFGHIJKLMPQRSTUVWXYZ";
constexpr std::array kOneOperand{
    Operation::negate,   Operation::sine,       Operation::cosine,      Operation::tangent,
    Operation::arc_sine, Operation::arc_cosine, Operation::square_root, Operation::absolute,
    Operation::round,    Operation::truncate,   Operation::round_away,  Operation::from_bcd,
    Operation::to_bcd,   Operation::as_it_is,   Operation::logarithm,   Operation::exponential,
    Operation::parameter};
constexpr std::array kTwoOperands{Operation::add,     Operation::subtract,   Operation::multiply,
                                  Operation::divide,  Operation::power,      Operation::remainder,
                                  Operation::bit_and, Operation::bit_or,     Operation::bit_xor,
                                  Operation::less,    Operation::arc_tangent};

void push_expression(Dice& dice, Block& block, int depth) {
  const double leaf = depth == 0 ? 1.0 : 0.3;
  if (dice.chance(leaf)) {
    if (dice.chance(0.2)) {
      const std::array<std::string, 4> names{"a", "depth", "_x1", "tool-length"};
      block.names.push_back(names.at(dice.below(names.size())));
      block.steps.push_back(
          {Operation::named_parameter, 0, static_cast<double>(block.names.size() - 1)});
    } else {
      block.steps.push_back({Operation::number, 0, dice.number()});
    }
    return;
  }
  push_expression(dice, block, depth - 1);
  if (dice.chance(0.5)) {
    block.steps.push_back({kOneOperand.at(dice.below(kOneOperand.size())), 0, 0.0});
  } else {
    push_expression(dice, block, depth - 1);
    block.steps.push_back({kTwoOperands.at(dice.below(kTwoOperands.size())), 0, 0.0});
  }
}

ExpressionRange add_expression(Dice& dice, Block& block) {
  const auto first = static_cast<std::uint32_t>(block.steps.size());
  push_expression(dice, block, 3);
  return {first, static_cast<std::uint32_t>(block.steps.size()) - first};
}

Word random_word(Dice& dice, Block& block) {
  Word word;
  word.letter = kLetters[dice.below(kLetters.size())];
  if (dice.chance(0.7)) {
    word.number = dice.number();
    word.decimal_point = word.number != std::floor(word.number) || dice.chance(0.3);
    return word;
  }
  word.expression = add_expression(dice, block);
  // A number by itself is no expression.
  if (word.expression.count == 1 && block.steps.back().operation == Operation::number) {
    word.number = block.steps.back().number;
    word.decimal_point = word.number != std::floor(word.number);
    word.expression = {};
    block.steps.pop_back();
  }
  return word;
}

Assignment random_setting(Dice& dice, Block& block) {
  Assignment setting;
  if (dice.chance(0.3)) {
    block.names.emplace_back("width");
    setting.name = static_cast<std::uint32_t>(block.names.size() - 1);
  } else {
    setting.index = add_expression(dice, block);
  }
  setting.value = add_expression(dice, block);
  return setting;
}

Comment random_comment(Dice& dice, bool to_line_end) {
  constexpr std::array<std::string_view, 7> kParts{" ", "tool", "10 mm", "#1=2", "Fr\xC3\xA4ser",
                                                   "%", "N5"};
  Comment comment;
  comment.to_line_end = to_line_end;
  for (std::size_t i = dice.below(4); i > 0; --i)
    comment.text += kParts.at(dice.below(kParts.size()));
  if (to_line_end && dice.chance(0.5)) comment.text += "(not closed";
  return comment;
}

Block random_block(Dice& dice, std::uint32_t line) {
  Block block;
  block.line = line;
  if (dice.chance(0.02)) {
    block.tape_mark = true;
  } else {
    block.deletable = dice.chance(0.1);
    if (dice.chance(0.4)) block.number = static_cast<std::uint32_t>(dice.below(100'000'000));
    // Program numbers must not repeat, so they follow the lines.
    if (dice.chance(0.05)) block.program = line;
    for (std::size_t i = dice.below(7); i > 0; --i) block.words.push_back(random_word(dice, block));
    for (std::size_t i = dice.below(3); i > 0; --i) {
      block.assignments.push_back(random_setting(dice, block));
    }
  }
  while (dice.chance(0.2)) block.comments.push_back(random_comment(dice, false));
  if (dice.chance(0.1)) block.comments.push_back(random_comment(dice, true));
  return block;
}

bool same_range(const Block& a, ExpressionRange in_a, const Block& b, ExpressionRange in_b) {
  if (in_a.count != in_b.count) return false;
  for (std::uint32_t i = 0; i < in_a.count; ++i) {
    const ExpressionStep& left = a.steps[in_a.first + i];
    const ExpressionStep& right = b.steps[in_b.first + i];
    if (left.operation != right.operation) return false;
    const bool same = left.operation == Operation::named_parameter
                          ? a.names[static_cast<std::size_t>(left.number)] ==
                                b.names[static_cast<std::size_t>(right.number)]
                          : left.number == right.number;
    if (!same) return false;
  }
  return true;
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

std::vector<Block> random_blocks(std::uint64_t seed) {
  Dice dice(seed);
  std::vector<Block> blocks;
  std::uint32_t line = 0;
  for (std::size_t i = dice.below(12); i > 0; --i) {
    Block block = random_block(dice, ++line);
    if (!block.empty()) blocks.push_back(std::move(block));
  }
  return blocks;
}

bool same_block(const Block& a, const Block& b) {
  const auto same_word = [&](const Word& left, const Word& right) {
    return left.letter == right.letter && left.number == right.number &&
           left.decimal_point == right.decimal_point &&
           same_range(a, left.expression, b, right.expression);
  };
  const auto same_setting = [&](const Assignment& left, const Assignment& right) {
    if (left.name.has_value() != right.name.has_value()) return false;
    if (left.name && a.names[*left.name] != b.names[*right.name]) return false;
    return same_range(a, left.index, b, right.index) && same_range(a, left.value, b, right.value);
  };
  const auto same_comment = [](const Comment& left, const Comment& right) {
    return left.text == right.text && left.to_line_end == right.to_line_end;
  };
  return a.tape_mark == b.tape_mark && a.deletable == b.deletable && a.number == b.number &&
         a.program == b.program &&
         std::equal(a.words.begin(), a.words.end(), b.words.begin(), b.words.end(), same_word) &&
         std::equal(a.assignments.begin(), a.assignments.end(), b.assignments.begin(),
                    b.assignments.end(), same_setting) &&
         std::equal(a.comments.begin(), a.comments.end(), b.comments.begin(), b.comments.end(),
                    same_comment);
}

}  // namespace frustum::parser
