// One block (line) of an NC program as written: words, parameter settings and comments, not yet
// given a meaning.
//
// Every dialect's reader yields these blocks, with the words of its own spelling under the
// canonical letters, so that one interpreter runs them all:
//   A to Z   as ISO programs write them
//   a b c    the tool vector where it has words of its own (A3= B3= C3=, TX TY TZ)
//   d        a tilted plane turns the rotary axes to its normal (0: it does not)
//   m        they turn with the tip of the tool held where it is (MOVE)
//   D L K E H g h  of a deep hole: hole_cycle.hpp
//   r h i m  a rounding, a chamfer by its length or by its width at the corner, roundings from here
//   f l      on (RND= CHF= CHR= RNDM=), and their feeds (FRC= FRCM=)
//   l i      the length or the angle of a way on to a contour (LEN, CCA)
//   t        the duration of the block in seconds (FT)
//   e        full turns of an arc beyond the first (TURN=)
//   p q      radius and angle of a polar position (@ ^, PR PA)
//   s        a tilted plane goes on within the last one
//   k        an arc goes on in the direction of the move before it (CT)
//   u v w    a second shift of a tilted plane, along its own axes; the axis of an arc in space;
//            a control point of a cubic in space
//   x y      a chamfer or a rounding between the move of the block and the next one (,C ,R)
//   f r      the feed of a hole cycle, per minute and per revolution
//   @        a word without a number (TRAORI, TOOL CALL): `number` is its row in the code table
// Units: as written. Columns count bytes from 1. Comments are UTF-8 (Latin-1 text is converted).
// Errors: none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parser/language/expression.hpp"
#include "parser/language/flow.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// How the value of an axis or centre word counts.
enum class Measure : std::uint8_t {
  modal,        // as G90 or G91 says
  absolute,     // AC()
  incremental,  // IC(), IX
  shortest,     // DC(): absolute, by the shorter way round
  positive,     // ACP(): absolute, in the positive direction
  negative      // ACN()
};

// Where a value comes from when it is no number: Q206=AUTO, Q208=MAX.
enum class ValueSource : std::uint8_t { number, tool_call, fastest };

constexpr char kNamedWord = '@';
constexpr char kPolarRadius = 'p';
constexpr char kPolarAngle = 'q';
constexpr char kTangential = 'k';
constexpr char kSwivelOnTop = 's';
constexpr char kCornerChamfer = 'x';
constexpr char kCornerRadius = 'y';

// A letter and its value: a plain number (the fast, common case) or an expression.
struct Word {
  char letter = 0;
  bool decimal_point = false;  // the number was written with one, which G4 P looks at
  std::uint32_t column = 0;
  double number = 0.0;
  ExpressionRange expression{};  // empty when the value is `number`
  Measure measure = Measure::modal;
  const char* spelled = nullptr;  // "A3=" where the dialect's spelling is not the letter
  ValueSource source = ValueSource::number;
};

// CTRANS(X,10,Y,20): a part of a frame. POS1 (X+10 Y+20): an element of a pattern of points.
struct FramePart {
  std::string name{};
  std::string axes{};  // of a pattern the letters of point_pattern.hpp
  std::vector<ExpressionRange> values{};
};

// #1=2, #<depth>=[#1*2]. A name represents itself, a number is computed by `index`. A name with
// indices is that of an element, or of an array where it is defined.
struct Assignment {
  std::uint32_t column = 0;
  std::optional<std::uint32_t> name{};  // index into Block::names
  ExpressionRange index{};
  ExpressionRange value{};
  std::optional<VariableKind> defines{};  // DEF REAL LENGTH=5: a variable of the subprogram
  std::vector<ExpressionRange> indices{};
  std::vector<ExpressionRange> more{};  // A[0]=SET(1,2,3): the values after the first
  bool fills = false;                   // A[0]=REP(1): all from there on
  std::vector<FramePart> frame{};       // $P_PFRAME=CTRANS(X,10):CROT(Z,30)
};

struct Comment {
  std::uint32_t column = 0;
  bool to_line_end = false;  // written with ; instead of ( )
  std::string text{};
  // The statement that this is the text of, when it is known but not simulated: "BLK FORM".
  const char* event = nullptr;
  bool of_builder = false;  // a word whose meaning is the builder's of the machine
  bool assumed = false;     // not written: what the reader had to choose
};

struct Block {
  std::uint32_t line = 0;                  // 1-based line of the file
  bool tape_mark = false;                  // %
  bool deletable = false;                  // begins with /
  std::uint8_t delete_switch = 0;          // 1 to 9 for /1 to /9, 0 without a number
  std::optional<std::uint32_t> number{};   // N word
  std::optional<std::uint32_t> program{};  // O word
  std::uint32_t program_column = 0;
  std::vector<Word> words{};
  std::vector<Assignment> assignments{};
  std::vector<Comment> comments{};
  std::vector<FramePart> pattern{};  // PATTERN DEF
  std::optional<FlowStatement> flow{};
  std::vector<ExpressionStep> steps{};
  std::vector<std::string> names{};
  // Where the lines after the first begin, counted in bytes, when the block goes over several.
  std::vector<std::uint32_t> line_starts{};

  [[nodiscard]] bool empty() const {
    return !tape_mark && !number && !program && words.empty() && assignments.empty() &&
           comments.empty() && !flow;
  }
  // Line and column of a byte of the block, counted from 1 over all its lines.
  [[nodiscard]] SourcePlace place_of(std::uint32_t column) const {
    SourcePlace place{.line = line, .column = column};
    for (const std::uint32_t start : line_starts) {
      if (column <= start) break;
      ++place.line;
      place.column = column - start;
    }
    return place;
  }
};

}  // namespace frustum::parser
