#include "parser/dialect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

constexpr std::array<std::string_view, kDialects.size()> kNames{"fanuc", "linuxcnc", "sinumerik",
                                                                "heidenhain", "cldata"};

// Where a sign of a dialect is in a line.
enum class Where : std::uint8_t {
  start,  // after block numbers and blanks
  word    // anywhere, not within a longer word
};
struct Sign {
  Dialect dialect;
  std::string_view text;
  Where where;
};
// What no other dialect writes; the first line that has one decides. # represents digits, a blank
// for any number of blanks or none.
constexpr std::array kSigns{
    Sign{Dialect::heidenhain, "BEGIN PGM", Where::start},
    Sign{Dialect::heidenhain, "TOOL CALL", Where::start},
    Sign{Dialect::heidenhain, "BLK FORM", Where::start},
    Sign{Dialect::heidenhain, "CYCL DEF", Where::start},
    Sign{Dialect::heidenhain, "FUNCTION ", Where::start},
    Sign{Dialect::heidenhain, "PLANE ", Where::start},
    Sign{Dialect::heidenhain, "L X", Where::start},
    Sign{Dialect::heidenhain, "L Z", Where::start},
    Sign{Dialect::heidenhain, "LN X", Where::start},
    Sign{Dialect::heidenhain, "CC X", Where::start},
    Sign{Dialect::heidenhain, "LBL #", Where::start},
    Sign{Dialect::heidenhain, "CALL LBL", Where::start},
    Sign{Dialect::heidenhain, "FN #:", Where::start},
    Sign{Dialect::heidenhain, "Q# =", Where::start},
    Sign{Dialect::cldata, "PARTNO", Where::start},
    Sign{Dialect::cldata, "PPRINT", Where::start},
    Sign{Dialect::cldata, "MACHIN", Where::start},
    Sign{Dialect::cldata, "$$", Where::start},
    Sign{Dialect::cldata, "GOTO/", Where::start},
    Sign{Dialect::cldata, "GOTO /", Where::start},
    Sign{Dialect::cldata, "FROM/", Where::start},
    Sign{Dialect::cldata, "UNITS/", Where::start},
    Sign{Dialect::cldata, "UNIT/", Where::start},
    Sign{Dialect::cldata, "TLDATA/", Where::start},
    Sign{Dialect::cldata, "LOAD/TOOL", Where::start},
    Sign{Dialect::cldata, "CYCLE/", Where::start},
    Sign{Dialect::cldata, "CUTCOM/", Where::start},
    Sign{Dialect::cldata, "MULTAX", Where::start},
    Sign{Dialect::cldata, "LOADTL", Where::start},
    Sign{Dialect::cldata, "FEDRAT", Where::start},
    Sign{Dialect::cldata, "SPINDL", Where::start},
    Sign{Dialect::cldata, "CUTTER", Where::start},
    Sign{Dialect::cldata, "TOOL PATH/", Where::start},
    Sign{Dialect::sinumerik, "%_N_", Where::start},
    Sign{Dialect::sinumerik, ";$PATH", Where::start},
    Sign{Dialect::sinumerik, "TRAORI", Where::word},
    Sign{Dialect::sinumerik, "TRAFOOF", Where::word},
    Sign{Dialect::sinumerik, "CYCLE800", Where::word},
    Sign{Dialect::sinumerik, "CYCLE832", Where::word},
    Sign{Dialect::sinumerik, "SUPA", Where::word},
    Sign{Dialect::sinumerik, "MSG(", Where::word},
    Sign{Dialect::sinumerik, "A3=", Where::word},
    Sign{Dialect::sinumerik, "DC(", Where::word},
    Sign{Dialect::sinumerik, "STOPRE", Where::word},
    Sign{Dialect::sinumerik, "ORIWKS", Where::word},
    Sign{Dialect::sinumerik, "G500", Where::word},
    Sign{Dialect::sinumerik, "G710", Where::word},
    Sign{Dialect::sinumerik, "G641", Where::word},
    Sign{Dialect::sinumerik, "G642", Where::word},
    Sign{Dialect::sinumerik, "R# =", Where::word},
    Sign{Dialect::sinumerik, "CR =", Where::word},
    Sign{Dialect::sinumerik, "X =", Where::word},
    Sign{Dialect::sinumerik, "Y =", Where::word},
    Sign{Dialect::sinumerik, "Z =", Where::word},
    Sign{Dialect::sinumerik, "T = \"", Where::word},
    Sign{Dialect::sinumerik, "CYCLE#", Where::word},
    Sign{Dialect::sinumerik, "MCALL", Where::start},
    Sign{Dialect::sinumerik, "TRANS X", Where::start},
    Sign{Dialect::sinumerik, "TRANS Y", Where::start},
    Sign{Dialect::sinumerik, "TRANS Z", Where::start},
    Sign{Dialect::sinumerik, "ATRANS ", Where::start},
    Sign{Dialect::sinumerik, "AROT ", Where::start},
    Sign{Dialect::sinumerik, "DEF REAL", Where::start},
    Sign{Dialect::sinumerik, "DEF INT", Where::start},
    Sign{Dialect::sinumerik, "DEF BOOL", Where::start},
    Sign{Dialect::sinumerik, "PROC ", Where::start},
    Sign{Dialect::sinumerik, "GOTOF", Where::word},
    Sign{Dialect::sinumerik, "GOTOB", Where::word},
    Sign{Dialect::sinumerik, "ENDIF", Where::start},
    Sign{Dialect::sinumerik, "ENDFOR", Where::start},
    Sign{Dialect::sinumerik, "ENDLOOP", Where::start},
    Sign{Dialect::linuxcnc, "O# SUB", Where::start},
    Sign{Dialect::linuxcnc, "O# CALL", Where::start},
    Sign{Dialect::linuxcnc, "O# IF", Where::start},
    Sign{Dialect::linuxcnc, "O# WHILE", Where::start},
    Sign{Dialect::linuxcnc, "O# DO", Where::start},
    Sign{Dialect::linuxcnc, "O# REPEAT", Where::start},
    Sign{Dialect::linuxcnc, "G38.2", Where::word},
    Sign{Dialect::linuxcnc, "G38.3", Where::word},
    Sign{Dialect::linuxcnc, "G33.1", Where::word},
    Sign{Dialect::linuxcnc, "G64 P", Where::word},
    Sign{Dialect::linuxcnc, "M428", Where::word},
    Sign{Dialect::linuxcnc, "M429", Where::word},
    Sign{Dialect::linuxcnc, "O<", Where::start},
    Sign{Dialect::fanuc, "G43.4", Where::word},
    Sign{Dialect::fanuc, "G43.5", Where::word},
    Sign{Dialect::fanuc, "G68.2", Where::word},
    Sign{Dialect::fanuc, "G53.1", Where::word},
};

struct Extension {
  std::string_view ending;
  Dialect dialect;
};
constexpr std::array kExtensions{
    Extension{".mpf", Dialect::sinumerik}, Extension{".spf", Dialect::sinumerik},
    Extension{".h", Dialect::heidenhain},  Extension{".ngc", Dialect::linuxcnc},
    Extension{".apt", Dialect::cldata},    Extension{".cl", Dialect::cldata},
    Extension{".cls", Dialect::cldata},    Extension{".cldata", Dialect::cldata},
    Extension{".clsf", Dialect::cldata},   Extension{".clt", Dialect::cldata},
    Extension{".ncl", Dialect::cldata},    Extension{".aptsource", Dialect::cldata}};

// Lines looked at; programs say early what they are.
constexpr int kLines = 400;

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// The line without comments of ISO programs.
std::string code_of(std::string_view line) {
  std::string code;
  int depth = 0;
  for (const char c : line) {
    if (c == ';' && !code.empty() && code.find_first_not_of(" \t") != std::string::npos) break;
    // MSG( is no comment.
    if (c == '(' && (depth > 0 || code.empty() || !is_letter(code.back()))) ++depth;
    if (depth == 0) code += c;
    if (c == ')' && depth > 0) --depth;
  }
  return code;
}

// Whether the line speaks to people: three words or more that are no words of a program, which
// capitals and digits make up. What is in quotation marks does not count.
bool is_prose(std::string_view code) {
  constexpr int kWords = 3;
  code = code.substr(0, code.find('"'));
  const std::string_view blanks = " \t\r";
  int words = 0;
  while (!code.empty()) {
    code.remove_prefix(std::min(code.find_first_not_of(blanks), code.size()));
    std::string_view word = code.substr(0, code.find_first_of(blanks));
    code.remove_prefix(word.size());
    while (!word.empty() && std::ispunct(static_cast<unsigned char>(word.back())) != 0) {
      word.remove_suffix(1);
    }
    const bool letters = std::all_of(word.begin(), word.end(), is_letter);
    const bool small = std::any_of(word.begin(), word.end(), [](char c) {
      return std::islower(static_cast<unsigned char>(c)) != 0;
    });
    if (word.size() > 1 && letters && small) ++words;
  }
  return words >= kWords;
}

// Behind blanks, N and digits.
std::string_view behind_number(std::string_view code) {
  const auto skip = [&code](auto test) {
    while (!code.empty() && test(code.front())) code.remove_prefix(1);
  };
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  skip(blank);
  const bool numbered = code.size() > 1 && (code[0] == 'N' || code[0] == ':') && is_digit(code[1]);
  if (numbered) code.remove_prefix(1);
  skip(is_digit);
  skip(blank);
  return code;
}

// The end of the sign where the code begins with it.
std::optional<std::size_t> end_of_sign(std::string_view code, std::string_view sign) {
  std::size_t at = 0;
  const auto skip = [&](auto test) {
    const std::size_t before = at;
    while (at < code.size() && test(code[at])) ++at;
    return at > before;
  };
  for (const char wanted : sign) {
    if (wanted == ' ') {
      skip([](char c) { return c == ' ' || c == '\t'; });
    } else if (wanted == '#') {
      if (!skip(is_digit)) return std::nullopt;
    } else if (at >= code.size() || code[at++] != wanted) {
      return std::nullopt;
    }
  }
  return at;
}

// The sign as the code has it.
std::optional<std::string_view> find_sign(std::string_view code, const Sign& sign) {
  const std::string_view first = behind_number(code);
  if (sign.where == Where::start) {
    const auto length = end_of_sign(first, sign.text);
    return length ? std::optional(first.substr(0, *length)) : std::nullopt;
  }
  if (first.starts_with(';')) return std::nullopt;  // a remark
  for (std::size_t at = code.find(sign.text.front()); at != std::string_view::npos;
       at = code.find(sign.text.front(), at + 1)) {
    const auto length = end_of_sign(code.substr(at), sign.text);
    if (!length) continue;
    const std::size_t end = at + *length;
    const bool begins = at == 0 || !is_letter(code[at - 1]);
    const bool ends = end >= code.size() || !(is_digit(code[end]) && is_digit(sign.text.back()));
    if (begins && ends) return code.substr(at, *length);
  }
  return std::nullopt;
}

// Signs that texts of a program may stand behind.
bool may_be_beside_text(const Sign& sign) {
  return sign.dialect == Dialect::cldata || sign.text == "BEGIN PGM";
}

std::optional<RecognisedDialect> by_content(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  // A page about programs shows some lines of them.
  constexpr int kLinesOfAPage = 4;  // one of so many is prose
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const char line_end = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  std::optional<RecognisedDialect> recognised;
  int lines = 0;
  int lines_of_prose = 0;
  for (int line = 1; line <= kLines && !text.empty(); ++line) {
    const std::size_t end = std::min(text.find(line_end), text.size());
    const std::string written = code_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool prose = is_prose(written) && !behind_number(written).starts_with(';');
    if (prose) ++lines_of_prose;
    if (written.find_first_not_of(" \t\r") != std::string::npos) ++lines;
    if (recognised) continue;
    const std::string code = upper_case(written);
    for (const Sign& sign : kSigns) {
      if (prose && !may_be_beside_text(sign)) continue;
      const auto found = find_sign(code, sign);
      if (!found) continue;
      const std::string_view shown = found->substr(0, found->find_last_not_of(" \t") + 1);
      recognised = RecognisedDialect{sign.dialect, fmt::format("line {}: {}", line, shown)};
      break;
    }
    if (recognised && (lines_of_prose == 0 || recognised->dialect == Dialect::cldata)) break;
  }
  if (recognised && recognised->dialect != Dialect::cldata &&
      lines_of_prose * kLinesOfAPage > lines) {
    return std::nullopt;
  }
  return recognised;
}

}  // namespace

std::string_view name_of(Dialect dialect) { return kNames.at(static_cast<std::size_t>(dialect)); }

std::optional<Dialect> dialect_named(std::string_view name) {
  if (name == "iso") return Dialect::fanuc;
  for (const Dialect dialect : kDialects) {
    if (name_of(dialect) == name) return dialect;
  }
  return std::nullopt;
}

RecognisedDialect recognise_dialect(std::string_view text, std::string_view file) {
  auto found = by_content(text);
  const std::string name = lower_case(file);
  const auto* extension =
      std::find_if(kExtensions.begin(), kExtensions.end(),
                   [&name](const Extension& known) { return name.ends_with(known.ending); });
  // LinuxCNC can be taught Fanuc's words (REMAP), Fanuc's controls know no .ngc.
  const bool remapped = found && found->dialect == Dialect::fanuc &&
                        extension != kExtensions.end() && extension->dialect == Dialect::linuxcnc;
  if (found && !remapped) return *std::move(found);
  if (extension != kExtensions.end()) {
    return {extension->dialect, fmt::format("the name ends in {}", extension->ending)};
  }
  return {Dialect::fanuc, "nothing says otherwise"};
}

}  // namespace frustum::parser
