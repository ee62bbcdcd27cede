// APT CLDATA as CAM systems write it: a record a line, its word, / and its arguments.
//
// RAPID, CIRCLE and TLAXIS speak about the GOTO after them, so the reader keeps them until then.
// GOTO records are nearly all of a program and have a reader of their own (cldata_place.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/spelling.hpp"
#include "core/units.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/motion.hpp"
#include "parser/reading/block_draft.hpp"
#include "parser/reading/block_reader.hpp"
#include "parser/reading/cldata/cldata_arcs.hpp"
#include "parser/reading/cldata/cldata_cycle.hpp"
#include "parser/reading/cldata/cldata_nurbs.hpp"
#include "parser/reading/cldata/cldata_place.hpp"
#include "parser/reading/cldata/cldata_record.hpp"
#include "parser/reading/cldata/cldata_remarks.hpp"
#include "parser/reading/cldata/cldata_settings.hpp"
#include "parser/reading/cldata/cldata_words.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {
namespace {

constexpr std::array kPositionWords{'X', 'Y', 'Z', 'a', 'b', 'c'};
constexpr std::array kVectorNames{"", "", "", "i ", "j ", "k "};
// Vectors have six decimals or more.
constexpr double kSameVector = 2e-6;
constexpr const char* kPositionRemedy = "give x,y,z or x,y,z,i,j,k";

// What the records before have said about those to come.
struct Pending {
  bool rapid = false;
  bool goes_on = false;  // the record before was a GOTO
  bool drills = false;   // a cycle is on, with a feed of its own
  CldataModes modes{};
  CldataArcs arcs{};
  CldataNurbs nurbs{};
  std::optional<Vec3> at{};     // the last place, as written
  std::optional<Vec3> axis{};   // the last tool vector
  std::string frame{};          // of MSYS
  bool refused = false;         // what is no program for milling is reported once
  bool remark_goes_on = false;  // $$-> CSYS / 1.0, 0.0, $
};

class CldataReader {
 public:
  CldataReader(std::string_view text, std::uint32_t line, Pending& pending)
      : in_(text, line), pending_(pending) {
    block_.line = line;
  }

  Result<Block> operator()() {
    if (pending_.refused) return std::move(block_);
    const bool of_remark = std::exchange(pending_.remark_goes_on, false) && begins_with_number();
    if (const auto place = read_cldata_place(in_.text())) {
      read_place(*place);
    } else if (of_remark) {
      block_.comments.push_back({in_.column(), true, remarks_.numbers_of_remark(), nullptr});
    } else if (remarks_.take_comment()) {
      pending_.remark_goes_on = !in_.failed() && block_.comments.back().text.ends_with('$');
    } else if (!in_.at_end()) {
      read_record();
    }
    return in_.finish(std::move(block_));
  }

 private:
  struct Handler {
    std::string_view word;
    void (CldataReader::*read)();
  };

  bool begins_with_number() {
    const char first = in_.peek();
    return (first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.';
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
    if (pending_.goes_on && begins_with_number()) {
      record_.word = "GOTO";
      record_.arguments = read_cldata_arguments(in_);
      return read_rest();
    }
    record_.word = in_.name();
    if (record_.word.empty()) return in_.fail_unexpected("a record is a word, / and its arguments");
    if (takes_mode_of_set()) return read_rest();
    if (remarks_.take_text() || is_no_program() || remarks_.take_note(pending_.frame) ||
        remarks_.take_turn_of_nothing()) {
      return;
    }
    if (record_.word == "TLON") {
      in_.take('/');
      read_guided_arc();
      if (!in_.failed() && !remarks_.take_comment() && !in_.at_end())
        in_.fail_unexpected("end the record");
      return;
    }
    // LOAD/TOOL,5 is LOADTL/5.
    const std::uint32_t behind_word = in_.column();
    if (in_.take('/')) {
      if (!is_known()) return read_unknown(behind_word);
      record_.arguments = read_cldata_arguments(in_);
    } else if (!is_known()) {
      return read_unknown(behind_word);
    }
    if (record_.word == "LOAD" && !record_.arguments.empty() &&
        record_.arguments[0].word == "TOOL") {
      record_.word = "LOADTL";
      record_.arguments.erase(record_.arguments.begin());
    } else if (record_.word == "LOAD") {
      in_.go_to(behind_word);
      return add_post_word(remarks_.rest_of_record());
    }
    read_rest();
  }

  // SET/MODE,INCR is MODE/INCR.
  bool takes_mode_of_set() {
    const std::uint32_t behind_word = in_.column();
    if (record_.word == "SET" && in_.take('/') && in_.take_name("MODE") && in_.take(',')) {
      record_.word = "MODE";
      record_.arguments = read_cldata_arguments(in_);
      return true;
    }
    in_.go_to(behind_word);
    return false;
  }

  // What is written for the APT processor, for a lathe or for wire erosion.
  bool is_no_program() {
    const std::uint32_t behind_word = in_.column();
    const bool source = in_.peek() == '=' || record_.word == "MACRO" || record_.word == "TERMAC";
    if (!source && !names_the_process(record_.word)) return false;
    in_.take('/');
    const std::string arguments = in_.text_to("$");
    in_.go_to(behind_word);
    if (source) {
      in_.fail("not-supported"_id, record_.column, record_.word + " is defined in the APT language",
               "let the APT processor write CLDATA, without definitions");
    } else if (is_not_milling(record_.word, arguments)) {
      in_.fail("not-milling"_id, record_.column,
               fmt::format("{}/{} is of a lathe or of wire erosion", record_.word, arguments),
               "only programs for milling are read");
    }
    pending_.refused = in_.failed();
    return in_.failed();
  }

  // Words of post-processors are many; what could move the tool or is near a known word is a
  // mistake.
  void read_unknown(std::uint32_t behind_word) {
    in_.go_to(behind_word);
    std::string arguments = remarks_.rest_of_record();
    const std::vector<std::string> known = known_records();
    if (could_move(record_.word, arguments) || nearest_word(record_.word, known)) {
      return in_.fail("unknown-word"_id, record_.column, "unknown record " + record_.word,
                      suggestion(record_.word, known));
    }
    add_post_word(std::move(arguments));
  }

  void add_post_word(std::string arguments) {
    if (!arguments.empty()) arguments.insert(0, "/");
    block_.comments.push_back({record_.column, false, record_.word + arguments, "post word", true});
    remarks_.take_comment();
  }

  void read_rest() {
    if (!remarks_.take_comment() && !in_.at_end()) in_.fail_unexpected("separate arguments by ,");
    if (in_.failed() || remarks_.take_harmless() || is_refused()) return;
    const bool place = record_.word == "GOTO" || record_.word == "CONT";
    if (!place) {
      if (!leave_circle()) return;
      pending_.goes_on = false;
      if (!pending_.nurbs.goes_on(in_, record_)) return;
    }
    for (const Handler& handler : handlers()) {
      if (record_.word == handler.word) return (this->*handler.read)();
    }
    if (keeps_tilt()) {
      block_.comments.push_back({record_.column, false, "OFF", "MULTAX"});
      return;
    }
    const bool inches = pending_.modes.inches;
    if (read_cldata_setting(in_, record_, pending_.modes, block_)) {
      if (pending_.modes.inches != inches) pending_.at.reset();
      if (!pending_.modes.multax) pending_.axis.reset();
      return;
    }
    in_.fail("unknown-word"_id, record_.column, "unknown form of " + record_.word,
             "look at the list of records in docs/dialects.md");
  }

  // MULTAX/OFF behind a tilted place: places without vectors are of the tip of the tool as it is.
  [[nodiscard]] bool keeps_tilt() const {
    constexpr double kUpright = 1e-9;
    return record_.word == "MULTAX" && record_.only_word() == "OFF" && pending_.axis &&
           (pending_.axis->normalized() - Vec3::UnitZ()).norm() > kUpright;
  }

  [[nodiscard]] bool is_known() const {
    for (const Handler& handler : handlers()) {
      if (record_.word == handler.word) return true;
    }
    for (const std::string_view word : cldata_setting_words()) {
      if (record_.word == word) return true;
    }
    constexpr std::array<std::string_view, 3> kOthers{"LOAD", "CUTCOM", "ORIGIN"};
    return std::find(kOthers.begin(), kOthers.end(), record_.word) != kOthers.end() ||
           !remedy_for(Dialect::cldata, record_.word).empty();
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
        Handler{"NURBS", &CldataReader::read_nurbs},
        Handler{"KNOT", &CldataReader::read_knots},
        Handler{"CNTRL", &CldataReader::read_control_point},
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
    const auto notes = cldata_note_words();
    words.insert(words.end(), notes.begin(), notes.end());
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

  // x,y,z and perhaps i,j,k.
  [[nodiscard]] std::optional<CldataPlace> place_of_record() {
    if (!are_cldata_numbers(in_, record_, {3, 6}, kPositionRemedy)) return std::nullopt;
    CldataPlace place{record_.column, record_.arguments.size(), {}, {}};
    for (std::size_t i = 0; i < place.count; ++i) {
      place.numbers.at(i) = record_.arguments[i].number;
      place.columns.at(i) = record_.arguments[i].column;
    }
    return place;
  }

  // A place without a vector has that of TLAXIS or CSYS. A vector along Z says nothing new where
  // the tool does not tilt; another one tilts it, with or without MULTAX.
  void complete(CldataPlace& place) const {
    constexpr std::size_t kCoordinates = 3;
    if (place.count == kCoordinates && !pending_.modes.axis.empty()) {
      place.count *= 2;
      for (std::size_t i = 0; i < kCoordinates; ++i) {
        place.numbers.at(i + kCoordinates) = pending_.modes.axis[i].number;
        place.columns.at(i + kCoordinates) = place.column;
      }
    }
    const bool upright = place.count > kCoordinates && place.numbers[3] == 0.0 &&
                         place.numbers[4] == 0.0 && place.numbers[5] > 0.0;
    if (upright && !pending_.modes.multax) place.count = kCoordinates;
  }

  void add_position(std::string_view code, CldataPlace place) {
    constexpr std::size_t kCoordinates = 3;
    complete(place);
    const bool tilts = place.count > kCoordinates;
    if (tilts && !pending_.modes.multax && code != "FROM") {
      pending_.modes.multax = true;
      add("MULTAX/ON");
    }
    // An arc goes on with the tool as it is.
    const bool curves = code.starts_with("CIRCLE") || code == "NURBS";
    if (tilts && curves && pending_.axis &&
        (place.vector() - *pending_.axis).norm() <= kSameVector) {
      place.count = kCoordinates;
    }
    add(code);
    for (std::size_t i = 0; i < place.count; ++i) {
      add_number(block_, kPositionWords.at(i), place.numbers.at(i), place.columns.at(i),
                 i < kCoordinates ? nullptr : kVectorNames.at(i));
    }
    if (place.count > kCoordinates) pending_.axis = place.vector();
    pending_.at = place.point();
  }

  void read_start() {
    if (const auto place = place_of_record()) add_position("FROM", *place);
  }

  void read_goto() {
    if (record_.word == "CONT" && !pending_.goes_on) {
      return in_.fail("arc-incomplete"_id, record_.column, "CONT goes on from no GOTO",
                      "write GOTO");
    }
    if (const auto place = place_of_record()) read_place(*place);
  }

  void read_place(const CldataPlace& place) {
    record_.column = place.column;
    if (!pending_.nurbs.goes_on(in_, record_)) return;
    const auto arc =
        pending_.arcs.to(in_, place.point(), place.column, pending_.at, pending_.modes.inches);
    if (in_.failed()) return;
    pending_.goes_on = true;
    const bool rapid = std::exchange(pending_.rapid, false);
    if (!rapid) need_feed();
    if (arc && arc->step) {
      remarks_.assumed("CIRCLE step", "its end is just ahead of its start: a step, no full turn");
    } else if (arc) {
      add_position(arc->code(), place);
      if (arc->times_started) {
        remarks_.assumed("CIRCLE TIMES", "it counts the turns that are started");
      }
      return add_arc(block_, *arc, place.column);
    }
    add_position(rapid ? "RAPID GOTO" : "GOTO", place);
  }

  // A feed that nothing gives changes the time, not the path.
  void need_feed() {
    constexpr double kFeed = 1000.0;  // mm/min
    if (pending_.modes.feed_given || pending_.drills) return;
    pending_.modes.feed_given = true;
    add("FEDRAT/MMPM");
    add_number(block_, 'F', pending_.modes.inches ? kFeed / kMmPerInch : kFeed, record_.column);
    remarks_.assumed("FEDRAT", "no feed is given before this move: 1000 mm/min");
  }

  void read_increment() {
    if (!are_cldata_numbers(in_, record_, {3}, "give dx,dy,dz")) return;
    if (!pending_.rapid) need_feed();
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
    if (const auto place = place_of_record()) add_position("RAPID GOTO", *place);
  }

  void read_circle() {
    if (pending_.rapid) {
      return in_.fail("word-misplaced"_id, record_.column, "an arc by rapid",
                      "give the feed of the arc by FEDRAT");
    }
    pending_.arcs.begin(in_, record_, block_.line);
  }

  void read_nurbs() {
    if (pending_.rapid) {
      return in_.fail("word-misplaced"_id, record_.column, "a spline by rapid",
                      "give its feed by FEDRAT");
    }
    pending_.nurbs.begin(in_, record_, block_.line, pending_.at);
  }

  void read_knots() { pending_.nurbs.add_knots(in_, record_); }

  void read_control_point() {
    const auto curve = pending_.nurbs.add_point(in_, record_);
    if (!curve) return;
    need_feed();
    add_position("NURBS", CldataPlace::at(curve->end, record_.column));
    add_curve(block_, *curve, record_.column);
    remarks_.assumed("NURBS", "a cubic from where the tool is, clamped at both ends");
  }

  void read_direction() { pending_.arcs.point_along(in_, record_); }

  void read_guided_arc() {
    if (!leave_circle()) return;
    pending_.goes_on = false;
    const auto arc = pending_.arcs.along_line(in_, record_.column, pending_.at);
    if (!arc) return;
    const CldataPlace place = CldataPlace::at(arc->end, record_.column);
    pending_.rapid = false;
    need_feed();
    add_position(arc->code(), place);
    add_arc(block_, *arc, record_.column);
  }

  void read_cycle() {
    read_cldata_cycle(in_, record_, pending_.modes, block_);
    if (in_.failed()) return;
    const std::string& word = record_.arguments.front().word;
    if (word == "INIT" || word == "CLEAR") return;
    pending_.drills = word != "OFF" && word != "NOMORE";
  }

  LineScanner in_;
  Pending& pending_;
  Block block_;
  CldataRecord record_;
  CldataRemarks remarks_{in_, record_, block_};
};

}  // namespace

BlockReader cldata_reader() {
  return [pending = Pending{}](std::string_view text, std::uint32_t line) mutable {
    return CldataReader(text, line, pending)();
  };
}

}  // namespace frustum::parser
