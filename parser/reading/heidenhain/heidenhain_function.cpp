// FUNCTION of Klartext: TCPM, MODE, DWELL; the cycles of the probe.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

// What changes no path: files, counters, the spindle's speed and the feed, the watch over the
// machine, and the display of axes beside X, Y and Z.
struct PassedFunction {
  std::string_view word;
  const char* event;
};
constexpr std::array kPassedFunctions{PassedFunction{"DCM", "FUNCTION DCM"},
                                      PassedFunction{"AFC", "FUNCTION AFC"},
                                      PassedFunction{"COUNT", "FUNCTION COUNT"},
                                      PassedFunction{"FEED", "FUNCTION FEED"},
                                      PassedFunction{"S", "FUNCTION S"},
                                      PassedFunction{"LIFTOFF", "FUNCTION LIFTOFF"},
                                      PassedFunction{"FILECOPY", "FUNCTION FILECOPY"},
                                      PassedFunction{"FILEMOVE", "FUNCTION FILEMOVE"},
                                      PassedFunction{"FILEDELETE", "FUNCTION FILEDELETE"},
                                      PassedFunction{"SPINDLE", "FUNCTION SPINDLE"},
                                      PassedFunction{"PARAXCOMP", "FUNCTION PARAXCOMP"},
                                      PassedFunction{"PROG", "FUNCTION PROG"}};

class FunctionReader {
 public:
  explicit FunctionReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_function(std::uint32_t column) {
    const std::string kind = in_.name();
    if (kind == "RESET") {
      if (!in_.take_name("TCPM")) {
        return in_.fail("keyword-missing"_id, column, "FUNCTION RESET without TCPM",
                        "write FUNCTION RESET TCPM");
      }
      add_code(block_, *find_code(Dialect::heidenhain, "FUNCTION RESET TCPM"), column);
      return read_heidenhain_elements(draft_, "FUNCTION RESET TCPM");
    }
    if (kind == "MODE" || kind == "TURNDATA") {
      const std::uint32_t place = in_.column();
      const std::string mode = in_.next_name();
      if (kind == "MODE" && mode != "TURN" && mode != "GRIND") {
        return note(draft_, "FUNCTION MODE", column, in_.text_to(";"));
      }
      return in_.fail("not-milling"_id, place, fmt::format("FUNCTION {} {}", kind, mode),
                      "programs of lathes and grinding machines are not simulated");
    }
    for (const PassedFunction& passed : kPassedFunctions) {
      if (kind == passed.word) return note(draft_, passed.event, column, in_.text_to(";"));
    }
    if (kind == "DWELL") {
      const std::uint32_t place = in_.column();
      // The number may follow without a blank: TIME2.
      if (in_.letters() != "TIME") {
        return in_.fail("value-missing"_id, place, "FUNCTION DWELL without TIME",
                        "write FUNCTION DWELL TIME2");
      }
      return add_dwell(draft_, in_.signed_number("TIME", place), column);
    }
    if (kind.starts_with("TCPM")) return read_tcpm(column);
    in_.fail("not-supported"_id, column, fmt::format("FUNCTION {} is not simulated", kind),
             "known are FUNCTION TCPM, FUNCTION RESET TCPM, FUNCTION MODE and FUNCTION DWELL");
  }

 private:
  void read_tcpm(std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, "FUNCTION TCPM"), column);
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      const std::uint32_t place = in_.column();
      const std::string name = in_.name();
      const std::string value = in_.name();
      const auto refused = [&](const char* remedy) {
        in_.fail("not-supported"_id, place, fmt::format("{} {} is not simulated", name, value),
                 remedy);
      };
      if (name == "F") {
        // Of the contour or of the tip: the path is the same.
        if (value == "CONT") draft_.add_event("TCPM F", place, value);
        if (value != "TCP" && value != "CONT") refused("the feed is that of the tool tip: F TCP");
      } else if (name == "AXIS") {
        if (value != "POS") refused("rotary words are axis positions: AXIS POS");
      } else if (name == "PATHCTRL" && (value == "AXIS" || value == "VECTOR")) {
        add_code(block_, *find_code(Dialect::heidenhain, "PATHCTRL " + value), place);
      } else if (name == "REFPNT") {
        const bool at_tip = value == "TIP" && in_.take('-') && in_.take_name("TIP");
        if (!at_tip) refused("the reference point is the tool tip: REFPNT TIP-TIP");
      } else if (name.empty()) {
        in_.fail_unexpected("write FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS");
      } else {
        in_.fail("unknown-word"_id, place, fmt::format("{} has no meaning in FUNCTION TCPM", name),
                 "write FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS");
      }
    }
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_heidenhain_function(BlockDraft& draft, std::uint32_t column) {
  FunctionReader(draft).read_function(column);
}

// TCH PROBE 411 and its parameters. Those below 400 put what they measure into any parameter.
void read_heidenhain_probing(BlockDraft& draft, std::uint32_t column) {
  constexpr double kFirstCycle = 400.0;
  LineScanner& in = draft.in;
  const auto number = in.take_name("PROBE") ? in.number() : std::nullopt;
  if (!number || number->value < kFirstCycle) {
    return in.fail("not-supported"_id, column, "TCH PROBE is not simulated",
                   "what a probe finds is not the program's to know: leave it out");
  }
  add_code(draft.block, *find_code(Dialect::heidenhain, "TCH PROBE"), column);
  std::string text = shortest_decimal(number->value);
  while (!in.at_end()) {
    if (in.peek() == ';') {
      draft.read_comment();
      continue;
    }
    const std::string part = in.text_to(";");
    if (!part.empty()) text += " " + part;
  }
  draft.add_event("TCH PROBE", column, std::move(text));
}

}  // namespace frustum::parser
