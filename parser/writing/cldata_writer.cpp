// APT CLDATA: a record a line, and before a GOTO the RAPID or MOVARC that speaks about it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/decimal.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "parser/writing/block_parts.hpp"
#include "parser/writing/block_writer.hpp"

namespace frustum::parser {
namespace {

constexpr double kNoTurn = 1e-6;  // full turns: rounding of the points

// The words of a hole cycle, as records name them.
struct CycleWord {
  char letter;
  std::string_view written;
};
constexpr std::array kCycleWords{
    CycleWord{'Z', "FEDTO"},       CycleWord{'R', "RAPTO"},  CycleWord{'u', "CLEAR"},
    CycleWord{'f', "PERMIN"},      CycleWord{'r', "PERREV"}, CycleWord{'t', "LEAD"},
    CycleWord{'I', "RTRCTO,AUTO"}, CycleWord{'v', "RTRCTO"}, CycleWord{'Q', "STEP"},
    CycleWord{'x', "SUBPECK"},     CycleWord{'P', "DWELL"}};

// What records are written by: the unit, whether TLAXIS was given, the last place.
struct Pen {
  bool inches = false;
  bool tool_axis = false;
  std::optional<Vec3> at{};
  std::string vector{};  // the last one written
};

class RecordWriter {
 public:
  RecordWriter(const Block& block, Pen& pen) : block_(block), pen_(pen) {
    // Beside a move, what its reader has added to it is not written.
    for (const Word& word : block.words) {
      const std::string_view name = named_word(word);
      const bool added = name_ == "MULTAX/ON" || (name_.starts_with("FEDRAT/") && !name.empty());
      if (name_.empty() || (added && !name.empty())) name_ = name;
    }
  }

  [[nodiscard]] std::string operator()() {
    std::string text = label() + record();
    // Behind a record, what it said that is not simulated.
    for (const Comment& comment : block_.comments) {
      if (comment.event == nullptr || comment.assumed || is_label(comment)) continue;
      const std::string_view event = comment.event;
      if (event == "TLAXIS" || event == "CSYS") pen_.tool_axis = true;
      text += name_.empty() ? event_text(comment) : "," + comment.text;
    }
    for (const Comment& comment : block_.comments) {
      if (comment.event == nullptr) text += (text.empty() ? "$$ " : " $$ ") + comment.text;
    }
    return text;
  }

 private:
  static bool is_label(const Comment& comment) {
    return comment.event != nullptr && std::string_view(comment.event) == "label";
  }
  static std::string event_text(const Comment& comment) {
    const std::string_view event = comment.event;
    if (event == "END-OF-PATH") return "END" + comment.text;
    if (event == "post word") return comment.text;
    return fmt::format("{}/{}", event == "message" ? "PPRINT" : event, comment.text);
  }

  // A)
  [[nodiscard]] std::string label() const {
    const auto found = std::ranges::find_if(block_.comments, is_label);
    return found == block_.comments.end() ? "" : found->text + ")";
  }

  [[nodiscard]] std::string record() {
    const bool rapid = name_.starts_with("RAPID ");
    const std::string_view place = rapid ? name_.substr(6) : name_;
    if (place == "GOTO" || place == "FROM") return moved(rapid, place, take_position());
    if (place == "GODLTA") return moved(rapid, place, take_step());
    if (name_.starts_with("CIRCLE")) {
      const std::string arc = circle();
      return arc + "\nGOTO/" + take_position();
    }
    if (name_ == "NURBS") {
      const std::string ways = fmt::format("CNTRL/{}\nCNTRL/{}\n", numbers("IJK"), numbers("uvw"));
      pen_.at = point();
      return "NURBS/\nKNOT/1\n" + ways + "CNTRL/" + numbers("XYZ");
    }
    if (name_.starts_with("UNITS/")) take_unit();
    if (name_ == "MULTAX/OFF") pen_.vector.clear();
    if (name_ == "GOHOME") pen_.at.reset();
    if (name_.starts_with("FEDRAT")) {
      return fmt::format("FEDRAT/{},{}", numbers("F"),
                         name_.ends_with("MMPR") ? "PERREV" : "PERMIN");
    }
    if (name_.starts_with("SPINDL/")) {
      const std::string speeds = numbers("S");
      return fmt::format("SPINDL/{}{}{}", speeds, speeds.empty() ? "" : ",", name_.substr(7));
    }
    if (name_ == "LOADTL") return "LOADTL/" + numbers("T");
    if (name_ == "DELAY") return "DELAY/" + numbers("P");
    if (name_ == "DELAY REV") return fmt::format("DELAY/{},REV", numbers("S"));
    if (name_.starts_with("CYCLE/")) return cycle();
    return std::string(name_);
  }

  static std::string moved(bool rapid, std::string_view word, const std::string& numbers) {
    return fmt::format("{}{}/{}", rapid ? "RAPID\n" : "", word, numbers);
  }

  // The numbers of these letters in the order of the words.
  [[nodiscard]] std::string numbers(std::string_view letters) const {
    std::string text;
    for (const Word& word : block_.words) {
      const bool wanted = letters.find(word.letter) != std::string_view::npos;
      if (wanted) text += (text.empty() ? "" : ",") + shortest_decimal(word.number);
    }
    return text;
  }
  [[nodiscard]] double number(char letter) const {
    const auto found = std::ranges::find(block_.words, letter, &Word::letter);
    return found == block_.words.end() ? 0.0 : found->number;
  }
  [[nodiscard]] bool has(char letter) const {
    return std::ranges::find(block_.words, letter, &Word::letter) != block_.words.end();
  }
  [[nodiscard]] Vec3 point() const { return {number('X'), number('Y'), number('Z')}; }

  [[nodiscard]] std::string take_position() {
    pen_.at = point();
    if (has('c')) pen_.vector = numbers("abc");
    if (has('c') || !pen_.tool_axis) return numbers("XYZabc");
    // Without a vector of its own the place would have that of TLAXIS. On an arc the tool stays as
    // it is; elsewhere it is upright.
    const bool stays = name_.starts_with("CIRCLE") && !pen_.vector.empty();
    return numbers("XYZ") + "," + (stays ? pen_.vector : "0,0,1");
  }
  // Steps of zero are no words.
  [[nodiscard]] std::string take_step() {
    if (pen_.at) *pen_.at += point();
    return fmt::format("{},{},{}", shortest_decimal(number('X')), shortest_decimal(number('Y')),
                       shortest_decimal(number('Z')));
  }
  void take_unit() {
    const bool inches = name_ == "UNITS/INCHES";
    if (inches != pen_.inches) pen_.at.reset();
    pen_.inches = inches;
  }

  // In a plane its centre has words there alone, so that the axis is the letter without one; in
  // space u v w are the axis. The angle tells full turns from none.
  [[nodiscard]] std::string circle() const {
    constexpr std::string_view kCentre = "IJK";
    Vec3 centre = Vec3::Zero();
    Vec3 axis{number('u'), number('v'), number('w')};
    for (std::size_t i = 0; i < kCentre.size(); ++i) {
      const auto slot = static_cast<Eigen::Index>(i);
      centre[slot] = number(kCentre[i]);
      if (!has(kCentre[i])) axis[slot] = name_ == "CIRCLE+" ? 1.0 : -1.0;
    }
    const auto list = [](const Vec3& v) {
      return fmt::format("{},{},{}", shortest_decimal(v[0]), shortest_decimal(v[1]),
                         shortest_decimal(v[2]));
    };
    const std::string extent =
        is_assumed("CIRCLE TIMES")
            ? "TIMES," + shortest_decimal(has('P') ? number('P') : 1.0)
            : "ANGLE," + shortest_decimal(kDegreesPerTurn * turns(centre, axis));
    return fmt::format("MOVARC/{},{},0,{}", list(centre), list(axis), extent);
  }

  // Full turns of the arc, the last one from the angle between its ends.
  [[nodiscard]] double turns(const Vec3& centre, const Vec3& axis) const {
    if (!pen_.at) return 1.0;
    const auto arm = [&](const Vec3& place) -> Vec3 {
      const Vec3 from_centre = place - centre;
      return from_centre - axis * from_centre.dot(axis);
    };
    const Vec3 from = arm(*pen_.at);
    const Vec3 to = arm(point());
    double part = std::atan2(axis.dot(from.cross(to)), from.dot(to)) / (2.0 * std::numbers::pi);
    if (part <= kNoTurn) part += 1.0;
    return part + (has('P') ? number('P') - 1.0 : 0.0);
  }

  [[nodiscard]] bool is_assumed(std::string_view name) const {
    return std::ranges::any_of(block_.comments, [name](const Comment& comment) {
      return comment.assumed && comment.event == name;
    });
  }

  // What its reader had to assume is not written.
  [[nodiscard]] std::string cycle() const {
    std::string text(name_);
    std::string left_out;
    if (is_assumed("CYCLE")) left_out += "fr";
    if (is_assumed("CYCLE STEP")) left_out += "Q";
    if (is_assumed("CYCLE numbers")) {
      left_out += "ZRufrt";
      text += fmt::format(",{},{}", shortest_decimal(number('Z')), shortest_decimal(number('u')));
    }
    for (const Word& word : block_.words) {
      const auto* written = std::ranges::find(kCycleWords, word.letter, &CycleWord::letter);
      if (written == kCycleWords.end() || left_out.find(word.letter) != std::string::npos) continue;
      text += fmt::format(",{}", written->written);
      if (word.letter != 'I') text += "," + shortest_decimal(word.number);
    }
    if (name_ == "CYCLE/TAP" && has('r')) text += ",FLOAT";
    return text;
  }

  static constexpr double kDegreesPerTurn = 360.0;

  const Block& block_;
  Pen& pen_;
  std::string_view name_{};
};

}  // namespace

BlockWriter cldata_writer() {
  return [pen = Pen{}](const Block& block) mutable { return RecordWriter(block, pen)(); };
}

}  // namespace frustum::parser
