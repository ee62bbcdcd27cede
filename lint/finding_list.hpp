// What the checks have found, each once.
//
// A check raises a finding under a key of its own (a place, a feed, a segment between two changes
// of a mode); what comes again under the same key is counted. A check keeps kMostPlaces findings;
// those beyond are counted too.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lint/check.hpp"
#include "parser/motion.hpp"

namespace frustum::lint {

constexpr std::size_t kMostPlaces = 100;

struct Finding {
  Check check = Check::program_error;
  Severity severity = Severity::error;
  std::string file{};
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::string message{};
  std::string hint{};
  std::uint64_t count = 1;
  std::optional<DiagnosticId> diagnostic{};  // of what the interpreter or the controller says
};

struct Words {
  std::string message{};
  std::string hint{};
  std::optional<DiagnosticId> diagnostic{};
};

class FindingList {
 public:
  using Key = std::uint64_t;

  // `file`: the main program's, for places that name none.
  FindingList(std::string file, std::set<Check> disabled)
      : file_(std::move(file)), disabled_(std::move(disabled)) {}

  [[nodiscard]] static Key key_of(const parser::SourcePlace& place);
  [[nodiscard]] static Key key_of(double value);
  [[nodiscard]] static Key key_of(const std::string& text);

  // `words()` gives the Words of a finding that is new.
  template <typename Write>
  void raise(Check check, Key key, const parser::SourcePlace& place, const Write& words,
             std::optional<Severity> severity = {}) {
    if (counted(check, key)) return;
    add(check, key, place, words(), severity);
  }
  // What the interpreter or the controller says; the same words are the same finding.
  void raise(Check check, const Diagnostic& said, const parser::SourcePlace& place,
             std::optional<Severity> severity = {});
  [[nodiscard]] bool wants(Check check) const { return !disabled_.contains(check); }

  // By file (the main program first), line and column.
  [[nodiscard]] std::vector<Finding> sorted() const;
  // How many findings a check had beyond kMostPlaces.
  [[nodiscard]] const std::map<Check, std::uint64_t>& left_out() const { return left_out_; }

 private:
  // Whether there is nothing to add: a repeat, one too many, or not wanted.
  [[nodiscard]] bool counted(Check check, Key key);
  void add(Check check, Key key, const parser::SourcePlace& place, Words words,
           std::optional<Severity> severity);

  std::string file_;
  std::set<Check> disabled_;
  std::vector<Finding> findings_{};
  std::map<std::pair<Check, Key>, std::size_t> index_{};
  std::map<Check, std::size_t> places_{};
  std::map<Check, std::uint64_t> left_out_{};
};

}  // namespace frustum::lint
