// What a block says about which block comes next: loops, branches, subprograms, jumps.
//
// The dialects spell these in their own ways and mean the same few things, so that one interpreter
// runs them all. A statement stands alone in its block, beside comments; words may follow a label
// and only_if, and a label may be before another statement.
//
//   kind          RS-274             Custom Macro        Sinumerik            Klartext
//   branch        o1 if [c]                              IF c
//   else_branch   o1 elseif [c]
//   otherwise     o1 else                                ELSE
//   end_branch    o1 endif                               ENDIF
//   loop          o1 while [c], do,  WHILE [c] DO1       WHILE c, LOOP,
//                 repeat [n]                             FOR R1=a TO b, REPEAT
//   end_loop      o1 endwhile,       END1                ENDWHILE, ENDLOOP,
//                 while [c],                             ENDFOR, UNTIL c
//                 endrepeat
//   leave_loop    o1 break
//   next_turn     o1 continue
//   subprogram    o1 sub
//   program                                              %_N_NAME_SPF, PROC
//   end_sub       o1 endsub [v]                          RET                  LBL 0
//   give_back     o1 return [v]                          RET
//   call          o1 call [a] ..                         NAME, NAME P3        CALL LBL 1, CALL PGM
//   label                                                NAME:                LBL 1
//   jump                             GOTO n, IF [c] ..   GOTOF NAME           FN 9: .. GOTO LBL 1
//   choice                                               CASE R1 OF 1 GOTOF A
//   only_if                          IF [c] THEN #1=2
//   repeat_part                                          REPEAT A B P=3       CALL LBL 1 REP 3
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "parser/language/expression.hpp"
#include "parser/language/variable_kind.hpp"

namespace frustum::parser {

enum class FlowKind : std::uint8_t {
  branch,
  else_branch,
  otherwise,
  end_branch,
  loop,
  end_loop,
  leave_loop,
  next_turn,
  subprogram,
  end_sub,
  give_back,
  call,
  label,
  jump,
  program,  // what follows is a program of that name, up to the next one
  choice,   // a jump for each value
  only_if,  // the settings and words of its block count when the condition holds
  repeat_part,
};

// When a loop goes round (again).
enum class Turns : std::uint8_t {
  while_true,  // `condition` before each turn
  until_end,   // the end of the loop has the condition, or says without one to go round for ever
  counted,     // `condition` is the number of turns
  stepped      // `variable` from the value of `condition` to that of `limit`, by 1
};

// Where a jump looks for its label.
enum class Search : std::uint8_t { forward, backward, forward_then_backward, from_start };

// How far a repeated part goes.
enum class PartEnd : std::uint8_t {
  here,       // up to the statement
  last,       // with the block of the last label, or of the first when there is none
  end_label,  // up to ENDLABEL, where there is one, else as `here`
};

// One of the values of a choice; without a value, what holds for all others.
struct Choice {
  ExpressionRange value{};
  std::string label{};
  Search search = Search::from_start;
};

// What a program is called with.
struct FormalParameter {
  std::uint32_t name = 0;  // index into Block::names
  VariableKind kind = VariableKind::real;
  ExpressionRange otherwise{};  // what it is when the call gives none; 0 without
  bool gives_back = false;      // VAR: a variable of the call has its value afterwards
  // Of an array, one a dimension; an empty one takes any size.
  std::vector<ExpressionRange> sizes{};
};

struct FlowStatement {
  FlowKind kind = FlowKind::label;
  std::uint32_t column = 0;
  // Links the parts of a statement, and names subprograms and jump targets: "100", "pocket", "N20".
  // Empty where the dialect has none. A computed one is in `label_value`, with `label` as its
  // prefix.
  std::string label{};
  // Of the block itself, before the statement: DONE: L1.
  std::string block_label{};
  std::uint32_t block_label_column = 0;
  ExpressionRange label_value{};
  ExpressionRange condition{};
  bool negated = false;  // UNTIL
  Turns turns = Turns::while_true;
  ExpressionRange limit{};
  std::uint32_t variable = 0;  // index into Block::names
  Search search = Search::from_start;
  bool may_be_missing = false;               // a jump that goes on when there is no such label
  std::vector<ExpressionRange> arguments{};  // of a call; empty where one is left out
  std::vector<FormalParameter> parameters{};
  bool keeps_modes = false;  // of a program: its caller's modes come back
  std::vector<Choice> choices{};
  std::string last_label{};  // of a repeated part
  PartEnd part_end = PartEnd::here;
  bool of_file = false;   // a call names a whole program, which has a file of its own (CALL PGM)
  bool by_cycle = false;  // and is made later, where a cycle is called (CYCL DEF 12)
};

}  // namespace frustum::parser
