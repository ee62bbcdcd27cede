#include "parser/interpret/block_comments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

// Comments that speak to someone: (MSG, text), and in LinuxCNC those whose parameters are filled
// in.
struct SpokenComment {
  std::string_view prefix;
  const char* event;
  bool filled;
  bool of_linuxcnc;
  EventGrade grade = EventGrade::known;
};

constexpr const char* kAbort = "abort";

constexpr std::array kSpoken{
    SpokenComment{"MSG,", "message", false, false},
    SpokenComment{"DEBUG,", "debug", true, true},
    SpokenComment{"PRINT,", "print", true, true},
    SpokenComment{"LOG,", "log", true, true},
    SpokenComment{"LOGOPEN,", "logopen", false, true},
    SpokenComment{"LOGAPPEND,", "logappend", false, true},
    SpokenComment{"LOGCLOSE", "logclose", false, true},
    SpokenComment{"ABORT,", kAbort, true, true},
    // Statements of Python, which are the configuration's.
    SpokenComment{"PY,", "py", false, true, EventGrade::builder},
    SpokenComment{"PYRUN,", "pyrun", false, true, EventGrade::builder},
    SpokenComment{"PYRELOAD", "pyreload", false, true},
};

constexpr std::string_view kUnset = "######";

// What stands after the prefix, which may be written in lower case and after blanks.
std::optional<std::string_view> behind(std::string_view comment, std::string_view prefix) {
  const std::size_t start = std::min(comment.find_first_not_of(" \t"), comment.size());
  if (comment.size() - start < prefix.size()) return std::nullopt;
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    if (upper(comment[start + i]) != prefix[i]) return std::nullopt;
  }
  return comment.substr(start + prefix.size());
}

std::string without_blanks_before(std::string text) {
  text.erase(0, std::min(text.find_first_not_of(" \t"), text.size()));
  return text;
}

// %d %f %.3f, as far as the text begins with one: the decimals that it asks for, and its length.
struct Decimals {
  int count = 6;
  std::size_t length = 0;
};

Decimals decimals_at(std::string_view text) {
  constexpr int kOfF = 4;
  if (text.starts_with("%d")) return {0, 2};
  if (text.starts_with("%f")) return {kOfF, 2};
  const bool digit = text.size() > 3 && std::isdigit(static_cast<unsigned char>(text[2])) != 0;
  if (digit && text.starts_with("%.") && text[3] == 'f') return {text[2] - '0', 4};
  return {};
}

// #12, #<name>: its length at the beginning of the text; 0 when there is none.
std::size_t parameter_at(std::string_view text) {
  if (text.starts_with("#<")) {
    const std::size_t end = text.find('>');
    return end == std::string_view::npos ? 0 : end + 1;
  }
  std::size_t length = 1;
  while (length < text.size() && std::isdigit(static_cast<unsigned char>(text[length])) != 0) {
    ++length;
  }
  return length > 1 && text.front() == '#' ? length : 0;
}

std::string value_text(const Parameters& parameters, std::string_view name, int decimals) {
  constexpr std::size_t kMaxDigits = 9;
  Result<double> value = error("unknown-parameter"_id, "");
  if (name[1] == '<') {
    value = parameters.read(bare_name(name.substr(2, name.size() - 3)));
  } else if (name.size() <= kMaxDigits) {
    value = parameters.read(std::stod(std::string(name.substr(1))));
  }
  return value && !is_vacant(*value) ? fmt::format("{:.{}f}", *value, decimals)
                                     : std::string(kUnset);
}

// The text with its parameters filled in.
std::string filled(std::string_view text, const Parameters& parameters) {
  std::string result;
  int decimals = Decimals{}.count;
  while (!text.empty()) {
    const Decimals format = decimals_at(text);
    const std::size_t name = parameter_at(text);
    if (format.length > 0) {
      decimals = format.count;
      text.remove_prefix(format.length);
    } else if (name > 0) {
      result += value_text(parameters, text.substr(0, name), decimals);
      text.remove_prefix(name);
    } else {
      result += text.front();
      text.remove_prefix(1);
    }
  }
  return result;
}

}  // namespace

Outcome report_comments(InterpreterState& state, const Block& block) {
  state.at_work.block = &block;
  for (const Comment& comment : block.comments) {
    // A ; by itself ends a block.
    if (comment.to_line_end && comment.text.empty()) continue;
    if (comment.event != nullptr) {
      if (comment.assumed) {
        assume(state, comment.column, comment.event, comment.text);
        continue;
      }
      emit(state, comment.column,
           Event{comment.event, comment.text,
                 comment.of_builder ? EventGrade::builder : EventGrade::known});
      continue;
    }
    Event event{"comment", comment.text};
    for (const SpokenComment& spoken : kSpoken) {
      if (spoken.of_linuxcnc && state.rules.dialect != Dialect::linuxcnc) continue;
      const auto text = behind(comment.text, spoken.prefix);
      if (!text) continue;
      event = {spoken.event,
               without_blanks_before(spoken.filled ? filled(*text, state.parameters)
                                                   : std::string(*text)),
               spoken.grade};
      break;
    }
    if (event.name == kAbort) {
      return fail(state, comment.column, "program-alarm"_id,
                  fmt::format("the program stops itself: {}", event.text),
                  "look at the conditions before this block");
    }
    emit(state, comment.column, std::move(event));
  }
  return Done{};
}

void report_events(InterpreterState& state, const BlockWords& words, LetterSet idle) {
  const auto texts_of = [&words](LetterSet letters) {
    std::string text;
    for (LetterSet left = letters & words.given(); !left.empty(); left = left.without_first()) {
      text += (text.empty() ? "" : " ") + words.text_of(left.first());
    }
    return text;
  };
  if (words.builder().empty() && !idle.empty()) {
    assume(state, words[words.first_of(idle)].column, "idle words",
           fmt::format("{} has no meaning beside the move", texts_of(idle)));
  }
  for (const BuilderWord& word : words.builder()) {
    const EventGrade grade = state.control.has(word.word) ? EventGrade::known : EventGrade::builder;
    emit(state, word.column, Event{name_of(word.word), texts_of(idle), grade});
    idle = {};
  }
  for (const GivenCode& word : words.vacant()) {
    const auto written =
        std::find_if(state.at_work.block->words.begin(), state.at_work.block->words.end(),
                     [&](const Word& w) { return w.column == word.column; });
    emit(state, word.column, Event{"vacant", std::string(1, written->letter)});
  }
  for (const GivenCode& event : words.events()) {
    emit(state, event.column, Event{event.code->name(), texts_of(event.code->arguments)});
  }
}

}  // namespace frustum::parser
