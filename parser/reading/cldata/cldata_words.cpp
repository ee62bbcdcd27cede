#include "parser/reading/cldata/cldata_words.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

constexpr std::array kNotes{
    "CUTTER",  "TOOLNO", "MACHIN", "INTOL",       "OUTTOL",    "TOLER",  "LEADER", "OPNAME",
    "SELECT",  "PLABEL", "LINTOL", "SEQNO",       "TLDATA",    "MSYS",   "PAINT",  "CLDIST",
    "CLEARP",  "AUXFUN", "REWIND", "AUTOPS",      "PSIS",      "SELCTL", "OFSTNO", "OPSKIP",
    "CLPRNT",  "NOPOST", "ISN",    "CLAMP",       "TMARK",     "RESET",  "THICK",  "BREAK",
    "SETUP",   "MFGNO",  "LIMITS", "SAFETY",      "VERIFY",    "PLOT",   "MCHTOL", "MAXDPM",
    "MAXVEL",  "RETAIN", "TOOLSZ", "PROGRM",      "OPTIOL",    "FLUSH",  "COUPLE", "DEBUG",
    "STOCK",   "BOX",    "OPER",   "OPFEATSTART", "OPFEATEND", "HEADER", "CHECK",  "TLSPEC",
    "ZEROPT",  "BLANK",  "MDWRIT", "MDEND",       "LIBRY",     "DRESS",  "MILL",   "NOTE",
    "SELECTL", "ARCSLP", "OPTION", "CHUCK",       "OSETNO",    "PROGNO", "LPRINT", "PRINT",
    "RESERV",  "UNLOAD", "HEAD",   "SET",         "ZOFF"};

bool is_place(std::string_view arguments) {
  constexpr int kCoordinates = 3;
  int numbers = 0;
  while (!arguments.empty()) {
    const std::size_t end = std::min(arguments.find(','), arguments.size());
    const std::string_view one = arguments.substr(0, end);
    arguments.remove_prefix(std::min(end + 1, arguments.size()));
    const bool number = one.find_first_of("0123456789") != std::string_view::npos &&
                        one.find_first_not_of(" \t+-.0123456789EeDd") == std::string_view::npos;
    if (number) ++numbers;
  }
  return numbers >= kCoordinates;
}

}  // namespace

std::span<const char* const> cldata_note_words() { return kNotes; }

const char* harmless_cldata(std::string_view record, std::string_view argument) {
  struct Form {
    const char* word;
    std::string_view argument;
  };
  constexpr std::array kForms{
      Form{"TRACUT", "NOMORE"}, Form{"COPY", "NOMORE"},  Form{"MODE", "ABSOL"},
      Form{"THREAD", "OFF"},    Form{"ROTATE", "OFF"},   Form{"MODE", "MILL"},
      Form{"INDEX", "NOMORE"},  Form{"TRANS", "NOMORE"}, Form{"ORIGIN", "NOMORE"},
      Form{"MIRROR", "NOMORE"}, Form{"MIRROR", "OFF"},   Form{"REFSYS", "NOMORE"}};
  for (const Form& form : kForms) {
    if (record == form.word && argument == form.argument) return form.word;
  }
  return nullptr;
}

bool could_move(std::string_view record, std::string_view arguments) {
  constexpr std::array<std::string_view, 21> kMoves{
      "GO",   "MOV",  "ROT", "ARC",  "CIR",   "TRA",  "SPLIN", "NUR",  "HELI",  "LIN", "CUR",
      "AXIS", "POCK", "POL", "TURN", "SHIFT", "RETR", "RTRC",  "APPR", "PLUNG", "LEAD"};
  return is_place(arguments) ||
         std::any_of(kMoves.begin(), kMoves.end(),
                     [&](std::string_view start) { return record.starts_with(start); });
}

bool names_the_process(std::string_view record) {
  constexpr std::array<std::string_view, 9> kWords{"TOOLNO", "MODE",  "TLDATA", "CYCLE", "TURRET",
                                                   "WIRE",   "LATHE", "TURN",   "LOADWI"};
  return std::find(kWords.begin(), kWords.end(), record) != kWords.end();
}

bool is_not_milling(std::string_view record, std::string_view arguments) {
  const std::string text = upper_case(arguments);
  // One of the arguments.
  const auto names = [&](std::string_view wanted) {
    std::string_view rest = text;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(','), rest.size());
      std::string_view one = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      one.remove_prefix(std::min(one.find_first_not_of(" \t"), one.size()));
      if (one.substr(0, one.find_last_not_of(" \t") + 1) == wanted) return true;
    }
    return false;
  };
  if (record == "TOOLNO" || record == "MODE" || record == "TLDATA") {
    return names("TURN") || names("LATHE") || names("WIRE");
  }
  if (record == "CYCLE") return names("TURN");
  return names_the_process(record);
}

}  // namespace frustum::parser
