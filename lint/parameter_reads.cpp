#include "lint/parameter_reads.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "parser/dialects/dialect_rules.hpp"

namespace frustum::lint {
namespace {

using parser::Block;
using parser::Operation;

// The first number that outlasts a program, or is the controller's.
int first_kept(parser::Dialect dialect) {
  switch (dialect) {
    case parser::Dialect::fanuc:
      return 500;
    case parser::Dialect::linuxcnc:
      return 5000;
    default:
      return 0;  // R and Q parameters keep their values
  }
}

std::optional<int> whole_number(double value) {
  if (!(std::abs(value) < 1e6) || value != std::floor(value)) return std::nullopt;
  return static_cast<int>(value);
}

// The number of the parameter that step `i` reads, where it is written as a number.
std::optional<int> number_read(const Block& block, std::size_t i) {
  if (block.steps[i].operation != Operation::parameter || i == 0) return std::nullopt;
  const parser::ExpressionStep& number = block.steps[i - 1];
  if (number.operation != Operation::number) return std::nullopt;
  return whole_number(number.number);
}

}  // namespace

ParameterReads::ParameterReads(parser::Dialect dialect)
    : dialect_(dialect), locals_(parser::rules_of(dialect).parameters.locals) {}

bool ParameterReads::looks_at(int number, std::size_t calls) const {
  if (number <= 0 || number >= first_kept(dialect_)) return false;
  return (number > locals_ || calls == 0) && !set_.contains(number);
}

void ParameterReads::see(const parser::BlockAhead& ahead, FindingList& findings) {
  const Block& block = ahead.block;
  if (block.steps.empty() || any_may_be_set_) return;
  bool asks_whether_set = false;
  for (std::size_t i = 0; i < block.steps.size(); ++i) {
    asks_whether_set = asks_whether_set || number_read(block, i) == 0;
  }
  for (std::size_t i = 0; i < block.steps.size() && !asks_whether_set; ++i) {
    const auto number = number_read(block, i);
    if (!number || !looks_at(*number, ahead.calls) || !told_.insert(*number).second) continue;
    parser::SourcePlace place = block.place_of(block.steps[i].column);
    place.file = ahead.file;
    findings.raise(Check::parameter_unset, static_cast<FindingList::Key>(*number), place, [&] {
      return Words{.message = fmt::format("#{} is read before the program sets it", *number),
                   .hint = dialect_ == parser::Dialect::linuxcnc ? "it counts as 0; set it before"
                                                                 : "it is vacant; set it before",
                   .alike = fmt::format("#{}", *number)};
    });
  }
  for (const parser::Assignment& setting : block.assignments) {
    if (setting.name) continue;
    const auto number =
        setting.index.count == 1 && block.steps[setting.index.first].operation == Operation::number
            ? whole_number(block.steps[setting.index.first].number)
            : std::nullopt;
    if (!number) {
      any_may_be_set_ = true;
    } else {
      // A subprogram called by M98 sets the caller's own.
      set_.insert(*number);
    }
  }
}

}  // namespace frustum::lint
