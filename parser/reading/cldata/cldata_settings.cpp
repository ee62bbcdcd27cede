#include "parser/reading/cldata/cldata_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/block_draft.hpp"
#include "parser/reading/cldata/cldata_feed.hpp"

namespace frustum::parser {
namespace {

class SettingReader {
 public:
  SettingReader(LineScanner& in, const CldataRecord& record, CldataModes& modes, Block& block)
      : in_(in), record_(record), modes_(modes), block_(block) {}

  struct Handler {
    std::string_view word;
    void (SettingReader::*read)();
  };
  static std::span<const Handler> handlers();

  void read_feed() {
    const auto& given = record_.arguments;
    // FEDRAT/INVERS,AUTO: the control may get the feed as the inverse of a time.
    if (!given.empty() && given[0].word == "INVERS" && given.size() == 2 && !given[1].is_number()) {
      return note("FEDRAT");
    }
    const CldataArgument* number = nullptr;
    const CldataArgument* unit = nullptr;
    for (const CldataArgument& argument : given) {
      const CldataArgument*& slot = argument.is_number() ? number : unit;
      if (slot != nullptr) {
        return in_.fail("word-misplaced"_id, argument.column,
                        "FEDRAT has more than a feed and its unit", "write FEDRAT/500,MMPM");
      }
      slot = &argument;
    }
    const auto meaning = unit == nullptr ? CldataFeedUnit{modes_.feed_per_revolution, 1.0}
                                         : cldata_feed_unit(unit->word, modes_.inches);
    if (!meaning) {
      return in_.fail("unknown-word"_id, unit->column,
                      fmt::format("{} has no meaning in FEDRAT", unit->word),
                      "units are MMPM, MMPR, IPM, IPR, FPM, FPR, PERMIN and PERREV");
    }
    if (number == nullptr) {
      return in_.fail("value-missing"_id, record_.column, "FEDRAT has no feed",
                      "write FEDRAT/500,MMPM");
    }
    modes_.feed_per_revolution = meaning->per_revolution;
    modes_.feed_given = number->number > 0.0;
    modes_.feed = number->number * meaning->scale;
    add(modes_.feed_per_revolution ? "FEDRAT/MMPR" : "FEDRAT/MMPM");
    add_number(block_, 'F', number->number * meaning->scale, number->column);
  }

  void read_spindle() {
    constexpr const char* kRemedy = "write SPINDL/RPM,5000,CLW or SPINDL/OFF";
    struct Direction {
      std::string_view word;
      const char* code;
    };
    constexpr std::array kDirections{
        Direction{"CLW", "SPINDL/CLW"},   Direction{"CCLW", "SPINDL/CCLW"},
        Direction{"CW", "SPINDL/CLW"},    Direction{"CCW", "SPINDL/CCLW"},
        Direction{"OFF", "SPINDL/OFF"},   Direction{"STOP", "SPINDL/OFF"},
        Direction{"NOMORE", "SPINDL/OFF"}};
    // Of the gearbox, or of the angle at which it stops.
    constexpr std::array<std::string_view, 8> kRemarks{"RANGE", "MAXRPM", "LOW",    "MEDIUM",
                                                       "HIGH",  "AUTO",   "ORIENT", "LOCK"};
    const auto& given = record_.arguments;
    if (given.empty())
      return in_.fail("value-missing"_id, record_.column, "SPINDL says nothing", kRemedy);
    const char* code = modes_.spindle;
    for (std::size_t i = 0; i < given.size(); ++i) {
      const CldataArgument& argument = given[i];
      const auto* direction =
          std::find_if(kDirections.begin(), kDirections.end(),
                       [&](const Direction& known) { return known.word == argument.word; });
      if (argument.is_number()) {
        add_number(block_, 'S', argument.number, argument.column);
        modes_.speed = argument.number;
      } else if (direction != kDirections.end()) {
        code = direction->code;
      } else if (std::find(kRemarks.begin(), kRemarks.end(), argument.word) != kRemarks.end()) {
        if (argument.word == "ORIENT" || argument.word == "LOCK") code = "SPINDL/OFF";
        block_.comments.push_back({argument.column, false, record_.text_from(i), "SPINDL"});
        break;
      } else if (argument.word == "SFM" || argument.word == "SMM") {
        return in_.fail("not-supported"_id, argument.column,
                        "SPINDL by cutting speed is not simulated",
                        "let the CAM system write the speed as SPINDL/RPM,5000,CLW");
      } else if (argument.word != "RPM" && argument.word != "ON") {
        return in_.fail("unknown-word"_id, argument.column,
                        argument.word + " has no meaning in SPINDL", kRemedy);
      }
    }
    if (std::string_view(code) != "SPINDL/OFF") modes_.spindle = code;
    add(code);
  }

  void read_tool() {
    if (record_.arguments.empty() || !record_.arguments.front().is_number()) {
      return in_.fail("value-missing"_id, record_.column, "LOADTL has no number", "write LOADTL/1");
    }
    const CldataArgument& number = record_.arguments.front();
    add("LOADTL");
    add_number(block_, 'T', number.number, number.column, "tool ");
    if (record_.arguments.size() == 1) return;
    // ADJUST, LENGTH and the like: the tool's true size is in the job.
    block_.comments.push_back({record_.arguments[1].column, false, record_.text_from(1), "LOADTL"});
  }

  void read_units() {
    const std::string unit = record_.only_word();
    const bool metric = unit == "MM";
    if (!metric && unit != "INCHES" && unit != "INCH") {
      return in_.fail("keyword-missing"_id, record_.column, "UNITS without MM or INCHES",
                      "write UNITS/MM or UNITS/INCHES");
    }
    modes_.inches = !metric;
    add(metric ? "UNITS/MM" : "UNITS/INCHES");
  }

  void read_multax() {
    const std::string state = record_.only_word();
    if (!record_.arguments.empty() && state != "ON" && state != "OFF") {
      return in_.fail("keyword-missing"_id, record_.column, "MULTAX without ON or OFF",
                      "write MULTAX/ON or MULTAX/OFF");
    }
    modes_.multax = state != "OFF";
    add(modes_.multax ? "MULTAX/ON" : "MULTAX/OFF");
  }

  // CSYS of SolidWorks CAM: the frame of an operation, by rows of a matrix. Places stay the part's;
  // its Z is where the tool points while GOTO has no vector.
  void read_frame() {
    if (!are_cldata_numbers(in_, record_, {12}, "give the 12 numbers of the frame")) return;
    const auto& given = record_.arguments;
    if (!modes_.world) {
      return in_.fail("not-supported"_id, record_.column, "CSYS without TRNTYP/WORLD",
                      "let the CAM system write the path in the coordinates of the part");
    }
    modes_.axis = {given[2], given[6], given[10]};
    note("CSYS");
  }
  // MCS of CAMplete: where the frame of an operation is, by its axes and its origin.
  void read_machining_frame() {
    constexpr std::size_t kNumbers = 12;
    if (!are_cldata_numbers(in_, record_, {kNumbers}, "give the 12 numbers of the frame")) return;
    for (std::size_t i = 0; i < kNumbers; ++i) {
      const double unmoved = i == 0 || i == 4 || i == 8 ? 1.0 : 0.0;
      if (record_.arguments[i].number == unmoved) continue;
      return in_.fail("not-supported"_id, record_.column, "MCS that is not the frame of the part",
                      "let the CAM system write the path in the coordinates of the part");
    }
    note("MCS");
  }
  void read_transform() {
    modes_.world = !record_.arguments.empty() && record_.arguments.front().word == "WORLD";
    if (modes_.world) return note("TRNTYP");
    in_.fail("not-supported"_id, record_.column, "TRNTYP is not simulated",
             "let the CAM system write the path in the coordinates of the part: TRNTYP/WORLD");
  }

  // The vector of GOTO records without one of their own.
  void read_axis() {
    if (!are_cldata_numbers(in_, record_, {3}, "give i,j,k")) return;
    modes_.axis = record_.arguments;
    note("TLAXIS");
  }

  void read_coolant() {
    const auto& given = record_.arguments;
    if (given.empty()) return note("COOLNT");
    const std::string& state = given.front().word;
    if (state == "ON" || state == "FLOOD") {
      add("COOLNT/ON");
    } else if (state == "OFF") {
      add("COOLNT/OFF");
    } else {
      constexpr std::array kOthers{"MIST", "THRU", "AIR", "TAP", "TAPKUL", "THROUGH"};
      note("COOLNT");
      block_.comments.back().of_builder =
          std::find(kOthers.begin(), kOthers.end(), state) == kOthers.end();
      return;
    }
    // What kind, and the pressure.
    if (given.size() > 1) {
      block_.comments.push_back({given[1].column, false, record_.text_from(1), "COOLNT"});
    }
  }

  void read_delay() {
    const auto& given = record_.arguments;
    const CldataArgument* time = nullptr;
    const CldataArgument* unit = nullptr;
    for (const CldataArgument& argument : given) {
      (argument.is_number() ? time : unit) = &argument;
    }
    const bool turns = unit != nullptr && (unit->word == "REV" || unit->word == "REVS");
    const bool seconds = unit == nullptr || unit->word == "SEC" || unit->word == "SECOND";
    if ((!turns && !seconds) || time == nullptr || given.size() > (unit == nullptr ? 1U : 2U)) {
      return in_.fail("value-missing"_id, record_.column, record_.word + " without a time",
                      "write DELAY/2 (seconds) or DELAY/3,REV");
    }
    add(turns ? "DELAY REV" : "DELAY");
    add_number(block_, turns ? 'S' : 'P', time->number, time->column, "DELAY/");
  }

 private:
  void note(const char* event) {
    block_.comments.push_back({record_.column, false, record_.text_from(0), event});
  }
  void add(std::string_view code) {
    add_code(block_, *find_code(Dialect::cldata, code), record_.column);
  }

  LineScanner& in_;
  const CldataRecord& record_;
  CldataModes& modes_;
  Block& block_;
};

std::span<const SettingReader::Handler> SettingReader::handlers() {
  static constexpr std::array kHandlers{
      Handler{"FEDRAT", &SettingReader::read_feed},
      Handler{"SPINDL", &SettingReader::read_spindle},
      Handler{"LOADTL", &SettingReader::read_tool},
      Handler{"UNITS", &SettingReader::read_units},
      Handler{"UNIT", &SettingReader::read_units},
      Handler{"MULTAX", &SettingReader::read_multax},
      Handler{"TLAXIS", &SettingReader::read_axis},
      Handler{"TRNTYP", &SettingReader::read_transform},
      Handler{"CSYS", &SettingReader::read_frame},
      Handler{"MCS", &SettingReader::read_machining_frame},
      Handler{"COOLNT", &SettingReader::read_coolant},
      Handler{"DELAY", &SettingReader::read_delay},
      Handler{"DWELL", &SettingReader::read_delay},
  };
  return kHandlers;
}

}  // namespace

bool read_cldata_setting(LineScanner& in, const CldataRecord& record, CldataModes& modes,
                         Block& block) {
  for (const SettingReader::Handler& handler : SettingReader::handlers()) {
    if (record.word != handler.word) continue;
    SettingReader reader(in, record, modes, block);
    (reader.*handler.read)();
    return true;
  }
  return false;
}

std::vector<std::string_view> cldata_setting_words() {
  std::vector<std::string_view> words;
  for (const SettingReader::Handler& handler : SettingReader::handlers()) {
    words.push_back(handler.word);
  }
  return words;
}

}  // namespace frustum::parser
