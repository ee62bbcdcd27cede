// Lengths and angles without a decimal point, which controls read in two ways: as they are written,
// or in increments of 0.001 mm.
//
// Looked at are programs of Fanuc's kind. Reported is what one of both ways makes wrong: a word
// without a point in a program that writes others with one, and a number of five digits and more.
// Units : as written
// Errors: none
#pragma once

#include <map>
#include <optional>

#include "lint/finding_list.hpp"
#include "parser/dialect.hpp"
#include "parser/interpreter.hpp"

namespace frustum::lint {

class DecimalPoints {
 public:
  explicit DecimalPoints(bool looks) : looks_(looks) {}

  void see(const parser::BlockAhead& ahead);
  // What the interpreter says of a word, whose letter is the first of the text.
  void told(const parser::Event& event, const parser::SourcePlace& place);
  void finish(FindingList& findings) const;

 private:
  struct Bare {
    parser::SourcePlace place{};
    std::string text{};
    std::uint64_t count = 0;
    LineSet lines{};
  };

  static void report(char letter, const Bare& bare, const std::string& what, FindingList& findings);

  bool looks_;
  bool has_points_ = false;
  std::map<char, Bare> bare_{};  // the first of each letter
  std::map<char, Bare> long_{};
  std::map<char, Bare> told_{};
};

}  // namespace frustum::lint
