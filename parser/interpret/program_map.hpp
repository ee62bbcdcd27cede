// Where the flow statements, labels and numbered programs of a program are and which belong
// together, so that a jump need not read what it passes over. Made when the first one is looked
// for: most programs have none.
//
// Units : places of program_text.hpp
// Shape : one read of the whole text
// Errors: faults(): an end without its beginning, a beginning without its end, else after else,
//         break outside a loop, a subprogram within another or of the same name, a label that is
//         there twice (but of Sinumerik). Blocks with a syntax error are passed over; they are
//         reported when they are run
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parser/language/flow.hpp"
#include "parser/program.hpp"

namespace frustum::parser {

struct Landmark {
  TextPlace place{};   // of its block
  TextPlace behind{};  // of what follows
  FlowKind kind = FlowKind::label;
  Turns turns = Turns::while_true;
  std::uint32_t column = 0;
  std::string label{};
  std::size_t program = 0;  // of the file, that of the first header is 1
  // Indices of what belongs to it: the beginning of its statement (of a loop, for break and
  // continue), the next part of it, and its end.
  std::size_t begin = 0;
  std::size_t next = 0;
  std::size_t end = 0;
  // How many blocks before it have words or settings, and whether it is a jump behind a condition.
  std::size_t work_before = 0;
  bool jumps_if = false;
  // Of those that are wrong: of its program's faults.
  std::optional<std::size_t> fault{};
};

class ProgramMap {
 public:
  explicit ProgramMap(const Program& program);

  [[nodiscard]] const Diagnostics& faults() const { return faults_; }
  // What keeps a statement from being run: its own fault, or where `any` the first of the program.
  [[nodiscard]] const Diagnostic* fault_of(const Landmark& landmark, bool any) const;
  // In the order of the text.
  [[nodiscard]] const Landmark& operator[](std::size_t index) const { return landmarks_[index]; }
  // The one whose block is at `place`, which must be one.
  [[nodiscard]] const Landmark& at(TextPlace place) const;
  // The subprogram or label of that name; null when there is none.
  [[nodiscard]] const Landmark* target(std::string_view label) const;
  // The same, a label being one of the program that `from` is in: of those that are there twice the
  // nearest one that `search` comes to.
  [[nodiscard]] const Landmark* target(std::string_view label, TextPlace from, Search search) const;
  [[nodiscard]] bool is_there_twice(std::string_view label, TextPlace from) const;
  // What begins the program of that name within the file; null when there is none.
  [[nodiscard]] const Landmark* head(std::string_view name) const;
  // The first ENDLABEL between two places of a program; null when there is none.
  [[nodiscard]] const Landmark* end_label(TextPlace from, std::uint64_t to) const;
  // The program that O and a number begin.
  struct Numbered {
    TextPlace place{};
    std::uint32_t column = 0;
  };
  [[nodiscard]] const std::map<std::uint32_t, Numbered>& programs() const { return programs_; }

 private:
  void pair(const Program& program);
  [[nodiscard]] bool ends_a_jump(std::size_t index) const;
  void add_fault(const Program& program, Landmark& landmark, DiagnosticId id, std::string message,
                 std::string hint);

  std::vector<Landmark> landmarks_{};
  [[nodiscard]] std::size_t program_at(TextPlace place) const;

  std::map<std::string, std::size_t, std::less<>> targets_{};
  std::map<std::string, std::size_t, std::less<>> heads_{};
  // The labels of each program where a file has several.
  std::map<std::pair<std::size_t, std::string>, std::vector<std::size_t>> labels_{};
  std::map<std::uint32_t, Numbered> programs_{};
  Diagnostics faults_{};
};

}  // namespace frustum::parser
