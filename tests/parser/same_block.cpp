#include "tests/parser/same_block.hpp"

#include <algorithm>
#include <string_view>

namespace frustum::parser {
namespace {

class Comparison {
 public:
  Comparison(const Block& a, const Block& b) : a_(a), b_(b) {}

  bool operator()() const {
    return a_.tape_mark == b_.tape_mark && a_.deletable == b_.deletable &&
           a_.delete_switch == b_.delete_switch && a_.number == b_.number &&
           a_.program == b_.program &&
           all(a_.words, b_.words, [this](const Word& a, const Word& b) { return same(a, b); }) &&
           all(a_.assignments, b_.assignments,
               [this](const Assignment& a, const Assignment& b) { return same(a, b); }) &&
           all(a_.pattern, b_.pattern,
               [this](const FramePart& a, const FramePart& b) {
                 return a.name == b.name && a.axes == b.axes &&
                        all(a.values, b.values, [this](ExpressionRange one, ExpressionRange other) {
                          return same(one, other);
                        });
               }) &&
           all(a_.comments, b_.comments,
               [](const Comment& a, const Comment& b) {
                 return a.text == b.text && a.to_line_end == b.to_line_end &&
                        text_of(a.event) == text_of(b.event);
               }) &&
           a_.flow.has_value() == b_.flow.has_value() && (!a_.flow || same(*a_.flow, *b_.flow));
  }

 private:
  template <typename Row, typename Same>
  static bool all(const Row& a, const Row& b, const Same& same) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
  }
  static std::string_view text_of(const char* text) { return text == nullptr ? "" : text; }

  [[nodiscard]] bool same_name(double a, double b) const {
    return a_.names[static_cast<std::size_t>(a)] == b_.names[static_cast<std::size_t>(b)];
  }
  [[nodiscard]] bool same(ExpressionRange a, ExpressionRange b) const {
    if (a.count != b.count) return false;
    for (std::uint32_t i = 0; i < a.count; ++i) {
      const ExpressionStep& left = a_.steps[a.first + i];
      const ExpressionStep& right = b_.steps[b.first + i];
      if (left.operation != right.operation) return false;
      const bool named =
          left.operation == Operation::named_parameter || left.operation == Operation::exists;
      if (named ? !same_name(left.number, right.number) : left.number != right.number) return false;
    }
    return true;
  }
  [[nodiscard]] bool same(const Word& a, const Word& b) const {
    return a.letter == b.letter && a.number == b.number && a.decimal_point == b.decimal_point &&
           a.measure == b.measure && a.source == b.source &&
           text_of(a.spelled) == text_of(b.spelled) && same(a.expression, b.expression);
  }
  [[nodiscard]] bool same(const Assignment& a, const Assignment& b) const {
    if (a.name.has_value() != b.name.has_value()) return false;
    if (a.name && a_.names[*a.name] != b_.names[*b.name]) return false;
    if (a.defines != b.defines) return false;
    return same(a.index, b.index) && same(a.value, b.value);
  }
  [[nodiscard]] bool same(const Choice& a, const Choice& b) const {
    return a.label == b.label && a.search == b.search && same(a.value, b.value);
  }
  [[nodiscard]] bool same(const FormalParameter& a, const FormalParameter& b) const {
    return a_.names[a.name] == b_.names[b.name] && a.kind == b.kind &&
           same(a.otherwise, b.otherwise);
  }
  [[nodiscard]] bool same(const FlowStatement& a, const FlowStatement& b) const {
    const bool stepped = a.kind == FlowKind::loop && a.turns == Turns::stepped;
    return a.kind == b.kind && a.label == b.label && a.block_label == b.block_label &&
           same(a.label_value, b.label_value) && same(a.condition, b.condition) &&
           a.negated == b.negated && a.turns == b.turns && same(a.limit, b.limit) &&
           a.search == b.search && a.last_label == b.last_label &&
           a.may_be_missing == b.may_be_missing && a.part_end == b.part_end &&
           a.keeps_modes == b.keeps_modes && a.of_file == b.of_file && a.by_cycle == b.by_cycle &&
           all(a.choices, b.choices,
               [this](const Choice& x, const Choice& y) { return same(x, y); }) &&
           all(a.parameters, b.parameters,
               [this](const FormalParameter& x, const FormalParameter& y) { return same(x, y); }) &&
           (!stepped || a_.names[a.variable] == b_.names[b.variable]) &&
           all(a.arguments, b.arguments,
               [this](ExpressionRange x, ExpressionRange y) { return same(x, y); });
  }

  const Block& a_;
  const Block& b_;
};

}  // namespace

bool same_block(const Block& a, const Block& b) { return Comparison(a, b)(); }

}  // namespace frustum::parser
