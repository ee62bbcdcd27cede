// APT CLDATA as CAM systems write it: a record a line, its word, / and its arguments.
//
// RAPID and CIRCLE speak about the GOTO after them, so the reader keeps them until then.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "parser/dialects/code_table.hpp"
#include "parser/motion.hpp"
#include "parser/reading/block_draft.hpp"
#include "parser/reading/block_reader.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {
namespace {

// Records that are text to their end, and those whose arguments change nothing that is simulated.
constexpr std::array<const char*, 3> kTexts{"PARTNO", "PPRINT", "INSERT"};
constexpr std::array<const char*, 19> kEvents{"CUTTER", "TOOLNO", "MACHIN", "INTOL",  "OUTTOL",
                                              "TOLER",  "TPRINT", "LEADER", "OPNAME", "SELECT",
                                              "PLABEL", "LINTOL", "SEQNO",  "TLDATA", "MSYS",
                                              "PAINT",  "CLDIST", "CLEARP", "AUXFUN"};
constexpr std::array kPositionWords{'X', 'Y', 'Z', 'a', 'b', 'c'};
constexpr std::array kVectorNames{"", "", "", "i ", "j ", "k "};

struct Argument {
  std::uint32_t column = 0;
  std::string word{};  // empty for a number
  double number = 0.0;
};

struct Circle {
  std::uint32_t line = 0;
  Vec3 centre = Vec3::Zero();
  Plane plane = Plane::xy;
  bool counterclockwise = true;
};

// What the records before have said about the GOTO to come.
struct Pending {
  bool rapid = false;
  bool multax = false;
  bool feed_per_revolution = false;
  bool inches = false;
  std::optional<Circle> circle{};
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
  bool take_comment() {
    const std::uint32_t column = in_.column();
    if (!in_.take('$')) return in_.failed();
    if (!in_.take('$')) {
      in_.fail(column, "nothing follows the continuation mark",
               "$ continues a record on the next line, $$ begins a comment");
      return true;
    }
    block_.comments.push_back({column, true, in_.text_to(), nullptr});
    return true;
  }

  void read_record() {
    column_ = in_.column();
    name_ = in_.name();
    if (name_.empty()) return in_.fail_unexpected("a record is a word, / and its arguments");
    for (const char* text : kTexts) {
      // The word may run into its text: PARTNOFLANGE.
      if (name_.starts_with(text)) {
        in_.go_to(column_ + 6);
        in_.take('/');
        block_.comments.push_back(
            {column_, false, in_.text_to(), text == kTexts[1] ? "message" : text});
        return;
      }
    }
    if (name_ == "TOOL" && in_.take_name("PATH")) return note("TOOL PATH");
    if (name_ == "END" && in_.peek() == '-') return note("END-OF-PATH");
    for (const char* event : kEvents) {
      if (name_ == event) return note(event);
    }
    if (const auto remedy = remedy_for(Dialect::cldata, name_); !remedy.empty()) {
      if (name_ == "CUTCOM" && in_.take('/') && in_.take_name("OFF")) return note("CUTCOM");
      return in_.fail(column_, name_ + " is not simulated", std::string(remedy));
    }
    if (in_.take('/')) read_arguments();
    if (!take_comment() && !in_.at_end()) in_.fail_unexpected("separate arguments by ,");
    if (!in_.failed()) read_known();
  }

  void note(const char* event) {
    in_.take('/');
    block_.comments.push_back({column_, false, in_.text_to("$"), event});
    if (!take_comment() && !in_.at_end()) in_.fail_unexpected("separate arguments by ,");
  }

  void read_arguments() {
    do {
      Argument argument{in_.column(), in_.name(), 0.0};
      if (argument.word.empty()) argument.number = read_number(argument.column);
      arguments_.push_back(std::move(argument));
    } while (in_.take(','));
  }

  double read_number(std::uint32_t column) {
    const bool negative = in_.take('-');
    if (!negative) in_.take('+');
    const auto found = in_.number();
    if (!found) {
      in_.fail(column, "an argument is missing", "write the arguments after /, separated by ,");
      return 0.0;
    }
    double value = found->value;
    if (in_.peek_byte() == 'E') {
      in_.take('E');
      const double exponent = in_.signed_number("the exponent", column);
      value *= std::pow(10.0, exponent);
      if (!std::isfinite(value)) in_.fail(column, "the number is too large", "check its exponent");
    }
    return (negative ? -value : value) + 0.0;
  }

  void read_known() {
    const bool needs_end = name_ == "CIRCLE" || name_ == "GODLTA" || name_ == "FROM" ||
                           name_ == "END" || name_ == "FINI";
    if (pending_.circle && needs_end) {
      return in_.fail(column_,
                      fmt::format("the CIRCLE on line {} has no GOTO", pending_.circle->line),
                      "give the end of the arc by GOTO");
    }
    if (name_ == "GOTO") return read_goto();
    if (name_ == "GODLTA") return read_increment();
    if (name_ == "CIRCLE") return read_circle();
    if (name_ == "FROM") return add_position("FROM");
    if (name_ == "FEDRAT") return read_feed();
    if (name_ == "SPINDL") return read_spindle();
    if (name_ == "LOADTL") return read_tool();
    if (name_ == "UNITS") return read_units();
    if (name_ == "MULTAX") return read_multax();
    if (name_ == "COOLNT") return read_coolant();
    if (name_ == "DELAY") return read_delay();
    if (name_ == "RAPID") {
      pending_.rapid = true;
      return take_no_arguments();
    }
    if (find_code(Dialect::cldata, name_) != nullptr) {
      add(name_);
      return take_no_arguments();
    }
    in_.fail(column_, "unknown record " + name_,
             "known are PARTNO UNITS CUTTER LOADTL SPINDL COOLNT FEDRAT RAPID FROM GOTO GODLTA "
             "CIRCLE MULTAX GOHOME DELAY PPRINT STOP OPSTOP END FINI");
  }

  void take_no_arguments() {
    if (!arguments_.empty()) {
      in_.fail(arguments_.front().column, name_ + " takes no arguments",
               fmt::format("write {} alone", name_));
    }
  }

  // The arguments as numbers, when there are as many as `counts` says.
  bool are_numbers(std::initializer_list<std::size_t> counts, const char* remedy) {
    for (const Argument& argument : arguments_) {
      if (argument.word.empty()) continue;
      in_.fail(argument.column, fmt::format("{} has no meaning in {}", argument.word, name_),
               remedy);
      return false;
    }
    for (const std::size_t count : counts) {
      if (arguments_.size() == count) return true;
    }
    in_.fail(column_, fmt::format("{} with {} numbers", name_, arguments_.size()), remedy);
    return false;
  }

  void add(std::string_view code) { add_code(block_, *find_code(Dialect::cldata, code), column_); }

  void add_position(std::string_view code) {
    if (!are_numbers({3, 6}, "give x,y,z or x,y,z,i,j,k")) return;
    // A vector along Z says nothing new where the tool does not tilt.
    const bool upright = arguments_.size() == 6 && arguments_[3].number == 0.0 &&
                         arguments_[4].number == 0.0 && arguments_[5].number > 0.0;
    const std::size_t count = upright && !pending_.multax ? 3 : arguments_.size();
    add(code);
    for (std::size_t i = 0; i < count; ++i) {
      add_number(block_, kPositionWords.at(i), arguments_[i].number, arguments_[i].column,
                 i < 3 ? nullptr : kVectorNames.at(i));
    }
  }

  void read_goto() {
    if (!pending_.circle) {
      add_position(pending_.rapid ? "RAPID GOTO" : "GOTO");
      pending_.rapid = false;
      return;
    }
    const Circle circle = *pending_.circle;
    pending_.circle.reset();
    pending_.rapid = false;
    add_position(circle.counterclockwise ? "CIRCLE+" : "CIRCLE-");
    if (in_.failed()) return;
    constexpr std::array kPlanes{"plane XY", "plane ZX", "plane YZ"};
    add(kPlanes.at(static_cast<std::size_t>(circle.plane)));
    const auto normal = static_cast<Eigen::Index>(circle.plane == Plane::xy   ? 2
                                                  : circle.plane == Plane::zx ? 1
                                                                              : 0);
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (i == normal) continue;
      add_number(block_, "IJK"[i], circle.centre[i], column_);
      block_.words.back().measure = Measure::absolute;
    }
  }

  void read_increment() {
    if (!are_numbers({3}, "give dx,dy,dz")) return;
    add(pending_.rapid ? "RAPID GODLTA" : "GODLTA");
    pending_.rapid = false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (arguments_[i].number == 0.0) continue;
      add_number(block_, kPositionWords.at(i), arguments_[i].number, arguments_[i].column);
      block_.words.back().measure = Measure::incremental;
    }
  }

  void read_circle() {
    for (const Argument& argument : arguments_) {
      if (!argument.word.empty()) {
        return in_.fail(argument.column, argument.word + " has no meaning in CIRCLE",
                        "give the centre x,y,z, the axis i,j,k and the radius");
      }
    }
    if (arguments_.size() < 7) {
      return in_.fail(column_, fmt::format("CIRCLE with {} numbers", arguments_.size()),
                      "give the centre x,y,z, the axis i,j,k and the radius");
    }
    Circle circle;
    circle.line = block_.line;
    for (std::size_t i = 0; i < 3; ++i) {
      circle.centre[static_cast<Eigen::Index>(i)] = arguments_[i].number;
    }
    const Vec3 axis(arguments_[3].number, arguments_[4].number, arguments_[5].number);
    Eigen::Index along = 0;
    axis.cwiseAbs().maxCoeff(&along);
    // CAM systems write six decimals.
    constexpr double kAlongAnAxis = 1e-5;
    if (std::abs(std::abs(axis[along]) - 1.0) > kAlongAnAxis ||
        std::abs(axis.norm() - 1.0) > kAlongAnAxis) {
      return in_.fail(arguments_[3].column, "the circle does not lie in a plane of X, Y, Z",
                      "give an axis i,j,k along X, Y or Z, or write the arc as GOTO records");
    }
    circle.plane = along == 2 ? Plane::xy : along == 1 ? Plane::zx : Plane::yz;
    circle.counterclockwise = axis[along] > 0.0;
    pending_.circle = circle;
  }

  void read_feed() {
    if (arguments_.empty()) return in_.fail(column_, "FEDRAT has no feed", "write FEDRAT/500,MMPM");
    const bool word_first = !arguments_.front().word.empty();
    const Argument* number = nullptr;
    std::string unit;
    for (const Argument& argument : arguments_) {
      if (argument.word.empty() && number == nullptr) {
        number = &argument;
      } else if (!argument.word.empty() && unit.empty()) {
        unit = argument.word;
      } else {
        return in_.fail(argument.column, "FEDRAT has more than a feed and its unit",
                        "write FEDRAT/500,MMPM");
      }
    }
    if (number == nullptr) {
      return in_.fail(column_, "FEDRAT has no feed", "write FEDRAT/500,MMPM");
    }
    const std::uint32_t unit_column = arguments_[word_first ? 0 : arguments_.size() - 1].column;
    if (unit == "MMPM" || unit == "IPM" || unit == "PERMIN") {
      pending_.feed_per_revolution = false;
    } else if (unit == "MMPR" || unit == "IPR" || unit == "PERREV") {
      pending_.feed_per_revolution = true;
    } else if (!unit.empty()) {
      return in_.fail(unit_column, fmt::format("{} has no meaning in FEDRAT", unit),
                      "units are MMPM, MMPR, IPM and IPR");
    }
    const bool inches = unit.starts_with('I');
    if (unit.starts_with('I') != pending_.inches && !unit.empty() && !unit.starts_with('P')) {
      return in_.fail(unit_column,
                      fmt::format("{} in a file in {}", unit, inches ? "millimetres" : "inches"),
                      "give feeds in the unit of UNITS");
    }
    add(pending_.feed_per_revolution ? "FEDRAT/MMPR" : "FEDRAT/MMPM");
    add_number(block_, 'F', number->number, number->column);
  }

  void read_spindle() {
    std::string direction = "CLW";
    for (const Argument& argument : arguments_) {
      if (argument.word.empty()) {
        add_number(block_, 'S', argument.number, argument.column);
      } else if (argument.word == "CLW" || argument.word == "CCLW" || argument.word == "OFF") {
        direction = argument.word;
      } else if (argument.word != "RPM" && argument.word != "ON") {
        return in_.fail(argument.column, argument.word + " has no meaning in SPINDL",
                        "write SPINDL/RPM,5000,CLW or SPINDL/OFF");
      }
    }
    if (arguments_.empty()) {
      return in_.fail(column_, "SPINDL says nothing", "write SPINDL/RPM,5000,CLW or SPINDL/OFF");
    }
    add("SPINDL/" + direction);
  }

  void read_tool() {
    if (arguments_.empty() || !arguments_.front().word.empty()) {
      return in_.fail(column_, "LOADTL has no number", "write LOADTL/1");
    }
    add("LOADTL");
    add_number(block_, 'T', arguments_.front().number, arguments_.front().column, "tool ");
    if (arguments_.size() == 1) return;
    // ADJUST, LENGTH and the like: the tool's true size is in the job.
    std::string rest;
    for (std::size_t i = 1; i < arguments_.size(); ++i) {
      rest += (rest.empty() ? "" : ",") + (arguments_[i].word.empty()
                                               ? fmt::format("{}", arguments_[i].number)
                                               : arguments_[i].word);
    }
    block_.comments.push_back({arguments_[1].column, false, std::move(rest), "LOADTL"});
  }

  [[nodiscard]] std::string only_word() const {
    return arguments_.size() == 1 ? arguments_.front().word : std::string();
  }

  void read_units() {
    const std::string unit = only_word();
    const bool metric = unit == "MM";
    if (!metric && unit != "INCHES" && unit != "INCH") {
      return in_.fail(column_, "UNITS without MM or INCHES", "write UNITS/MM or UNITS/INCHES");
    }
    pending_.inches = !metric;
    add(metric ? "UNITS/MM" : "UNITS/INCHES");
  }

  void read_multax() {
    const std::string state = only_word();
    if (!arguments_.empty() && state != "ON" && state != "OFF") {
      return in_.fail(column_, "MULTAX without ON or OFF", "write MULTAX/ON or MULTAX/OFF");
    }
    pending_.multax = state != "OFF";
    add(pending_.multax ? "MULTAX/ON" : "MULTAX/OFF");
  }

  void read_coolant() {
    const std::string state = only_word();
    if (state == "ON" || state == "FLOOD") return add("COOLNT/ON");
    if (state == "OFF") return add("COOLNT/OFF");
    if (state == "MIST" || state == "THRU" || state == "AIR" || state == "TAP") {
      block_.comments.push_back({column_, false, state, "COOLNT"});
      return;
    }
    in_.fail(column_, "COOLNT says nothing that is known", "write COOLNT/ON, FLOOD, MIST or OFF");
  }

  void read_delay() {
    const bool turns = arguments_.size() == 2 && arguments_[1].word == "REV";
    const bool seconds = arguments_.size() == 1;
    if ((!turns && !seconds) || !arguments_.front().word.empty()) {
      return in_.fail(column_, "DELAY without a time", "write DELAY/2 (seconds) or DELAY/3,REV");
    }
    add(turns ? "DELAY REV" : "DELAY");
    add_number(block_, turns ? 'S' : 'P', arguments_[0].number, arguments_[0].column, "DELAY/");
  }

  LineScanner in_;
  Pending& pending_;
  Block block_;
  std::uint32_t column_ = 0;  // of the record's word
  std::string name_;
  std::vector<Argument> arguments_;
};

}  // namespace

BlockReader cldata_reader() {
  return [pending = Pending{}](std::string_view text, std::uint32_t line) mutable {
    return CldataReader(text, line, pending)();
  };
}

}  // namespace frustum::parser
