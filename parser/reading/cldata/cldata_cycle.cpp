#include "parser/reading/cldata/cldata_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/constants.hpp"
#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/block_draft.hpp"
#include "parser/reading/cldata/cldata_feed.hpp"

namespace frustum::parser {
namespace {

constexpr const char* kForm =
    "write CYCLE/DRILL,DEPTH,12,MMPM,100,CLEAR,3, then a GOTO for each hole";

struct CycleName {
  std::string_view word;
  std::string_view code;
  bool steps;
};
constexpr std::array kNames{
    CycleName{"DRILL", "CYCLE/DRILL", false},  CycleName{"FACE", "CYCLE/DRILL", false},
    CycleName{"CSINK", "CYCLE/DRILL", false},  CycleName{"CBORE", "CYCLE/DRILL", false},
    CycleName{"SPOT", "CYCLE/DRILL", false},   CycleName{"CTRDRL", "CYCLE/DRILL", false},
    CycleName{"DEEP", "CYCLE/DEEP", true},     CycleName{"DEEP2", "CYCLE/DEEP2", true},
    CycleName{"BRKCHP", "CYCLE/BRKCHP", true}, CycleName{"TAP", "CYCLE/TAP", false},
    CycleName{"RTAP", "CYCLE/TAP", false},     CycleName{"BORE", "CYCLE/BORE", false},
    CycleName{"REAM", "CYCLE/BORE", false},
};
// Said of the tool or the control, not of the path; the first two with a number.
constexpr std::array<std::string_view, 11> kRemarks{"CAM",    "ORIENT", "DIAMTR", "TLANGL",
                                                    "OPTION", "FLOAT",  "RIGID",  "MANUAL",
                                                    "NOMORE", "DRAG",   "NODRAG"};

class CycleReader {
 public:
  CycleReader(LineScanner& in, const CldataRecord& record, const CldataModes& modes)
      : in_(in), record_(record), given_(record.arguments), modes_(modes), inches_(modes.inches) {}

  void operator()(Block& block) {
    if (given_.empty() || given_[0].is_number())
      return fail("name-missing"_id, record_.column, "CYCLE has no name");
    const std::string& first = given_[0].word;
    // Before a definition: nothing is drilled by them.
    if ((first == "INIT" || first == "CLEAR") && given_.size() == 1) {
      block.comments.push_back({record_.column, false, first, "CYCLE"});
      return;
    }
    if (first == "OFF" || first == "ON" || first == "NOMORE") {
      if (given_.size() > 1)
        return fail("argument-count"_id, given_[1].column,
                    "CYCLE/" + first + " takes no arguments");
      return add_code(block, *find_code(Dialect::cldata, first == "ON" ? "CYCLE/ON" : "CYCLE/OFF"),
                      record_.column);
    }
    if (!take_name()) return;
    while (place_ < given_.size() && !in_.failed()) take_part();
    if (!in_.failed()) add_words(block);
  }

 private:
  struct Value {
    std::uint32_t column = 0;
    double number = 0.0;
  };

  void fail(DiagnosticId id, std::uint32_t column, std::string message) {
    in_.fail(id, column, std::move(message), kForm);
  }

  bool take_name() {
    std::string word = given_[0].word;
    place_ = 1;
    // DRILL,DEEP and DRILL,BRKCHP; a word that is no cycle of its own is reported below.
    if (word == "DRILL" && given_.size() > 1 &&
        (given_[1].word == "DEEP" || given_[1].word == "BRKCHP" || given_[1].word == "CSINK")) {
      word = given_[1].word;
      place_ = 2;
    }
    const auto* known = std::find_if(kNames.begin(), kNames.end(),
                                     [&](const CycleName& name) { return name.word == word; });
    if (known == kNames.end()) {
      in_.fail(
          "not-supported"_id, given_[0].column, fmt::format("CYCLE/{} is not simulated", word),
          "write the cycle out as GOTO records; known are DRILL DEEP BRKCHP FACE TAP BORE REAM");
      return false;
    }
    name_ = known;
    return true;
  }

  void take_part() {
    const CldataArgument& part = given_[place_++];
    if (part.is_number()) return take_bare(part);
    if (cldata_feed_unit(part.word, inches_)) {
      const auto number = number_behind(part);
      if (number) set_feed(part, *number);
      return;
    }
    if (part.word == "RTRCTO" && place_ < given_.size() && given_[place_].word == "AUTO") {
      ++place_;
      back_to_start_ = true;
      return;
    }
    if (part.word == "LEAD" || part.word == "PITCH" || part.word == "TPI") {
      feed_ = number_behind(part);
      per_revolution_ = true;
      if (part.word == "TPI" && feed_) {
        feed_->number = (inches_ ? 1.0 : kMmPerInch) / feed_->number;
      }
      return;
    }
    if (std::find(kRemarks.begin(), kRemarks.end(), part.word) != kRemarks.end()) {
      std::string text = part.word;
      floats_ = floats_ || text == "FLOAT";
      if (place_ < given_.size() && given_[place_].is_number() &&
          (part.word == "CAM" || part.word == "ORIENT" || part.word == "DIAMTR" ||
           part.word == "TLANGL")) {
        text += "," + shortest_decimal(given_[place_++].number);
      }
      remarks_ += (remarks_.empty() ? "" : ",") + text;
      return;
    }
    if (part.word == "DWELL" && place_ < given_.size() && given_[place_].word == "REV") {
      ++place_;
      dwell_ = number_behind(part);
      if (dwell_ && modes_.speed > 0.0) {
        dwell_->number *= kSecondsPerMinute / modes_.speed;
        return;
      }
      return fail("dwell-without-speed"_id, part.column,
                  "a dwell in revolutions with no spindle speed");
    }
    struct Slot {
      std::string_view word;
      std::optional<Value> CycleReader::*value;
    };
    constexpr std::array kSlots{
        Slot{"DEPTH", &CycleReader::depth_},  Slot{"FEDTO", &CycleReader::feed_to_},
        Slot{"CLEAR", &CycleReader::clear_},  Slot{"RAPTO", &CycleReader::rapid_to_},
        Slot{"RTRCTO", &CycleReader::back_},  Slot{"RETURN", &CycleReader::back_},
        Slot{"STEP", &CycleReader::step_},    Slot{"INCR", &CycleReader::step_},
        Slot{"1STPECK", &CycleReader::step_}, Slot{"SUBPECK", &CycleReader::others_},
        Slot{"DWELL", &CycleReader::dwell_}};
    const auto* slot = std::find_if(kSlots.begin(), kSlots.end(),
                                    [&](const Slot& known) { return known.word == part.word; });
    if (slot == kSlots.end())
      return fail("unknown-word"_id, part.column, part.word + " has no meaning in CYCLE");
    this->*slot->value = number_behind(part);
    if (slot->value == &CycleReader::step_) take_further_steps();
    // RTRCTO,20,MANUAL
    if (part.word == "RTRCTO" && place_ < given_.size() && given_[place_].word == "MANUAL") {
      ++place_;
    }
  }

  // STEP,5,5: of each peck. Beside words alone (CYCLE/DEEP,9,INCR,5,100,MMPM,3) the number before a
  // unit is the feed.
  void take_further_steps() {
    const bool worded = std::any_of(given_.begin(), given_.end(), [](const CldataArgument& part) {
      return part.word == "DEPTH" || part.word == "FEDTO";
    });
    while (!in_.failed() && place_ < given_.size() && given_[place_].is_number()) {
      const bool feed = !worded && place_ + 1 < given_.size() &&
                        cldata_feed_unit(given_[place_ + 1].word, inches_);
      if (feed) return;
      const CldataArgument& further = given_[place_++];
      if (further.number == step_->number) continue;
      in_.fail("not-supported"_id, further.column,
               "CYCLE with a step of its own for each peck is not simulated",
               "give one STEP, or write the cycle out as GOTO records");
    }
  }

  // Numbers without a word: depth, feed, clearance.
  void take_bare(const CldataArgument& part) {
    if (!depth_ && !feed_to_) {
      depth_ = Value{part.column, part.number};
    } else if (place_ < given_.size() && !feed_ && cldata_feed_unit(given_[place_].word, inches_)) {
      set_feed(given_[place_++], Value{part.column, part.number});
    } else if (!clear_ && (feed_ || place_ == given_.size() || !given_[place_].is_number())) {
      clear_ = Value{part.column, part.number};
      clear_is_bare_ = !feed_;
    } else {
      fail("unknown-word"_id, part.column,
           fmt::format("the {} in CYCLE could mean many things", part.number));
    }
  }

  std::optional<Value> number_behind(const CldataArgument& part) {
    if (place_ >= given_.size() || !given_[place_].is_number()) {
      fail("value-missing"_id, part.column, part.word + " has no number");
      return std::nullopt;
    }
    const CldataArgument& number = given_[place_++];
    return Value{number.column, number.number};
  }

  void set_feed(const CldataArgument& unit, Value number) {
    const CldataFeedUnit meaning = *cldata_feed_unit(unit.word, inches_);
    if (feed_) return fail("word-twice"_id, unit.column, "CYCLE has two feeds");
    feed_ = Value{number.column, number.number * meaning.scale};
    per_revolution_ = meaning.per_revolution;
  }

  void add_words(Block& block) {
    if (!depth_ && !feed_to_) return fail("value-missing"_id, record_.column, "CYCLE has no depth");
    if (!feed_) take_feed_in_force(block);
    if (!clear_ && !rapid_to_)
      return fail("value-missing"_id, record_.column, "CYCLE has no clearance");
    if (name_->steps && !step_) {
      step_ = Value{record_.column, feed_to_ ? std::abs(feed_to_->number) : depth_->number};
      step_->number += std::abs(clear_ ? clear_->number : rapid_to_->number);
      if (step_->number == 0.0) step_->number = 1.0;
      block.comments.push_back({record_.column, false, "no step is given: the hole is one peck",
                                "CYCLE STEP", false, true});
    }
    if (name_->steps && step_->number <= 0.0) {
      return fail("out-of-range"_id, record_.column, "CYCLE has no STEP above zero");
    }
    if (others_ && (name_->code != "CYCLE/DEEP2" || others_->number <= 0.0)) {
      return fail("out-of-range"_id, others_->column, "SUBPECK belongs to DEEP2, above zero");
    }
    if (step_ && !name_->steps) {
      return fail("unknown-word"_id, step_->column,
                  fmt::format("STEP has no meaning in {}", name_->code));
    }
    const Value depth = feed_to_ ? Value{feed_to_->column, std::abs(feed_to_->number)} : *depth_;
    // FEDTO,0: to the place that GOTO names.
    if (depth.number < 0.0 || (depth.number == 0.0 && !feed_to_))
      return fail("out-of-range"_id, depth.column, "the depth of CYCLE is not above zero");
    const bool is_height = feed_to_ || !clear_;
    const Value clear = clear_ ? *clear_ : *rapid_to_;
    Value level = clear;
    if (rapid_to_) level = *rapid_to_;
    if (rapid_to_ && !is_height) level.number = clear.number - rapid_to_->number;
    const double highest = std::max(clear.number, level.number);
    if (level.number <= -depth.number) {
      return fail("cycle-levels"_id, level.column,
                  "CYCLE goes by rapid to below the bottom of the hole");
    }
    add_code(block, *find_code(Dialect::cldata, name_->code), record_.column);
    add_number(block, 'Z', depth.number, depth.column, "depth ");
    add_number(block, 'R', level.number, level.column, "RAPTO,");
    add_number(block, 'u', highest, clear.column, "CLEAR,");
    // The lead of a tap, but in a floating chuck, which is fed.
    const bool leads = per_revolution_ && name_->code == "CYCLE/TAP" && !floats_;
    add_number(block,
               leads             ? 't'
               : per_revolution_ ? 'r'
                                 : 'f',
               feed_->number, feed_->column, leads ? "lead " : "feed ");
    if (back_ && back_->number == 0.0) back_to_start_ = true;
    if (back_to_start_) {
      add_number(block, 'I', 1.0, record_.column);
    } else if (back_) {
      add_number(block, 'v', back_->number, back_->column, "RETURN,");
    }
    if (step_) add_number(block, 'Q', step_->number, step_->column, "STEP,");
    if (others_) add_number(block, 'x', others_->number, others_->column, "SUBPECK,");
    if (dwell_) add_number(block, 'P', dwell_->number, dwell_->column, "DWELL,");
    if (clear_is_bare_) {
      block.comments.push_back({clear_->column, false, "the second number is the clearance",
                                "CYCLE numbers", false, true});
    }
    if (!remarks_.empty()) {
      block.comments.push_back({record_.column, false, remarks_, "CYCLE option"});
    }
  }

  // That of FEDRAT; without one it changes the time, not the path.
  void take_feed_in_force(Block& block) {
    constexpr double kFeed = 1000.0;  // mm/min
    feed_ = Value{record_.column, modes_.feed};
    per_revolution_ = modes_.feed_per_revolution;
    if (modes_.feed_given) return;
    feed_->number = inches_ ? kFeed / kMmPerInch : kFeed;
    per_revolution_ = false;
    block.comments.push_back({record_.column, false, "no feed is given for the cycle: 1000 mm/min",
                              "CYCLE", false, true});
  }

  LineScanner& in_;
  const CldataRecord& record_;
  const std::vector<CldataArgument>& given_;
  const CldataModes& modes_;
  bool inches_;
  const CycleName* name_ = nullptr;
  std::size_t place_ = 0;
  std::optional<Value> depth_{};
  std::optional<Value> feed_to_{};
  std::optional<Value> feed_{};
  std::optional<Value> clear_{};
  std::optional<Value> rapid_to_{};
  std::optional<Value> back_{};
  std::optional<Value> step_{};
  std::optional<Value> others_{};  // each peck after the first
  bool clear_is_bare_ = false;     // CYCLE/TAP,50,1
  std::string remarks_{};
  std::optional<Value> dwell_{};
  bool per_revolution_ = false;
  bool floats_ = false;
  bool back_to_start_ = false;
};

}  // namespace

void read_cldata_cycle(LineScanner& in, const CldataRecord& record, const CldataModes& modes,
                       Block& block) {
  CycleReader(in, record, modes)(block);
}

}  // namespace frustum::parser
