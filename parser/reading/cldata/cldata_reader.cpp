// APT CLDATA as CAM systems write it: a record a line, its word, / and its arguments.
//
// RAPID, CIRCLE and TLAXIS speak about the GOTO after them, so the reader keeps them until then.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/spelling.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/motion.hpp"
#include "parser/reading/block_draft.hpp"
#include "parser/reading/block_reader.hpp"
#include "parser/reading/cldata/cldata_arcs.hpp"
#include "parser/reading/cldata/cldata_cycle.hpp"
#include "parser/reading/cldata/cldata_record.hpp"
#include "parser/reading/cldata/cldata_settings.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {
namespace {

// Records whose arguments change nothing that is simulated.
constexpr std::array<const char*, 32> kEvents{
    "CUTTER", "TOOLNO", "MACHIN", "INTOL",  "OUTTOL", "TOLER",  "LEADER", "OPNAME",
    "SELECT", "PLABEL", "LINTOL", "SEQNO",  "TLDATA", "MSYS",   "PAINT",  "CLDIST",
    "CLEARP", "AUXFUN", "REWIND", "AUTOPS", "PSIS",   "SELCTL", "OFSTNO", "OPSKIP",
    "CLPRNT", "NOPOST", "ISN",    "CLAMP",  "TMARK",  "RESET",  "THICK",  "BREAK"};
constexpr std::array kPositionWords{'X', 'Y', 'Z', 'a', 'b', 'c'};
constexpr std::array kVectorNames{"", "", "", "i ", "j ", "k "};
constexpr const char* kPositionRemedy = "give x,y,z or x,y,z,i,j,k";

// What the records before have said about those to come.
struct Pending {
  bool rapid = false;
  bool goes_on = false;  // the record before was a GOTO
  CldataModes modes{};
  CldataArcs arcs{};
  std::optional<Vec3> at{};  // the last place, as written
};

class CldataReader {
 public:
  CldataReader(std::string_view text, std::uint32_t line, Pending& pending)
      : in_(text, line), pending_(pending) {
    block_.line = line;
  }

  Result<Block> operator()() {
    if (!take_comment() && !in_.at_end()) read_record();
    return in_.finish(std::move(block_));
  }

 private:
  struct Handler {
    std::string_view word;
    void (CldataReader::*read)();
  };

  bool take_comment() {
    const std::uint32_t column = in_.column();
    if (!in_.take('$')) return in_.failed();
    if (!in_.take('$')) {
      in_.fail("value-missing"_id, column, "nothing follows the continuation mark",
               "$ continues a record on the next line, $$ begins a comment");
      return true;
    }
    block_.comments.push_back({column, true, in_.text_to(), nullptr});
    return true;
  }

  // A)GOTO/...
  void take_label() {
    const std::uint32_t column = in_.column();
    std::string label = in_.name();
    if (label.empty()) label = in_.digits();
    if (!label.empty() && in_.take(')')) {
      block_.comments.push_back({column, false, std::move(label), "label"});
    } else {
      in_.go_to(column);
    }
  }

  void read_record() {
    take_label();
    record_.column = in_.column();
    // Creo writes further places on lines of their own.
    const char first = in_.peek();
    const bool number =
        (first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.';
    if (number && pending_.goes_on) {
      record_.word = "GOTO";
      record_.arguments = read_cldata_arguments(in_);
      return read_rest();
    }
    record_.word = in_.name();
    if (record_.word.empty()) return in_.fail_unexpected("a record is a word, / and its arguments");
    if (take_text() || take_note()) return;
    if (in_.peek() == '=') {
      return in_.fail("not-supported"_id, record_.column,
                      record_.word + " is defined in the APT language",
                      "let the APT processor write CLDATA, without definitions");
    }
    if (record_.word == "TLON") {
      in_.take('/');
      read_guided_arc();
      if (!in_.failed() && !take_comment() && !in_.at_end()) in_.fail_unexpected("end the record");
      return;
    }
    // LOAD/TOOL,5 is LOADTL/5.
    if (in_.take('/')) record_.arguments = read_cldata_arguments(in_);
    if (record_.word == "LOAD" && !record_.arguments.empty() &&
        record_.arguments[0].word == "TOOL") {
      record_.word = "LOADTL";
      record_.arguments.erase(record_.arguments.begin());
    }
    read_rest();
  }

  bool take_text() {
    const char* text = cldata_text_word(record_.word);
    if (text == nullptr) return false;
    in_.go_to(record_.column + static_cast<std::uint32_t>(std::string_view(text).size()));
    in_.take('/');
    const bool message = std::string_view(text) == "PPRINT";
    block_.comments.push_back({record_.column, false, in_.text_to(), message ? "message" : text});
    return true;
  }

  bool take_note() {
    const std::string& word = record_.word;
    if (word == "TOOL" && in_.take_name("PATH")) return note("TOOL PATH");
    if (word == "END" && in_.peek() == '-') return note("END-OF-PATH");
    for (const char* event : kEvents) {
      if (word == event) return note(event);
    }
    return false;
  }

  bool note(const char* event) {
    in_.take('/');
    // Of all lines that it goes over.
    std::string text = in_.text_to("$");
    while (!in_.at_end() && in_.peek() != '$') text += in_.text_to("$");
    block_.comments.push_back({record_.column, false, std::move(text), event});
    if (!take_comment() && !in_.at_end()) in_.fail_unexpected("separate arguments by ,");
    return true;
  }

  void read_rest() {
    if (!take_comment() && !in_.at_end()) in_.fail_unexpected("separate arguments by ,");
    if (in_.failed() || take_harmless() || is_refused()) return;
    const bool place = record_.word == "GOTO" || record_.word == "CONT";
    if (!place) {
      if (!leave_circle()) return;
      pending_.goes_on = false;
    }
    for (const Handler& handler : handlers()) {
      if (record_.word == handler.word) return (this->*handler.read)();
    }
    const bool inches = pending_.modes.inches;
    if (read_cldata_setting(in_, record_, pending_.modes, block_)) {
      if (pending_.modes.inches != inches) pending_.at.reset();
      return;
    }
    in_.fail("unknown-word"_id, record_.column, "unknown record " + record_.word,
             suggestion(record_.word, known_records()));
  }

  // A circle ends with the GOTO records after it; what sets a mode may be before the first.
  bool leave_circle() {
    const auto line = pending_.arcs.waits_since();
    if (!line) {
      pending_.arcs.close();
      return true;
    }
    constexpr std::array kEnds{"CIRCLE", "MOVARC", "GODLTA", "GOHOME", "FROM", "END", "FINI"};
    if (std::find(kEnds.begin(), kEnds.end(), record_.word) == kEnds.end()) return true;
    in_.fail("keyword-missing"_id, record_.column,
             fmt::format("the CIRCLE on line {} has no GOTO", *line),
             "give the end of the arc by GOTO");
    return false;
  }

  // Of records that are refused, the forms that change nothing.
  bool take_harmless() {
    struct Form {
      std::string_view word;
      std::string_view argument;
    };
    constexpr std::array kForms{Form{"CUTCOM", "OFF"},  Form{"TRACUT", "NOMORE"},
                                Form{"COPY", "NOMORE"}, Form{"MODE", "ABSOL"},
                                Form{"THREAD", "OFF"},  Form{"ROTATE", "OFF"}};
    for (const Form& form : kForms) {
      if (record_.word != form.word || record_.only_word() != form.argument) continue;
      block_.comments.push_back(
          {record_.column, false, std::string(form.argument), form.word.data()});
      return true;
    }
    return false;
  }

  bool is_refused() {
    const auto remedy = remedy_for(Dialect::cldata, record_.word);
    if (remedy.empty()) return false;
    in_.fail("not-supported"_id, record_.column, record_.word + " is not simulated",
             std::string(remedy));
    return true;
  }

  static std::span<const Handler> handlers() {
    static constexpr std::array kHandlers{
        Handler{"GOTO", &CldataReader::read_goto},
        Handler{"CONT", &CldataReader::read_goto},
        Handler{"GODLTA", &CldataReader::read_increment},
        Handler{"CIRCLE", &CldataReader::read_circle},
        Handler{"MOVARC", &CldataReader::read_circle},
        Handler{"INDIRV", &CldataReader::read_direction},
        Handler{"INDIRP", &CldataReader::read_direction},
        Handler{"FROM", &CldataReader::read_start},
        Handler{"GOHOME", &CldataReader::read_home},
        Handler{"RAPID", &CldataReader::read_rapid},
        Handler{"CYCLE", &CldataReader::read_cycle},
        Handler{"STOP", &CldataReader::read_plain},
        Handler{"OPSTOP", &CldataReader::read_plain},
        Handler{"END", &CldataReader::read_plain},
        Handler{"FINI", &CldataReader::read_plain},
    };
    return kHandlers;
  }

  static std::vector<std::string> known_records() {
    std::vector<std::string> words;
    for (const Handler& handler : handlers()) words.emplace_back(handler.word);
    for (const std::string_view word : cldata_setting_words()) words.emplace_back(word);
    for (const char* word : cldata_text_words()) words.emplace_back(word);
    words.insert(words.end(), kEvents.begin(), kEvents.end());
    return words;
  }

  void read_plain() {
    add(record_.word);
    take_no_arguments();
  }

  void read_rapid() {
    pending_.rapid = true;
    take_no_arguments();
  }

  void take_no_arguments() {
    if (!record_.arguments.empty()) {
      in_.fail("argument-count"_id, record_.arguments.front().column,
               record_.word + " takes no arguments", fmt::format("write {} alone", record_.word));
    }
  }

  void add(std::string_view code) {
    add_code(block_, *find_code(Dialect::cldata, code), record_.column);
  }

  void add_position(std::string_view code) {
    if (!are_cldata_numbers(in_, record_, {3, 6}, kPositionRemedy)) return;
    std::vector<CldataArgument> given = record_.arguments;
    if (given.size() == 3)
      given.insert(given.end(), pending_.modes.axis.begin(), pending_.modes.axis.end());
    // A vector along Z says nothing new where the tool does not tilt.
    const bool upright = given.size() == 6 && given[3].number == 0.0 && given[4].number == 0.0 &&
                         given[5].number > 0.0;
    const std::size_t count = upright && !pending_.modes.multax ? 3 : given.size();
    add(code);
    for (std::size_t i = 0; i < count; ++i) {
      const bool written = i < record_.arguments.size();
      add_number(block_, kPositionWords.at(i), given[i].number,
                 written ? given[i].column : record_.column, i < 3 ? nullptr : kVectorNames.at(i));
    }
    pending_.at = record_.point();
  }

  void read_start() { add_position("FROM"); }

  void read_goto() {
    if (record_.word == "CONT" && !pending_.goes_on) {
      return in_.fail("arc-incomplete"_id, record_.column, "CONT goes on from no GOTO",
                      "write GOTO");
    }
    if (!are_cldata_numbers(in_, record_, {3, 6}, kPositionRemedy)) return;
    const auto arc = pending_.arcs.to(in_, record_, pending_.at, pending_.modes.inches);
    if (in_.failed()) return;
    pending_.goes_on = true;
    if (arc) {
      pending_.rapid = false;
      add_position(arc->counterclockwise ? "CIRCLE+" : "CIRCLE-");
      return add_arc(block_, *arc, record_.column);
    }
    add_position(pending_.rapid ? "RAPID GOTO" : "GOTO");
    pending_.rapid = false;
  }

  void read_increment() {
    if (!are_cldata_numbers(in_, record_, {3}, "give dx,dy,dz")) return;
    add(pending_.rapid ? "RAPID GODLTA" : "GODLTA");
    pending_.rapid = false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (record_.arguments[i].number == 0.0) continue;
      add_number(block_, kPositionWords.at(i), record_.arguments[i].number,
                 record_.arguments[i].column);
      block_.words.back().measure = Measure::incremental;
    }
    if (pending_.at) *pending_.at += record_.point();
  }

  void read_home() {
    if (record_.arguments.empty()) {
      pending_.at.reset();
      return add("GOHOME");
    }
    pending_.rapid = false;
    add_position("RAPID GOTO");
  }

  void read_circle() {
    if (pending_.rapid) {
      return in_.fail("word-misplaced"_id, record_.column, "an arc by rapid",
                      "give the feed of the arc by FEDRAT");
    }
    pending_.arcs.begin(in_, record_, block_.line);
  }

  void read_direction() { pending_.arcs.point_along(in_, record_); }

  void read_guided_arc() {
    if (!leave_circle()) return;
    pending_.goes_on = false;
    const auto arc = pending_.arcs.along_line(in_, record_.column, pending_.at);
    if (!arc) return;
    record_.arguments.clear();
    for (const double value : arc->end) record_.arguments.push_back({record_.column, {}, value});
    pending_.rapid = false;
    add_position(arc->counterclockwise ? "CIRCLE+" : "CIRCLE-");
    add_arc(block_, *arc, record_.column);
  }

  void read_cycle() { read_cldata_cycle(in_, record_, pending_.modes.inches, block_); }

  LineScanner in_;
  Pending& pending_;
  Block block_;
  CldataRecord record_;
};

}  // namespace

BlockReader cldata_reader() {
  return [pending = Pending{}](std::string_view text, std::uint32_t line) mutable {
    return CldataReader(text, line, pending)();
  };
}

}  // namespace frustum::parser
