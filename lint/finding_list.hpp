// What the checks have found, each once.
//
// A check raises a finding under a key of its own (a place, a feed, a segment between two changes
// of a mode); what comes again under the same key is counted, and so are the lines that it comes
// from. A check keeps kMostPlaces findings of each severity, or as many as it is told; those beyond
// are counted too. What a comment of the program takes is kept apart under the same keys, so that
// it does not hide what comes again elsewhere.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lint/check.hpp"
#include "lint/line_set.hpp"
#include "lint/suppressions.hpp"
#include "parser/motion.hpp"

namespace frustum::lint {

constexpr std::size_t kMostPlaces = 100;

// Why a finding does not count: a comment of the program, or it is in the baseline.
enum class Suppressed : std::uint8_t { no, by_comment, by_baseline };

struct Finding {
  Check check = Check::program_error;
  Severity severity = Severity::error;
  std::string file{};
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::string message{};
  std::string hint{};
  std::uint64_t count = 1;
  std::uint64_t places = 1;  // lines that it comes from: a loop does not add to them
  // What the places have in common, where they are not one line: by it the finding is known again.
  std::string alike{};
  std::optional<DiagnosticId> diagnostic{};  // of what the interpreter or the controller says
  Suppressed suppressed = Suppressed::no;
  std::string reason{};  // of the comment
};

struct Words {
  std::string message{};
  std::string hint{};
  std::optional<DiagnosticId> diagnostic{};
  // As of Finding.
  std::string alike{};
  std::uint64_t places = 1;
};

class FindingList {
 public:
  using Key = std::uint64_t;

  FindingList(const parser::Program& program, std::set<Check> disabled,
              std::size_t most_places = kMostPlaces)
      : file_(program.file),
        disabled_(std::move(disabled)),
        most_places_(most_places),
        suppressions_(program) {}

  [[nodiscard]] static Key key_of(const parser::SourcePlace& place);
  [[nodiscard]] static Key key_of(double value);
  [[nodiscard]] static Key key_of(const std::string& text);

  // `words()` gives the Words of a finding that is new.
  template <typename Write>
  void raise(Check check, Key key, const parser::SourcePlace& place, const Write& words,
             std::optional<Severity> severity = {}) {
    if (!wants(check)) return;
    const Suppression* taken = suppressions_.taking(check, place);
    const Severity grade = severity.value_or(info_of(check).severity);
    if (counted({check, key, taken != nullptr}, grade, place)) return;
    add({check, key, taken != nullptr}, grade, place, words(), taken);
  }
  // What the interpreter says of a block; the same words of the same line are the same finding.
  void raise(Check check, const Diagnostic& said, const parser::SourcePlace& place,
             std::optional<Severity> severity = {});
  // What the controller says; the same words are the same finding, whatever the line.
  void raise_alike(Check check, const Diagnostic& said, const parser::SourcePlace& place);
  [[nodiscard]] bool wants(Check check) const { return !disabled_.contains(check); }

  [[nodiscard]] const Suppressions& suppressions() const { return suppressions_; }

  // By file (the main program first), line and column.
  [[nodiscard]] std::vector<Finding> sorted() const;
  // How many findings a check had beyond those that are kept.
  [[nodiscard]] const std::map<Check, std::uint64_t>& left_out() const { return left_out_; }

 private:
  using Place = std::tuple<Check, Key, bool>;  // true: a comment takes it

  // Whether there is nothing to add: a repeat, or one too many.
  [[nodiscard]] bool counted(const Place& at, Severity severity, const parser::SourcePlace& place);
  void add(const Place& at, Severity severity, const parser::SourcePlace& place, Words words,
           const Suppression* taken);

  std::string file_;
  std::set<Check> disabled_;
  std::size_t most_places_;
  Suppressions suppressions_;
  std::vector<Finding> findings_{};
  std::vector<LineSet> lines_{};  // of each of them
  std::map<Place, std::size_t> index_{};
  std::map<std::tuple<Check, Severity, bool>, std::size_t> places_{};
  std::map<Check, std::uint64_t> left_out_{};
};

}  // namespace frustum::lint
