#include "post/nc_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "core/units.hpp"
#include "parser/arc.hpp"
#include "post/nc_spelling.hpp"

namespace frustum::post {
namespace {

using parser::AxisLetter;
using parser::AxisTarget;
using parser::Feed;
using parser::FeedMode;
using parser::LengthCompensation;
using parser::Motion;

template <typename Enum>
constexpr std::size_t index_of(Enum value) {
  return static_cast<std::size_t>(value);
}

std::string filled(std::string_view pattern, char hole, std::string_view with) {
  std::string text;
  for (const char c : pattern) {
    if (c == hole) {
      text += with;
    } else {
      text += c;
    }
  }
  return text;
}

class NcWriter {
 public:
  NcWriter(const NcSpelling& spelling, const WriterOptions& options)
      : spelling_(spelling), options_(options) {}

  Result<NcProgram> write(std::span<const Motion> motions) {
    lines(filled(spelling_.header, '$', as_comment(options_.name)));
    for (std::size_t i = 0; i < motions.size(); ++i) {
      rest_ = motions.subspan(i + 1);
      place_ = motions[i].place;
      std::visit([this](const auto& command) { write(command); }, motions[i].command);
    }
    place_ = {};
    lines(filled(spelling_.footer, '$', as_comment(options_.name)));
    if (!problems_.empty()) return problems_;
    return std::move(program_);
  }

 private:
  // --- motions --------------------------------------------------------------------------------

  void write(const parser::Traverse& move) {
    straight(move.end, move.tool_axis, move.coordinates, nullptr);
  }
  void write(const parser::LinearFeed& move) {
    straight(move.end, move.tool_axis, move.coordinates, &move.feed);
  }

  void write(const parser::Probe& /*probe*/) {
    refuse("a probing move", "leave the blocks that probe out");
  }

  void write(const parser::HomeReturn& home) {
    if (spelling_.home_return.empty()) {
      refuse("the return to home (G28)", "give the position in machine coordinates");
      return;
    }
    if (home.point != 1) {
      refuse("the return to another reference point than home (G30)",
             "give the position in machine coordinates");
      return;
    }
    std::string block(spelling_.home_return);
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (home.axes.at(index_of(letter))) block += fmt::format(" {}0", parser::to_char(letter));
    }
    line(block);
    line("G90");  // home is written incrementally: straight there
    forget_positions();
  }

  void write(const parser::ArcFeed& arc) {
    const parser::PlaneAxes axes = parser::axes_of(arc.plane);
    const auto u = static_cast<AxisLetter>(axes.u), v = static_cast<AxisLetter>(axes.v);
    if (!known_[index_of(u)] || !known_[index_of(v)]) {
      refuse("an arc whose start is not known", "move to its start with a straight line first");
      return;
    }
    const int turns = std::abs(arc.turns);
    if (turns > 1 && spelling_.full_turns.empty()) {
      refuse("an arc of more than one turn", "linearise arcs, or write the turns one by one");
      return;
    }
    if (spelling_.circle_centre_block && !flat_in_xy(arc)) {
      refuse("an arc that is not flat in X and Y", "linearise arcs");
      return;
    }
    if (!plane_ || *plane_ != arc.plane) {
      if (!spelling_.planes.at(index_of(arc.plane)).empty()) {
        line(spelling_.planes.at(index_of(arc.plane)));
      }
      plane_ = arc.plane;
    }
    std::string block(arc.turns > 0 ? spelling_.counterclockwise : spelling_.clockwise);
    const std::string centre = centre_words(arc, axes);
    if (spelling_.circle_centre_block) line("CC" + centre);
    const bool vectors = arc.tool_axis.has_value();
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (!arc.end[letter] || (vectors && parser::is_rotary(letter))) continue;
      const bool in_plane = letter == u || letter == v;
      block += axis_word(letter, *arc.end[letter], in_plane);
    }
    const std::string vector_before = vector_text_;
    const std::string vector = vector_words(arc.tool_axis);
    if (spelling_.vectors_on_arcs) {
      block += vector;
    } else if (vector != vector_before) {
      refuse("a tool vector on an arc", "turn the tool before the arc");
    }
    if (!spelling_.circle_centre_block) block += centre;
    if (turns > 1) {
      block += " " +
               filled(spelling_.full_turns, '#', fmt::format("{}", turns - spelling_.turns_beyond));
    }
    if (spelling_.circle_centre_block) block += arc.turns > 0 ? " DR+" : " DR-";
    block += feed_words(arc.feed);
    motion_word_ = arc.turns > 0 ? spelling_.counterclockwise : spelling_.clockwise;
    line(block);
  }

  [[nodiscard]] bool flat_in_xy(const parser::ArcFeed& arc) const {
    if (arc.plane != parser::Plane::xy) return false;
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (letter == AxisLetter::X || letter == AxisLetter::Y || !arc.end[letter]) continue;
      if (arc.tool_axis && parser::is_rotary(letter)) continue;
      const auto& known = known_.at(index_of(letter));
      if (!known || known->text != text_of(letter, *arc.end[letter])) return false;
    }
    return true;
  }

  void straight(const AxisTarget& end, const std::optional<UnitVec3>& tool_axis,
                parser::Coordinates coordinates, const Feed* feed) {
    const bool machine = coordinates == parser::Coordinates::machine;
    const bool switched = machine && spelling_.machine_coordinates_compensated &&
                          compensation_.mode != LengthCompensation::off;
    if (switched) spell({});
    if (!machine && length_cannot_be_off()) return;
    if (machine || (tool_axis.has_value() != vectors_)) forget_positions();
    vectors_ = tool_axis.has_value();
    std::string words;
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (!end[letter] || (vectors_ && parser::is_rotary(letter))) continue;
      words += axis_word(letter, *end[letter], false);
    }
    words += vector_words(tool_axis);
    if (words.empty()) {  // a block that moves nothing still has its line and its time
      for (const AxisLetter letter : parser::kAxisLetters) {
        if (words.empty() && end[letter]) words += axis_word(letter, *end[letter], true);
      }
    }
    if (words.empty()) return;

    std::string_view motion = feed == nullptr ? spelling_.traverse : spelling_.linear;
    if (feed != nullptr && feed->synchronised) {
      motion = spelling_.thread;
      if (motion.empty()) {
        refuse("a move synchronised with the spindle", "write threads with the control's cycles");
        return;
      }
    }
    if (tool_axis && !spelling_.with_vector.empty()) motion = spelling_.with_vector;
    std::string block;
    if (machine) block += spelling_.before_machine_coordinates;
    if (!spelling_.modal || machine || motion != motion_word_) block += motion;
    motion_word_ = motion;
    block += words;
    block += feed != nullptr ? feed_words(*feed) : std::string(spelling_.traverse_feed);
    if (machine) {
      block += spelling_.after_machine_coordinates;
      forget_positions();
    }
    line(block.front() == ' ' ? block.substr(1) : block);
    if (switched) spell(compensation_);
  }

  // Where the length is that of the tool in the spindle, whatever the program says.
  bool length_cannot_be_off() {
    const bool stuck = spelling_.compensation_by_tool && spelling_.no_compensation.empty();
    if (!stuck || tool_ == 0 || compensation_.mode != LengthCompensation::off) return false;
    refuse("motions without the tool's length",
           "switch the length on (G43 H), or use machine "
           "coordinates");
    return true;
  }

  [[nodiscard]] std::string text_of(AxisLetter letter, double value) const {
    return parser::is_rotary(letter) ? coordinate(value * kDegPerRad, options_.angle_decimals)
                                     : coordinate(value, options_.length_decimals);
  }

  // " X12.5", or nothing when the axis is there already.
  std::string axis_word(AxisLetter letter, double value, bool always) {
    const std::string number = text_of(letter, value);
    std::optional<Known>& known = known_.at(index_of(letter));
    const bool there = known && known->text == number;
    known = Known{number, value};
    if (there && !always) return {};
    return fmt::format(" {}{}", parser::to_char(letter), number);
  }

  std::string vector_words(const std::optional<UnitVec3>& tool_axis) {
    if (!tool_axis) return {};
    if (spelling_.tool_vector[0].empty()) {
      refuse("tool vectors", "write rotary axes: --output tcp or --output axes");
      return {};
    }
    std::string words;
    for (std::size_t i = 0; i < 3; ++i) {
      words += fmt::format(
          " {}{}", spelling_.tool_vector.at(i),
          coordinate(tool_axis->vec()[static_cast<Eigen::Index>(i)], options_.vector_decimals));
    }
    vector_text_ = words;
    return words;
  }

  std::string centre_words(const parser::ArcFeed& arc, const parser::PlaneAxes& axes) {
    std::string words;
    for (const int axis : {std::min(axes.u, axes.v), std::max(axes.u, axes.v)}) {
      const auto i = static_cast<std::size_t>(axis);
      const double from = spelling_.circle_centre_block ? 0.0 : known_.at(i)->value;
      words += fmt::format(" {}{}", spelling_.circle_centre_block ? "XYZ"[i] : "IJK"[i],
                           coordinate(arc.center[axis] - from, options_.length_decimals));
    }
    return words;
  }

  // " F500", with the words that change the mode before it.
  std::string feed_words(const Feed& feed) {
    if (feed.synchronised) {  // of this block alone
      feed_text_.clear();
      return fmt::format(" {}{}", spelling_.lead, significant(feed.value, options_.feed_digits));
    }
    const std::string_view word = spelling_.feed_words.at(index_of(feed.mode));
    if (word.empty()) {
      refuse(feed.mode == FeedMode::inverse_time ? "inverse time feed" : "feed per revolution",
             "give the feed in mm/min");
      return {};
    }
    std::string words;
    if (word == "FT") {  // of this block alone
      feed_text_.clear();
      return fmt::format(" FT{}",
                         significant(kSecondsPerMinute / feed.value, options_.feed_digits));
    }
    if (feed.mode != feed_mode_) {
      feed_text_.clear();
      words += fmt::format(" {}", spelling_.feed_modes.at(index_of(feed.mode)));
    }
    feed_mode_ = feed.mode;
    std::string text = significant(feed.value, options_.feed_digits);
    const bool there = text == feed_text_ && feed.mode != FeedMode::inverse_time;
    if (!there) words += fmt::format(" {}{}", word, text);
    feed_text_ = std::move(text);
    return words;
  }

  // --- states ---------------------------------------------------------------------------------

  void write(const parser::CompensationChange& change) {
    if (change.length) {
      refuse("a tool length that the program sets itself", "take the lengths from the tool table");
      return;
    }
    if (change.mode != LengthCompensation::off && spelling_.compensation_by_tool &&
        change.offset_number != tool_) {
      refuse(fmt::format("the length of tool {} with tool {} in the spindle", change.offset_number,
                         tool_),
             "take the length offset of the tool in the spindle");
      return;
    }
    if (change.tool_vectors && spelling_.tool_vector[0].empty()) {
      refuse("tool vectors", "write rotary axes: --output tcp or --output axes");
      return;
    }
    spell(change);
    compensation_ = change;
  }

  static bool guides_tip(const parser::CompensationChange& compensation) {
    return compensation.mode == LengthCompensation::tool_centre_point;
  }

  // The words from what is in force to this.
  void spell(const parser::CompensationChange& to) {
    if (guides_tip(in_force_) && !guides_tip(to)) lines(spelling_.leave_tool_centre_point);
    const std::string_view pattern = to.mode == LengthCompensation::off ? spelling_.no_compensation
                                     : !guides_tip(to)                  ? spelling_.length
                                     : to.tool_vectors                  ? spelling_.tool_vectors
                                                       : spelling_.tool_centre_point;
    lines(filled(pattern, '#', fmt::format("{}", to.offset_number)));
    in_force_ = to;
    if (guides_tip(to)) lines(spelling_.orientation_paths.at(index_of(orientation_)));
    forget_positions();
  }

  void write(const parser::OrientationPathChange& change) {
    orientation_ = change.path;
    const std::string_view word = spelling_.orientation_paths.at(index_of(change.path));
    if (word.empty() && change.path != parser::OrientationPath::rotary_axes) {
      refuse("tool axes that follow great circles", "write rotary axes: --output tcp or axes");
      return;
    }
    if (guides_tip(in_force_)) lines(word);
  }
  void write(const parser::RotaryPathChange& change) {
    const std::string_view word = spelling_.rotary_paths.at(index_of(change.path));
    const bool all = change.axes == parser::RotaryPathChange{}.axes;
    if ((word.empty() || !all) && change.path != parser::RotaryPath::as_programmed) {
      refuse(change.path == parser::RotaryPath::shortest ? "rotary axes that take the shortest way"
                                                         : "rotary axes that turn in one direction",
             "write the positions that they turn to");
      return;
    }
    lines(word);
  }
  void write(const parser::TiltedPlaneChange& /*change*/) {
    refuse("a tilted plane", "let the post-processor resolve it");
  }
  void write(const parser::AlignToPlane& /*align*/) {
    refuse("the alignment to a tilted plane", "let the post-processor resolve it");
  }

  void write(const parser::ToolChange& change) {
    const std::string number = fmt::format("{}", change.tool);
    const parser::SpindleChange* spindle = next_spindle();
    if (!spelling_.tool_change_with_speed.empty() && spindle != nullptr) {
      lines(filled(filled(spelling_.tool_change_with_speed, '#', number), '$',
                   significant(spindle->speed, options_.feed_digits)));
      speed_ = spindle->speed;
    } else {
      lines(filled(spelling_.tool_change, '#', number));
    }
    tool_ = change.tool;
    forget_positions();
  }

  // The spindle's start between this tool change and the first motion after it.
  [[nodiscard]] const parser::SpindleChange* next_spindle() const {
    for (const Motion& motion : rest_) {
      if (const auto* spindle = std::get_if<parser::SpindleChange>(&motion.command)) return spindle;
      if (std::holds_alternative<parser::Traverse>(motion.command) ||
          std::holds_alternative<parser::LinearFeed>(motion.command) ||
          std::holds_alternative<parser::ArcFeed>(motion.command) ||
          std::holds_alternative<parser::ToolChange>(motion.command)) {
        return nullptr;
      }
    }
    return nullptr;
  }

  void write(const parser::SpindleChange& change) {
    std::string block;
    const bool turns = change.direction != parser::SpindleDirection::off;
    if (turns && change.speed != speed_) {
      block = filled(spelling_.speed, '#', significant(change.speed, options_.feed_digits));
      speed_ = change.speed;
    }
    lines(block + std::string(spelling_.spindle.at(index_of(change.direction))));
  }
  void write(const parser::CoolantChange& change) {
    line(spelling_.coolant.at(change.flood ? 1 : 0));
  }
  void write(const parser::WorkOffsetChange& change) {
    const auto index = static_cast<std::size_t>(change.number - 1);
    const std::string_view word = index < spelling_.work_offsets.size()
                                      ? spelling_.work_offsets.at(index)
                                      : std::string_view();
    if (word.empty() && spelling_.any_work_offset.empty()) {
      refuse(fmt::format("work offset {}", change.number), "use one of the first six");
      return;
    }
    lines(word.empty() ? filled(spelling_.any_work_offset, '#', fmt::format("{}", change.number))
                       : std::string(word));
    forget_positions();
  }
  void write(const parser::WorkOffsetSetting& setting) {
    refuse(fmt::format("a program that places {} itself", parser::work_offset_name(setting.number)),
           "give the origin in the setup");
  }
  void write(const parser::Dwell& dwell) {
    lines(filled(spelling_.dwell, '#', significant(dwell.seconds, options_.feed_digits)));
  }
  void write(const parser::Stop& stop) { line(spelling_.stops.at(index_of(stop.kind))); }

  void write(const parser::Event& event) {
    if (!options_.comments) return;
    if (event.name == "message" && !spelling_.message.empty()) {
      lines(filled(spelling_.message, '$', as_comment(event.text)));
      return;
    }
    const bool comment = event.name == "comment" || event.name == "message";
    std::string text = comment ? event.text : event.name + " " + event.text;
    comment_line(text);
  }

  // --- lines ----------------------------------------------------------------------------------

  void comment_line(std::string_view text) {
    line(fmt::format("{}{}{}", spelling_.comment_open, as_comment(text), spelling_.comment_close),
         false);
  }

  // Only what every controller shows in a comment.
  [[nodiscard]] std::string as_comment(std::string_view text) const {
    std::string shown;
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '(' || c == '{') {
        shown += '[';
      } else if (c == ')' || c == '}') {
        shown += ']';
      } else if (c == '"') {
        shown += '\'';
      } else if (byte < 0x80 && std::isprint(byte) != 0) {
        shown += spelling_.upper_comments ? static_cast<char>(std::toupper(byte)) : c;
      } else if ((byte & 0xC0U) != 0x80U) {  // one sign for a character of several bytes
        shown += byte == '\t' ? ' ' : '?';
      }
    }
    while (!shown.empty() && shown.back() == ' ') shown.pop_back();
    return shown;
  }

  // Each line of the text; nothing for an empty one.
  void lines(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      if (end > 0) line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  void line(std::string_view text, bool block = true) {
    if (spelling_.numbered_blocks)
      program_.text += fmt::format("{} ", program_.source_lines.size());
    program_.text += text;
    if (block && options_.source_lines && place_.line != 0) {
      program_.text +=
          fmt::format(" {}{}{}", spelling_.comment_open, place_.line, spelling_.comment_close);
    }
    program_.text += '\n';
    program_.source_lines.push_back(place_.line);
  }

  [[nodiscard]] std::string coordinate(double value, int decimals) const {
    std::string text = fixed(value, decimals, spelling_.whole_numbers);
    if (spelling_.plus_signs && text.front() != '-') text.insert(0, 1, '+');
    return text;
  }

  void forget_positions() {
    known_ = {};
    vector_text_.clear();
  }

  void refuse(std::string_view what, std::string hint) {
    Diagnostic problem =
        error("not-in-dialect"_id, fmt::format("{} has no words for {}", spelling_.title, what),
              std::move(hint));
    if (place_.file) problem.file = *place_.file;
    problem.line = static_cast<int>(place_.line);
    problem.column = static_cast<int>(place_.column);
    // One of a kind is enough: the same motion would fail a million times.
    const bool told = std::any_of(problems_.begin(), problems_.end(), [&](const Diagnostic& d) {
      return d.message == problem.message;
    });
    if (!told) problems_.push_back(std::move(problem));
  }

  struct Known {
    std::string text;
    double value = 0.0;
  };

  const NcSpelling& spelling_;
  const WriterOptions& options_;
  std::span<const Motion> rest_{};  // after the motion at work
  parser::SourcePlace place_{};     // of the motion at work

  std::string_view motion_word_{};
  std::array<std::optional<Known>, 6> known_{};
  std::string vector_text_{};  // of the vector in force
  bool vectors_ = false;
  std::optional<parser::Plane> plane_{};
  FeedMode feed_mode_ = FeedMode::per_minute;
  std::string feed_text_{};
  parser::CompensationChange compensation_{};  // as the motions say
  parser::CompensationChange in_force_{};
  parser::OrientationPath orientation_ = parser::OrientationPath::rotary_axes;
  int tool_ = 0;
  double speed_ = -1.0;

  NcProgram program_{};
  Diagnostics problems_{};
};

}  // namespace

Result<NcProgram> write_nc(std::span<const Motion> motions, parser::Dialect dialect,
                           const WriterOptions& options) {
  const NcSpelling* spelling = spelling_of(dialect);
  if (spelling == nullptr) {
    return error("not-in-dialect"_id,
                 fmt::format("{} is no language that machines read", parser::name_of(dialect)),
                 "fanuc, sinumerik, heidenhain or linuxcnc");
  }
  return NcWriter(*spelling, options).write(motions);
}

LineRange lines_from(const NcProgram& program, LineRange source) {
  LineRange range;
  for (std::size_t i = 0; i < program.source_lines.size(); ++i) {
    const std::uint32_t from = program.source_lines[i];
    if (from < source.first || from > source.last) continue;
    range.last = static_cast<std::uint32_t>(i + 1);
    if (range.first == 0) range.first = range.last;
  }
  return range;
}

}  // namespace frustum::post
