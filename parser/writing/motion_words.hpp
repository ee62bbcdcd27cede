// The words of one motion: positions, tool vectors, centres of arcs, feeds. What is in force
// already is left out.
//
// Units  : mm, rad in; mm, degrees, mm/min or seconds in the text
// Errors : what the dialect has no words for, kept by Refusals
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"
#include "parser/arc.hpp"
#include "parser/motion.hpp"
#include "parser/writing/motion_spelling.hpp"
#include "parser/writing/nc_lines.hpp"

namespace frustum::parser {

template <typename Enum>
constexpr std::size_t index_of(Enum value) {
  return static_cast<std::size_t>(value);
}

// What a controller has no words for, with the place of the motion that asked for it.
class Refusals {
 public:
  explicit Refusals(std::string_view controller) : controller_(controller) {}

  void begin(const SourcePlace& place) { place_ = place; }
  // One of a kind is enough: the same motion would fail a million times.
  void add(std::string_view what, std::string hint);
  [[nodiscard]] const Diagnostics& all() const { return problems_; }

 private:
  std::string_view controller_;
  SourcePlace place_{};
  std::set<std::string> refused_{};
  Diagnostics problems_{};
};

// Whether the control can be told so, with that tool in the spindle; else a refusal is added.
[[nodiscard]] bool has_words(const NcSpelling& spelling, const CompensationChange& change, int tool,
                             Refusals& refusals);

class MotionWords {
 public:
  MotionWords(const NcSpelling& spelling, const WriterOptions& options, Refusals& refusals)
      : spelling_(spelling), options_(options), refusals_(refusals) {}

  // Of the axes and of the tool vector.
  void forget();
  [[nodiscard]] bool knows(AxisLetter letter) const { return known_[index_of(letter)].has_value(); }
  // Where the axes are, as far as it is known.
  [[nodiscard]] AxisTarget at() const;
  void stay(const AxisTarget& at);  // the axes are back where they were
  [[nodiscard]] std::string text_of(AxisLetter letter, double value) const;  // 12.5
  // X12.5, or nothing when the axis is there already.
  [[nodiscard]] std::string axis(AxisLetter letter, double value, bool always);
  [[nodiscard]] std::string vector(const std::optional<UnitVec3>& tool_axis);
  [[nodiscard]] const std::string& vector_in_force() const { return vector_text_; }
  [[nodiscard]] std::string centre(const ArcFeed& arc, const PlaneAxes& axes) const;
  // Whether the arc moves no axis but X and Y.
  [[nodiscard]] bool flat_in_xy(const ArcFeed& arc) const;
  // What changes the mode, where it needs a block of its own before the move.
  [[nodiscard]] std::string feed_mode_block(const Feed& feed);
  // F500, with the words that change the mode before it.
  [[nodiscard]] std::string feed(const Feed& feed);
  // The lead of a thread that goes on to `end`; nothing, and refused, where it has no word.
  [[nodiscard]] std::string lead(const Feed& feed, const AxisTarget& end);
  void restate_feed() { feed_text_.clear(); }

 private:
  struct Known {
    std::string text;
    double value = 0.0;
  };
  [[nodiscard]] std::string coordinate(double value, int decimals) const;

  const NcSpelling& spelling_;
  const WriterOptions& options_;
  Refusals& refusals_;
  std::array<std::optional<Known>, 6> known_{};
  std::string vector_text_{};
  FeedMode feed_mode_ = FeedMode::per_minute;
  std::string feed_text_{};
};

}  // namespace frustum::parser
