// Parameters that the program reads before it has set them, in the order in which its blocks run.
//
// Looked at are numbers that are written as such and keep nothing from before: those of subprograms
// only in the main program (a call may have brought them), neither the controller's own nor the
// ones that outlast a program. A block that compares with #0 asks whether a parameter is set, and
// may. A number that is computed could be any: from then on nothing is reported.
//
// Units : none
// Errors: none
#pragma once

#include <set>

#include "lint/finding_list.hpp"
#include "parser/dialect.hpp"
#include "parser/interpreter.hpp"

namespace frustum::lint {

class ParameterReads {
 public:
  explicit ParameterReads(parser::Dialect dialect);
  // Before the block runs.
  void see(const parser::BlockAhead& ahead, FindingList& findings);

 private:
  [[nodiscard]] bool looks_at(int number, std::size_t calls) const;

  parser::Dialect dialect_;
  int locals_;
  std::set<int> set_{};
  std::set<int> told_{};
  bool any_may_be_set_ = false;
};

}  // namespace frustum::lint
