// Sinumerik: address words, settings, definitions, calls with arguments.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "parser/dialects/expressions.hpp"
#include "parser/reading/sinumerik/sinumerik_cycle.hpp"
#include "parser/writing/block_parts.hpp"
#include "parser/writing/block_writer.hpp"
#include "parser/writing/number_text.hpp"
#include "parser/writing/sinumerik_statement.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

// CYCLE800(1,"",0,57,...): its words stand after its name.
constexpr std::array<std::string_view, 16> kSwivel{
    "_FR", "_TC", "_ST=", "_MODE=", "_X0=", "_Y0=",  "_Z0=",  "_A=",
    "_B=", "_C=", "_X1=", "_Y1=",   "_Z1=", "_DIR=", "_FR_I", "_DMODE"};

// Events that are written NAME=text, and NAME text; else NAME(text).
constexpr std::array<std::string_view, 24> kSettings{
    "SPOS",    "SPOSA", "ADIS",    "ADISPOS", "LIMS",     "OVR", "OVRRAP", "ACC",
    "CTOL",    "OTOL",  "STOLF",   "ATOL",    "FD",       "SCC", "FL",     "JERKLIM",
    "VELOLIM", "FGREF", "ACCLIMA", "OVRA",    "FIFOCTRL", "FPR", "TOLFRC", "CUTMOD"};
constexpr std::array<std::string_view, 10> kOpenTexts{
    "G25", "G26", "EXTERN", "DEFINE", "WHENEVER", "WHEN", "EVERY", "IDS", "ID", "DO"};

template <std::size_t N>
bool is_in(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::size_t swivel_slot(const Word& word) {
  const auto* found =
      word.spelled == nullptr ? kSwivel.end() : std::ranges::find(kSwivel, word.spelled);
  return static_cast<std::size_t>(found - kSwivel.begin());
}

bool is_retract(const Comment& comment) {
  return comment.event != nullptr && std::string_view(comment.event) == "CYCLE800";
}

// What holds quotes itself was written without quotes around it.
std::string call_text(std::string_view name, const std::string& text) {
  const bool quotes = text.find('"') != std::string::npos;
  const bool bare = quotes || (name != "MSG" && text.find(')') == std::string::npos);
  if (!bare) return fmt::format("{}(\"{}\")", name, text);
  return fmt::format("{}({}{})", name, text.starts_with('"') ? "\"\"" : "", text);
}

std::string comment_text(const Comment& comment) {
  if (comment.event == nullptr) return ";" + comment.text;
  const std::string_view event = comment.event;
  if (is_retract(comment)) return "";  // a parameter of the cycle
  if (comment.of_builder && event.size() == 1) return comment.event + comment.text;
  if (is_in(kSettings, event)) return fmt::format("{}={}", event, comment.text);
  if (is_in(kOpenTexts, event)) return fmt::format("{} {}", event, comment.text);
  return call_text(event == "message" ? "MSG" : event, comment.text);
}

class SinumerikBlock {
 public:
  explicit SinumerikBlock(const Block& block)
      : block_(block), spelling_(expressions_of(Dialect::sinumerik)) {}

  std::string operator()() const {
    if (block_.tape_mark) return head_text();
    SpacedText text;
    if (block_.deletable) text.add("/");
    if (block_.number) text.add(fmt::format("N{}", *block_.number));
    if (block_.flow) text.add(sinumerik_statement(block_));
    const auto cycle = cycle_parameters();
    for (const Word& word : block_.words) {
      if (is_sinumerik_cycle(named_word(word))) {
        text.add(cycle_text(named_word(word), cycle));
      } else if (slot_in(cycle, word) < cycle.size()) {
        continue;  // a parameter of the cycle
      } else if (named_word(word).starts_with("CYCLE800")) {
        text.add(swivel_text(named_word(word)));
      } else if (swivel_slot(word) == kSwivel.size()) {
        text.add(word_text(word));
      }
    }
    text.add(settings_text());
    for (const Comment& comment : block_.comments) text.add(comment_text(comment));
    return text.take();
  }

 private:
  // %_N_PART_MPF, which the statement has the name from.
  [[nodiscard]] std::string head_text() const {
    return "%" + (block_.comments.empty() ? std::string() : block_.comments.front().text);
  }

  [[nodiscard]] std::string measured(const Word& word) const {
    const std::string value = value_text(spelling_, block_, word, sum);
    const std::string_view measure = sinumerik_measure(word.measure);
    return measure.empty() ? value : fmt::format("{}({})", measure, value);
  }

  // X10, X=0.5, X=R1, A3=1, TRAORI. What is after a = has no decimal point that matters. R5 and L5
  // would be a parameter and a call.
  [[nodiscard]] std::string word_text(const Word& word) const {
    if (word.letter == kNamedWord) return std::string(named_word(word));
    const std::string value = measured(word);
    if (word.spelled != nullptr) return word.spelled + value;
    const bool plain = word.expression.empty() && word.measure == Measure::modal;
    const bool has_point = value.find('.') != std::string::npos;
    const bool needs_sign = !plain || word.letter == 'R' || word.letter == 'L';
    if (needs_sign || has_point != word.decimal_point) {
      if (plain && word.decimal_point) return word.letter + with_point(value);
      return fmt::format("{}={}", word.letter, value);
    }
    return word.letter + value;
  }

  // Of the drilling cycle of the block; none without one.
  [[nodiscard]] std::span<const CycleParameter> cycle_parameters() const {
    for (const Word& word : block_.words) {
      if (is_sinumerik_cycle(named_word(word))) return sinumerik_cycle_parameters(named_word(word));
    }
    return {};
  }

  static std::size_t slot_in(std::span<const CycleParameter> parameters, const Word& word) {
    const auto found = std::ranges::find_if(parameters, [&](const CycleParameter& parameter) {
      return word.spelled != nullptr && word.letter == parameter.letter &&
             std::string_view(word.spelled) == parameter.spelled;
    });
    return static_cast<std::size_t>(found - parameters.begin());
  }

  // CYCLE82(10,0,2,-15,,1)
  [[nodiscard]] std::string cycle_text(std::string_view name,
                                       std::span<const CycleParameter> parameters) const {
    std::vector<std::string> slots;
    for (const Word& word : block_.words) {
      const std::size_t slot = slot_in(parameters, word);
      if (slot == parameters.size()) continue;
      slots.resize(std::max(slots.size(), slot + 1));
      slots.at(slot) = measured(word);
    }
    return fmt::format("{}({})", name, fmt::join(slots, ","));
  }

  [[nodiscard]] std::string swivel_text(std::string_view word) const {
    std::array<std::string, kSwivel.size()> slots;
    if (std::ranges::any_of(block_.comments, is_retract)) slots.front() = "1";
    if (word == "CYCLE800()") {
      return slots.front().empty() ? std::string(word) : "CYCLE800(1,\"0\")";
    }
    slots[1] = "\"\"";
    for (const Word& parameter : block_.words) {
      const std::size_t slot = swivel_slot(parameter);
      if (slot < slots.size()) slots.at(slot) = measured(parameter);
    }
    return fmt::format("CYCLE800({})", fmt::join(slots, ","));
  }

  [[nodiscard]] std::string list_text(std::span<const ExpressionRange> ranges,
                                      ExpressionLevel level) const {
    std::vector<std::string> parts;
    for (const ExpressionRange& range : ranges) {
      parts.push_back(range_text(spelling_, block_, range, level));
    }
    return fmt::format("{}", fmt::join(parts, ","));
  }

  // CTRANS(X,10,Y,20):CROT(Z,30)
  [[nodiscard]] std::string frame_text(const Assignment& setting) const {
    std::vector<std::string> parts;
    for (const FramePart& part : setting.frame) {
      std::vector<std::string> values;
      for (std::size_t i = 0; i < part.axes.size(); ++i) {
        std::string value(1, part.axes[i]);
        if (i < part.values.size()) {
          value += "," + range_text(spelling_, block_, part.values[i], sum);
        }
        values.push_back(std::move(value));
      }
      parts.push_back(fmt::format("{}({})", part.name, fmt::join(values, ",")));
    }
    return fmt::format("{}", fmt::join(parts, ":"));
  }

  // 5, SET(1,2,3), REP(0)
  [[nodiscard]] std::string values_text(const Assignment& setting) const {
    const std::string first = range_text(spelling_, block_, setting.value, disjunction);
    if (setting.fills) return fmt::format("REP({})", first);
    const bool whole_array = setting.defines && !setting.indices.empty();
    if (setting.more.empty() && !whole_array) return first;
    return fmt::format("SET({}{}{})", first, setting.more.empty() ? "" : ",",
                       list_text(setting.more, disjunction));
  }

  // R1=2 R[R1]=3 WIDTH=4, DEF REAL WIDTH=4, DEPTH=0
  [[nodiscard]] std::string settings_text() const {
    std::string text;
    for (const Assignment& setting : block_.assignments) {
      if (setting.defines) {
        text += text.empty() ? fmt::format("DEF {} ", sinumerik_type(*setting.defines)) : ",";
      } else if (!text.empty()) {
        text += ' ';
      }
      text += setting.name
                  ? block_.names[*setting.name]
                  : fmt::format("R[{}]", range_text(spelling_, block_, setting.index, sum));
      if (!setting.indices.empty()) text += "[" + list_text(setting.indices, sum) + "]";
      if (!setting.value.empty()) text += "=" + values_text(setting);
      if (!setting.frame.empty()) text += "=" + frame_text(setting);
    }
    return text;
  }

  const Block& block_;
  const ExpressionSpelling& spelling_;
};

}  // namespace

BlockWriter sinumerik_writer() {
  return [](const Block& block) { return SinumerikBlock(block)(); };
}

}  // namespace frustum::parser
