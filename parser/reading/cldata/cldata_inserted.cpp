#include "parser/reading/cldata/cldata_inserted.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

// Without the control's own remarks: (..) and what is behind a ;
std::string without_remarks(std::string_view text) {
  std::string bare;
  bool inside = false;
  for (const char c : text) {
    if (!inside && c == ';') break;
    if (c == '(') inside = true;
    if (!inside) bare += c;
    if (c == ')') inside = false;
  }
  return upper_case(bare);
}

bool begins_statement(std::string_view text) {
  constexpr std::array<std::string_view, 18> kStatements{
      "#",         "CYCL DEF",      "CYCL CALL",   "CALL LBL",     "CALL PGM",
      "TOOL CALL", "PLANE SPATIAL", "PLANE RESET", "PLANE VECTOR", "PLANE AXIAL",
      "TRANS ",    "ATRANS ",       "ROT ",        "AROT ",        "SUPA",
      "TRAORI",    "TRAFOOF",       "CYCLE800"};
  return std::any_of(kStatements.begin(), kStatements.end(),
                     [&](std::string_view start) { return text.starts_with(start); });
}

// Of all controls: stops, the spindle, tools, ends, calls, and what turns or moves axes.
bool is_of_controls(int m_code) {
  constexpr std::array<std::array<int, 2>, 6> kRanges{
      {{0, 6}, {30, 30}, {60, 60}, {89, 99}, {126, 130}, {140, 140}}};
  return std::any_of(kRanges.begin(), kRanges.end(), [&](const std::array<int, 2>& range) {
    return m_code >= range[0] && m_code <= range[1];
  });
}

}  // namespace

Inserted what_is_inserted(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  constexpr std::string_view kBlanks = " \t\r";
  constexpr std::array<std::string_view, 7> kBare{"L", "C", "FMAX", "FAUTO", "RL", "RR", "CC"};
  constexpr std::string_view kActs = "GMXYZABCUVWT";
  const std::string bare = without_remarks(text);
  std::string_view rest = bare;
  bool codes_alone = true;
  bool acts = false;
  bool first = true;
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    if (first && rest.starts_with('/')) rest.remove_prefix(1);
    if (rest.empty()) break;
    if (first && begins_statement(rest)) return Inserted::block;
    const std::string_view name =
        rest.substr(0, std::min(rest.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ"), rest.size()));
    rest.remove_prefix(name.size());
    if (std::find(kBare.begin(), kBare.end(), name) != kBare.end() &&
        (rest.empty() || kBlanks.find(rest.front()) != std::string_view::npos)) {
      acts = true;
      codes_alone = false;
      first = false;
      continue;
    }
    std::size_t end = 0;
    while (end < rest.size() && (rest[end] == '=' || rest[end] == '+' || rest[end] == '-')) ++end;
    const std::size_t digits = end;
    while (end < rest.size() &&
           (kDigits.find(rest[end]) != std::string_view::npos || rest[end] == '.')) {
      ++end;
    }
    if (name.size() != 1 || end == digits) return Inserted::remark;
    const char letter = name.front();
    if (first && letter == 'G') return Inserted::block;
    const std::string_view number = rest.substr(0, end);
    rest.remove_prefix(end);
    if (letter == 'N') continue;
    first = false;
    acts = acts || kActs.find(letter) != std::string_view::npos;
    constexpr std::size_t kMostDigits = 6;
    const bool whole =
        number.find_first_not_of(kDigits) == std::string_view::npos && number.size() <= kMostDigits;
    codes_alone =
        codes_alone && letter == 'M' && whole && !is_of_controls(std::stoi(std::string(number)));
  }
  if (!acts) return Inserted::remark;
  return codes_alone ? Inserted::builder_code : Inserted::block;
}

}  // namespace frustum::parser
