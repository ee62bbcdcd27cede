#include "parser/writing/motion_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/units.hpp"
#include "parser/writing/block_parts.hpp"
#include "parser/writing/number_text.hpp"

namespace frustum::parser {

void Refusals::add(std::string_view what, std::string hint) {
  if (!refused_.emplace(what).second) return;
  Diagnostic problem =
      error("not-in-dialect"_id, fmt::format("{} has no words for {}", controller_, what),
            std::move(hint));
  if (place_.file) problem.file = *place_.file;
  problem.line = static_cast<int>(place_.line);
  problem.column = static_cast<int>(place_.column);
  problems_.push_back(std::move(problem));
}

void MotionWords::forget() {
  known_ = {};
  vector_text_.clear();
}

std::string MotionWords::coordinate(double value, int decimals) const {
  std::string text = fixed(value, decimals, spelling_.whole_numbers);
  return spelling_.plus_signs ? with_sign(std::move(text)) : text;
}

std::string MotionWords::text_of(AxisLetter letter, double value) const {
  return is_rotary(letter) ? coordinate(value * kDegPerRad, options_.angle_decimals)
                           : coordinate(value, options_.length_decimals);
}

AxisTarget MotionWords::at() const {
  AxisTarget places;
  for (const AxisLetter letter : kAxisLetters) {
    if (const auto& known = known_.at(index_of(letter))) places[letter] = known->value;
  }
  return places;
}

void MotionWords::stay(const AxisTarget& at) {
  for (const AxisLetter letter : kAxisLetters) {
    auto& known = known_.at(index_of(letter));
    known.reset();
    if (at[letter]) known = Known{text_of(letter, *at[letter]), *at[letter]};
  }
}

std::string MotionWords::axis(AxisLetter letter, double value, bool always) {
  const std::string number = text_of(letter, value);
  std::optional<Known>& known = known_.at(index_of(letter));
  const bool there = known && known->text == number;
  known = Known{number, value};
  if (there && !always && options_.layout != NcLayout::as_given) return {};
  return to_char(letter) + number;
}

std::string MotionWords::vector(const std::optional<UnitVec3>& tool_axis) {
  if (!tool_axis) return {};
  if (spelling_.tool_vector[0].empty()) {
    refusals_.add("tool vectors", "write rotary axes: --output tcp or --output axes");
    return {};
  }
  SpacedText words;
  for (std::size_t i = 0; i < 3; ++i) {
    words.add(std::string(spelling_.tool_vector.at(i)) +
              coordinate(tool_axis->vec()[static_cast<Eigen::Index>(i)], options_.vector_decimals));
  }
  vector_text_ = words.take();
  return vector_text_;
}

std::string MotionWords::centre(const ArcFeed& arc, const PlaneAxes& axes) const {
  SpacedText words;
  for (const int axis : {std::min(axes.u, axes.v), std::max(axes.u, axes.v)}) {
    const auto i = static_cast<std::size_t>(axis);
    const double from = spelling_.circle_centre_block ? 0.0 : known_.at(i)->value;
    words.add((spelling_.circle_centre_block ? "XYZ"[i] : "IJK"[i]) +
              coordinate(arc.center[axis] - from, options_.length_decimals));
  }
  return words.take();
}

bool MotionWords::flat_in_xy(const ArcFeed& arc) const {
  if (arc.plane != Plane::xy) return false;
  return std::ranges::all_of(kAxisLetters, [&](AxisLetter letter) {
    if (letter == AxisLetter::X || letter == AxisLetter::Y || !arc.end[letter]) return true;
    if (arc.tool_axis && is_rotary(letter)) return true;
    const auto& known = known_.at(index_of(letter));
    return known && known->text == text_of(letter, *arc.end[letter]);
  });
}

std::string MotionWords::lead(const Feed& feed, const AxisTarget& end) {
  feed_text_.clear();  // a lead is of its block alone
  Vec3 way = Vec3::Zero();
  int axes = 0;
  bool known = true;
  for (const AxisLetter letter : kLinearAxes) {
    const auto& from = known_.at(index_of(letter));
    if (!end[letter] || (from && from->text == text_of(letter, *end[letter]))) continue;
    ++axes;
    known = known && from;
    way[static_cast<Eigen::Index>(letter)] = from ? *end[letter] - from->value : 1.0;
  }
  Eigen::Index longest = 0;
  way.cwiseAbs().maxCoeff(&longest);
  double value = feed.value;
  std::string_view letter = spelling_.lead;
  if (spelling_.lead_by == LeadBy::longest_axis) {
    letter = letter.substr(static_cast<std::size_t>(longest), 1);
    if (axes > 1) value *= std::abs(way[longest]) / way.norm();
  }
  if (axes > 1 && (spelling_.lead_by == LeadBy::one_axis ||
                   (spelling_.lead_by == LeadBy::longest_axis && !known))) {
    refusals_.add("this thread along several axes", "cut it along one axis");
    return {};
  }
  return std::string(letter) + significant(value, options_.feed_digits);
}

std::string MotionWords::feed_mode_block(const Feed& feed) {
  if (!spelling_.feed_mode_blocks || feed.synchronised || feed.mode == feed_mode_) return {};
  const std::string_view word = spelling_.feed_modes.at(index_of(feed.mode));
  if (word.empty()) return {};
  feed_mode_ = feed.mode;
  feed_text_.clear();
  return std::string(word);
}

std::string MotionWords::feed(const Feed& feed) {
  const auto value = [this](double number) { return significant(number, options_.feed_digits); };
  const std::string_view word = spelling_.feed_words.at(index_of(feed.mode));
  if (word.empty()) {
    refusals_.add(feed.mode == FeedMode::inverse_time ? "inverse time feed" : "feed per revolution",
                  "give the feed in mm/min");
    return {};
  }
  if (word == "FT") {  // of this block alone
    feed_text_.clear();
    return "FT" + value(kSecondsPerMinute / feed.value);
  }
  SpacedText words;
  if (feed.mode != feed_mode_) {
    feed_text_.clear();
    words.add(spelling_.feed_modes.at(index_of(feed.mode)));
  }
  feed_mode_ = feed.mode;
  std::string text = value(feed.value);
  const bool there = text == feed_text_ && feed.mode != FeedMode::inverse_time;
  if (!there) words.add(std::string(word) + text);
  feed_text_ = std::move(text);
  return words.take();
}

bool has_words(const NcSpelling& spelling, const CompensationChange& change, int tool,
               Refusals& refusals) {
  if (change.length) {
    refusals.add("a tool length that the program sets itself",
                 "leave its settings of lengths out (G10, G43.1): they belong to the setup, "
                 "--tool-length or a job");
    return false;
  }
  if (change.mode != LengthCompensation::off && spelling.compensation_by_tool &&
      change.offset_number != tool) {
    refusals.add(fmt::format("the length of tool {} with tool {} in the spindle",
                             change.offset_number, tool),
                 "take the length offset of the tool in the spindle");
    return false;
  }
  if (change.offset_number >= kEdgeOffsets && !spelling.compensation_by_tool) {
    refusals.add("the length of a further edge of a tool",
                 "take the length of the tool itself: D1");
    return false;
  }
  if (change.tool_vectors && spelling.tool_vector[0].empty()) {
    refusals.add("tool vectors", "write rotary axes: --output tcp or --output axes");
    return false;
  }
  if (change.negative && spelling.negative_length.empty()) {
    refusals.add("a tool length that is subtracted (G44)",
                 "write G43, and the length with the opposite sign");
    return false;
  }
  return true;
}

}  // namespace frustum::parser
