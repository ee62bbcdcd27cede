// Lines, labels and datum letters of a DMIS file.
//
// Units  : none
// Errors : none
// Source : DMIS 5.3 (ISO 22093): lines end before column 80, $ continues them, $$ begins a comment
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace frustum::report {

// Of a line, the $ that continues it included.
inline constexpr std::size_t kDmisColumns = 79;

// The first of its bytes, so many at most, whole characters of UTF-8.
[[nodiscard]] std::string shortened_to(std::string_view text, std::size_t bytes);

// Broken after commas; "\n" at the end.
[[nodiscard]] std::string dmis_statement(std::string_view whole);
// Broken at blanks, each line a comment.
[[nodiscard]] std::string dmis_comment(std::string_view content);

// Letters, digits, _; each once in a file. Long names are cut, those that are then alike numbered.
class DmisLabels {
 public:
  std::string of(std::string_view name);
  // Of a point of the feature with that label; the first has number 1.
  std::string of_point(const std::string& label, std::size_t number);

 private:
  std::string once(const std::string& plain, std::size_t longest);

  std::set<std::string> used_{};
  std::map<std::string, int> next_{};  // number of a label that is taken
};

// One or two letters for each datum: its own where its name is such letters, alone or after DAT or
// DATUM ("C", "DAT_C", "datum C"), else the first that no datum and no feature has.
class DmisDatums {
 public:
  DmisDatums(const std::vector<std::string>& datums, const std::vector<std::string>& features);
  [[nodiscard]] std::string of(const std::string& feature) const;

 private:
  std::map<std::string, std::string> letters_{};
};

}  // namespace frustum::report
