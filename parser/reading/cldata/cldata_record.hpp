// One record of APT CLDATA as written: its word, /, and its arguments.
//
// Numbers may have an exponent (E or D), end or begin with the point, and be apart from their
// sign. Blanks mean nothing between the parts of a record.
// Units : none; as written
// Errors: an argument that is missing, a number too large; by LineScanner::fail
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {

struct CldataArgument {
  std::uint32_t column = 0;
  std::string word{};  // empty for a number
  double number = 0.0;

  [[nodiscard]] bool is_number() const { return word.empty(); }
};

struct CldataRecord {
  std::string word{};
  std::uint32_t column = 0;
  std::vector<CldataArgument> arguments{};

  // From the `first` argument on: "RANGE,2".
  [[nodiscard]] std::string text_from(std::size_t first) const;
  // The argument, when it is one word.
  [[nodiscard]] std::string only_word() const {
    return arguments.size() == 1 ? arguments.front().word : std::string();
  }
  // Three numbers from the `first` argument on.
  [[nodiscard]] Vec3 point(std::size_t first = 0) const {
    return {arguments[first].number, arguments[first + 1].number, arguments[first + 2].number};
  }
};

// Records that are text to their end: PARTNO, PPRINT.
[[nodiscard]] std::span<const char* const> cldata_text_words();
// The one that a record begins with, in upper case; null when there is none. It may run into its
// text: PARTNOFLANGE.
[[nodiscard]] const char* cldata_text_word(std::string_view record);

// The arguments from here on, separated by commas; none where the record ends here (RAPID/).
[[nodiscard]] std::vector<CldataArgument> read_cldata_arguments(LineScanner& in);

// Whether all arguments are numbers, as many as one of `counts`; else it fails, with the remedy.
bool are_cldata_numbers(LineScanner& in, const CldataRecord& record,
                        std::initializer_list<std::size_t> counts, const char* remedy);

}  // namespace frustum::parser
