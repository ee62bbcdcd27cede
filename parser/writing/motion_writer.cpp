#include "parser/writing/motion_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "parser/arc.hpp"
#include "parser/arc_feed.hpp"
#include "parser/writing/arc_turns.hpp"
#include "parser/writing/block_parts.hpp"
#include "parser/writing/motion_spelling.hpp"
#include "parser/writing/motion_words.hpp"
#include "parser/writing/rigid_tap.hpp"

namespace frustum::parser {
namespace {

class MotionWriter {
 public:
  MotionWriter(const NcSpelling& spelling, const WriterOptions& options)
      : spelling_(spelling),
        options_(options),
        refusals_(spelling.title),
        words_(spelling, options, refusals_),
        out_(spelling, options) {}

  Result<NcProgram> write(std::span<const Motion> motions) {
    const std::size_t first = write_head(motions);
    const Motion* remark = nullptr;  // of the block at work
    for (std::size_t i = first; i < motions.size(); ++i) {
      const std::uint32_t line = motions[i].place.line;
      if (as_given() && line == 0) continue;  // the modes say it
      const bool before_its_block =
          as_given() && i + 1 < motions.size() && motions[i + 1].place.line == line;
      if (before_its_block && is_comment(motions[i])) {
        remark = &motions[i];
        continue;
      }
      rest_ = motions.subspan(i + 1);
      write(motions[i]);
      i += write_said(motions.subspan(i + 1));
      if (remark != nullptr) write(*std::exchange(remark, nullptr));
    }
    begin({});
    out_.lines(filled(spelling_.footer, '$', out_.as_comment(options_.name)));
    if (!refusals_.all().empty()) return refusals_.all();
    return out_.take();
  }

 private:
  [[nodiscard]] bool as_given() const { return options_.layout == NcLayout::as_given; }
  static bool is_comment(const Motion& motion) {
    const auto* event = std::get_if<Event>(&motion.command);
    return event != nullptr && event->name == "comment";
  }
  void begin(const SourcePlace& place) {
    block_line_ = std::exchange(line_, place.line);
    refusals_.begin(place);
    out_.begin(place.line);
  }
  void write(const Motion& motion) {
    begin(motion.place);
    std::visit([this](const auto& command) { write(command); }, motion.command);
  }

  // The motions that the block at work has said already, but for what is said in them.
  std::size_t write_said(std::span<const Motion> rest) {
    const std::size_t said = std::exchange(said_, 0);
    for (const Motion& motion : rest.first(said)) {
      if (const auto* event = std::get_if<Event>(&motion.command)) write(*event);
    }
    if (const auto left = std::exchange(left_, std::nullopt)) write(*left);
    // The spindle turns as before, which the program may say next.
    const auto* spindle =
        said < rest.size() ? std::get_if<SpindleChange>(&rest[said].command) : nullptr;
    const bool again = said > 0 && !spelling_.rigid_tap.empty() && spindle != nullptr &&
                       spindle->direction == turning_ && spindle->speed == speed_;
    return said + (again ? 1 : 0);
  }

  // What the program begins with; the number of motions that it says.
  std::size_t write_head(std::span<const Motion> motions) {
    std::size_t said = 0;
    std::string title = options_.name;
    if (as_given() && !motions.empty() && is_comment(motions.front())) {
      title = std::get<Event>(motions[said++].command).text;
    }
    out_.lines(filled(filled(spelling_.header, '#', options_.number), '$', out_.as_comment(title)));
    for (; as_given() && said < motions.size() && is_comment(motions[said]); ++said) {
      out_.comment(std::get<Event>(motions[said].command).text);
    }
    out_.lines(spelling_.modes);
    return said;
  }

  void write(const Traverse& move) {
    straight(move.end, move.tool_axis, move.coordinates, nullptr);
  }
  void write(const LinearFeed& move) {
    if (move.feed.synchronised) return write_thread(move);
    straight(move.end, move.tool_axis, move.coordinates, &move.feed);
  }

  void write_thread(const LinearFeed& move) {
    const auto tap = rigid_tap_of(move, {turning_, speed_}, words_.at(), rest_);
    const bool in_cycle = tap.reverses && spelling_.rigid_tap.empty();
    thread_word_ = tap.reverses ? spelling_.rigid_tap : spelling_.thread;
    std::string_view obstacle = tap.obstacle;
    const bool guided = guides_tip(in_force_);
    if (in_cycle && obstacle.empty()) obstacle = obstacle_to_cycle(words_, move, guided);
    if (in_cycle && !tap.obstacle.empty() && !spelling_.before_strokes.empty()) {
      return tap_in_strokes(move, guided);
    }
    if (!tap.reverses && thread_word_.empty()) obstacle = "a move synchronised with the spindle";
    if (!obstacle.empty()) {
      return refusals_.add(std::string(obstacle), "write threads with the control's cycles");
    }
    left_ = tap.left;
    if (in_cycle) {
      tap_in_cycle(move);
      said_ = tap.after;
      return;
    }
    said_ = tap.after;
    straight(move.end, move.tool_axis, move.coordinates, &move.feed);
  }

  void tap_in_cycle(const LinearFeed& move) {
    if (length_cannot_be_off()) return;
    const AxisTarget start = words_.at();
    const auto number = [this](double z) { return words_.text_of(AxisLetter::Z, z); };
    const double top = *start[AxisLetter::Z], bottom = *move.end[AxisLetter::Z];
    const bool right = turning_ == SpindleDirection::clockwise;
    const std::string lead = significant(move.feed.value, options_.feed_digits);
    std::string feed;
    if (spelling_.tap_cycle.find("{feed}") != std::string_view::npos) {
      words_.restate_feed();
      feed = words_.feed({move.feed.value * speed_, FeedMode::per_minute});
    }
    begin_tap();
    out_.lines(fmt::format(
        fmt::runtime(spelling_.tap_cycle), fmt::arg("z", number(bottom)),
        fmt::arg("start", number(top)), fmt::arg("depth", number(bottom - top)),
        fmt::arg("signed", (right ? spelling_.plus_signs ? "+" : "" : "-") + lead),
        fmt::arg("feed", feed), fmt::arg("speed", significant(speed_, options_.feed_digits)),
        fmt::arg("word", spelling_.tap_words.at(right ? 0 : 1))));
    motion_word_ = {};
    turning_ = SpindleDirection::off;
  }

  void begin_tap() {
    if (plane_.value_or(Plane::xy) != Plane::xy) out_.line(spelling_.planes[0]);
    plane_ = Plane::xy;
  }

  void tap_in_strokes(const LinearFeed& in, bool guided) {
    const TapStrokes tap = tap_strokes_of(in, {turning_, speed_}, words_.at(), rest_);
    if (guided || !tap.obstacle.empty()) {
      return refusals_.add(guided ? "a tap with tool centre point control" : tap.obstacle,
                           "write threads with the control's cycles");
    }
    if (length_cannot_be_off()) return;
    begin_tap();
    out_.lines(strokes_text(tap, in.feed, speed_, spelling_, words_, options_.feed_digits));
    speed_ = tap.strokes.back().speed;
    (void)words_.axis(AxisLetter::Z, tap.strokes.back().z, true);
    motion_word_ = {};
    turning_ = SpindleDirection::off;
    left_ = tap.left;
    said_ = tap.after;
  }

  void write(const Probe& /*probe*/) {
    refusals_.add("a probing move", "leave the blocks that probe out");
  }

  void write(const HomeReturn& home) {
    if (spelling_.home_return.empty()) {
      refusals_.add("the return to home (G28)", "give the position in machine coordinates");
      return;
    }
    if (home.point != 1) {
      refusals_.add("the return to another reference point than home (G30)",
                    "give the position in machine coordinates");
      return;
    }
    SpacedText block(spelling_.home_return);
    for (const AxisLetter letter : kAxisLetters) {
      if (home.axes.at(index_of(letter))) block.add(fmt::format("{}0", to_char(letter)));
    }
    out_.line(block.take());
    out_.line("G90");  // home is written incrementally: straight there
    forget_positions();
  }

  void write(const ArcFeed& arc) {
    const PlaneAxes axes = axes_of(arc.plane);
    const auto u = static_cast<AxisLetter>(axes.u), v = static_cast<AxisLetter>(axes.v);
    if (!words_.knows(u) || !words_.knows(v)) {
      refusals_.add("an arc whose start is not known",
                    "move to its start with a straight line first");
      return;
    }
    const int turns = std::abs(arc.turns);
    if (turns > 1 && spelling_.full_turns.empty()) return write_turns(arc);
    if (spelling_.circle_centre_block && !words_.flat_in_xy(arc)) {
      refusals_.add("an arc that is not flat in X and Y", "linearise arcs");
      return;
    }
    if (!plane_ || *plane_ != arc.plane) {
      if (!spelling_.planes.at(index_of(arc.plane)).empty()) {
        out_.line(spelling_.planes.at(index_of(arc.plane)));
      }
      plane_ = arc.plane;
    }
    Feed feed = arc.feed;
    if (spelling_.arc_feed_is_in_plane) feed.value /= canonical_of_fanuc_feed(arc, words_.at());
    out_.lines(words_.feed_mode_block(feed));
    motion_word_ = arc.turns > 0 ? spelling_.counterclockwise : spelling_.clockwise;
    SpacedText block(motion_word_);
    const std::string centre = words_.centre(arc, axes);
    if (spelling_.circle_centre_block) out_.line("CC " + centre);
    const bool vectors = arc.tool_axis.has_value();
    for (const AxisLetter letter : kAxisLetters) {
      if (!arc.end[letter] || (vectors && is_rotary(letter))) continue;
      block.add(words_.axis(letter, *arc.end[letter], letter == u || letter == v));
    }
    const std::string vector_before = words_.vector_in_force();
    const std::string vector = words_.vector(arc.tool_axis);
    if (spelling_.vectors_on_arcs) {
      block.add(vector);
    } else if (vector != vector_before) {
      refusals_.add("a tool vector on an arc", "turn the tool before the arc");
    }
    if (!spelling_.circle_centre_block) block.add(centre);
    if (turns > 1) {
      block.add(
          filled(spelling_.full_turns, '#', fmt::format("{}", turns - spelling_.turns_beyond)));
    }
    if (spelling_.circle_centre_block) block.add(arc.turns > 0 ? "DR+" : "DR-");
    block.add(words_.feed(feed));
    out_.line(block.take());
  }

  void write_turns(const ArcFeed& arc) {
    const std::vector<ArcFeed> turns = single_turns(arc, words_.at());
    if (turns.empty()) {
      refusals_.add("a helix of which an axis starts where it is not known",
                    "name all of its axes in the move before");
    }
    for (const ArcFeed& turn : turns) write(turn);
  }

  void straight(const AxisTarget& end, const std::optional<UnitVec3>& tool_axis,
                Coordinates coordinates, const Feed* feed) {
    const bool machine = coordinates == Coordinates::machine;
    const bool switched = machine && spelling_.machine_coordinates_compensated &&
                          compensation_.mode != LengthCompensation::off;
    if (switched) spell({});
    if (!machine && length_cannot_be_off()) return;
    if (machine || (tool_axis.has_value() != vectors_)) forget_positions();
    vectors_ = tool_axis.has_value();
    const bool thread = feed != nullptr && feed->synchronised;
    const std::string lead = thread ? words_.lead(*feed, end) : std::string();
    const AxisTarget start = words_.at();
    SpacedText positions;
    for (const AxisLetter letter : kAxisLetters) {
      if (!end[letter] || (vectors_ && is_rotary(letter))) continue;
      positions.add(words_.axis(letter, *end[letter], false));
    }
    positions.add(words_.vector(tool_axis));
    if (positions.empty()) {  // a block that moves nothing still has its line and its time
      const auto given = std::ranges::find_if(
          kAxisLetters, [&](AxisLetter letter) { return end[letter].has_value(); });
      if (given == kAxisLetters.end()) return;
      positions.add(words_.axis(*given, *end[*given], true));
    }

    std::string_view motion = feed == nullptr ? spelling_.traverse : spelling_.linear;
    if (thread) motion = thread_word_;
    if (tool_axis && !spelling_.with_vector.empty()) motion = spelling_.with_vector;
    if (feed != nullptr) out_.lines(words_.feed_mode_block(*feed));
    SpacedText block;
    if (machine) block.add(spelling_.before_machine_coordinates);
    if (!spelling_.modal || machine || motion != motion_word_) block.add(motion);
    if (options_.restate_feed && feed != nullptr && motion != motion_word_) words_.restate_feed();
    motion_word_ = motion;
    block.add(positions.take());
    block.add(feed == nullptr ? std::string(spelling_.traverse_feed)
              : thread        ? lead
                              : words_.feed(*feed));
    if (machine) {
      block.add(spelling_.after_machine_coordinates);
      forget_positions();
    }
    out_.line(block.take());
    if (said_ > 0) words_.stay(start);
    if (switched) spell(compensation_);
  }

  // Where the length is that of the tool in the spindle, whatever the program says.
  bool length_cannot_be_off() {
    const bool stuck = spelling_.compensation_by_tool && spelling_.no_compensation.empty();
    if (!stuck || tool_ == 0 || compensation_.mode != LengthCompensation::off) return false;
    refusals_.add("motions without the tool's length",
                  "switch the length on (G43 H), or use machine "
                  "coordinates");
    return true;
  }

  void write(const CompensationChange& change) {
    if (!has_words(spelling_, change, tool_, refusals_)) return;
    spell(change);
    compensation_ = change;
  }

  static bool guides_tip(const CompensationChange& compensation) {
    return compensation.mode == LengthCompensation::tool_centre_point;
  }

  // The words from what is in force to this.
  void spell(const CompensationChange& to) {
    if (guides_tip(in_force_) && !guides_tip(to)) out_.lines(spelling_.leave_tool_centre_point);
    const std::string_view pattern = to.mode == LengthCompensation::off ? spelling_.no_compensation
                                     : to.negative                      ? spelling_.negative_length
                                     : !guides_tip(to)                  ? spelling_.length
                                     : to.tool_vectors                  ? spelling_.tool_vectors
                                                       : spelling_.tool_centre_point;
    out_.lines(filled(pattern, '#', fmt::format("{}", to.offset_number)));
    in_force_ = to;
    if (guides_tip(to)) out_.lines(spelling_.orientation_paths.at(index_of(orientation_)));
    forget_positions();
  }

  void write(const OrientationPathChange& change) {
    orientation_ = change.path;
    const std::string_view word = spelling_.orientation_paths.at(index_of(change.path));
    if (word.empty() && change.path != OrientationPath::rotary_axes) {
      refusals_.add("tool axes that follow great circles",
                    "write rotary axes: --output tcp or axes");
      return;
    }
    if (guides_tip(in_force_)) out_.lines(word);
  }
  void write(const RotaryPathChange& change) {
    const std::string_view word = spelling_.rotary_paths.at(index_of(change.path));
    const bool all = change.axes == RotaryPathChange{}.axes;
    if ((word.empty() || !all) && change.path != RotaryPath::as_programmed) {
      refusals_.add(change.path == RotaryPath::shortest ? "rotary axes that take the shortest way"
                                                        : "rotary axes that turn in one direction",
                    "write the positions that they turn to");
      return;
    }
    out_.lines(word);
  }
  void write(const TiltedPlaneChange& /*change*/) {
    refusals_.add("a tilted plane", "let the post-processor resolve it");
  }
  void write(const AlignToPlane& /*align*/) {
    refusals_.add("the alignment to a tilted plane", "let the post-processor resolve it");
  }

  void write(const ToolChange& change) {
    const std::string number = fmt::format("{}", change.tool);
    const SpindleChange* spindle = next_spindle();
    if (!spelling_.tool_change_with_speed.empty() && spindle != nullptr) {
      out_.lines(filled(filled(spelling_.tool_change_with_speed, '#', number), '$',
                        significant(spindle->speed, options_.feed_digits)));
      speed_ = spindle->speed;
    } else {
      out_.lines(filled(spelling_.tool_change, '#', number));
    }
    tool_ = change.tool;
    forget_positions();
  }

  // The spindle's start between this tool change and the first motion after it.
  [[nodiscard]] const SpindleChange* next_spindle() const {
    for (const Motion& motion : rest_) {
      if (const auto* spindle = std::get_if<SpindleChange>(&motion.command)) return spindle;
      if (std::holds_alternative<Traverse>(motion.command) ||
          std::holds_alternative<LinearFeed>(motion.command) ||
          std::holds_alternative<ArcFeed>(motion.command) ||
          std::holds_alternative<ToolChange>(motion.command)) {
        return nullptr;
      }
    }
    return nullptr;
  }

  void write(const SpindleChange& change) {
    SpacedText block;
    turning_ = change.direction;
    const bool turns = change.direction != SpindleDirection::off;
    if (turns && change.speed != speed_) {
      block.add(filled(spelling_.speed, '#', significant(change.speed, options_.feed_digits)));
      speed_ = change.speed;
    }
    block.add(spelling_.spindle.at(index_of(change.direction)));
    out_.lines(block.take());
  }
  void write(const CoolantChange& change) { out_.line(spelling_.coolant.at(change.flood ? 1 : 0)); }
  void write(const WorkOffsetChange& change) {
    const auto index = static_cast<std::size_t>(change.number - 1);
    const std::string_view word = index < spelling_.work_offsets.size()
                                      ? spelling_.work_offsets.at(index)
                                      : std::string_view();
    if (word.empty() && spelling_.any_work_offset.empty()) {
      refusals_.add(fmt::format("work offset {}", change.number), "use one of the first six");
      return;
    }
    out_.lines(word.empty()
                   ? filled(spelling_.any_work_offset, '#', fmt::format("{}", change.number))
                   : std::string(word),
               BlockPart::front);
    forget_positions();
  }
  void write(const WorkOffsetSetting& setting) {
    refusals_.add(fmt::format("a program that places {} itself", work_offset_name(setting.number)),
                  "give the origin in the setup");
  }
  void write(const Dwell& dwell) {
    out_.lines(filled(spelling_.dwell, '#', significant(dwell.seconds, options_.feed_digits)));
  }
  void write(const Stop& stop) { out_.line(spelling_.stops.at(index_of(stop.kind))); }

  void write(const Event& event) {
    if (!options_.comments) return;
    if (as_given() && line_ != block_line_) motion_word_ = {};
    if (event.name == "message" && !spelling_.message.empty()) {
      out_.lines(filled(spelling_.message, '$', out_.as_comment(event.text)));
      return;
    }
    const bool comment = event.name == "comment" || event.name == "message";
    std::string text = comment ? event.text : event.name + " " + event.text;
    out_.comment(text);
  }

  void forget_positions() {
    words_.forget();
    if (as_given()) motion_word_ = {};
  }

  const NcSpelling& spelling_;
  const WriterOptions& options_;
  std::span<const Motion> rest_{};  // after the motion at work
  std::uint32_t line_ = 0;          // of the source: of the motion at work, and of the one before
  std::uint32_t block_line_ = 0;

  std::string_view motion_word_{};
  bool vectors_ = false;
  std::optional<Plane> plane_{};
  CompensationChange compensation_{};  // as the motions say
  CompensationChange in_force_{};
  OrientationPath orientation_ = OrientationPath::rotary_axes;
  int tool_ = 0;
  double speed_ = -1.0;
  SpindleDirection turning_ = SpindleDirection::off;
  std::string_view thread_word_{};
  std::optional<SpindleChange> left_{};  // how the spindle turns behind these
  std::size_t said_ = 0;                 // motions after the one at work that its block says, too

  Refusals refusals_;
  MotionWords words_;
  NcLines out_;
};

}  // namespace

Result<NcProgram> write_nc(std::span<const Motion> motions, Dialect dialect,
                           const WriterOptions& options) {
  const NcSpelling* spelling = spelling_of(dialect);
  if (spelling == nullptr) {
    return error("not-in-dialect"_id,
                 fmt::format("{} is no language that machines read", name_of(dialect)),
                 "fanuc, sinumerik, heidenhain or linuxcnc");
  }
  return MotionWriter(*spelling, options).write(motions);
}

}  // namespace frustum::parser
