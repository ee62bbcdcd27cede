// One block (line) of an NC program as written: words, parameter settings and comments, not yet
// given a meaning.
//
// Units: as written. Columns count bytes from 1. Comments are UTF-8 (Latin-1 text is converted).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parser/expression.hpp"

namespace frustum::parser {

// A letter and its value: a plain number (the fast, common case) or an expression.
struct Word {
  char letter = 0;             // upper case
  bool decimal_point = false;  // the number was written with one, which G4 P looks at
  std::uint32_t column = 0;
  double number = 0.0;
  ExpressionRange expression{};  // empty when the value is `number`
};

// #1=2, #<depth>=[#1*2]. A name stands for itself, a number is computed by `index`.
struct Assignment {
  std::uint32_t column = 0;
  std::optional<std::uint32_t> name{};  // index into Block::names
  ExpressionRange index{};
  ExpressionRange value{};
};

struct Comment {
  std::uint32_t column = 0;
  bool to_line_end = false;  // written with ; instead of ( )
  std::string text{};
};

struct Block {
  std::uint32_t line = 0;                  // 1-based line of the file
  bool tape_mark = false;                  // %
  bool deletable = false;                  // begins with /
  std::optional<std::uint32_t> number{};   // N word
  std::optional<std::uint32_t> program{};  // O word
  std::uint32_t program_column = 0;
  std::vector<Word> words{};
  std::vector<Assignment> assignments{};
  std::vector<Comment> comments{};
  std::vector<ExpressionStep> steps{};
  std::vector<std::string> names{};

  [[nodiscard]] bool empty() const {
    return !tape_mark && !number && !program && words.empty() && assignments.empty() &&
           comments.empty();
  }
};

}  // namespace frustum::parser
