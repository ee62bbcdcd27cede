// CYCL DEF and CYCL CALL of Klartext.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_cycle_words.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

using namespace klartext_cycles;

class CycleReader {
 public:
  explicit CycleReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_cycle(std::uint32_t column) {
    const bool runs_on = in_.next_name().starts_with("DEF");  // CYCL DEF9.1
    const bool defines = runs_on && in_.take_bytes("DEF");
    if (!defines && in_.take_name("CALL")) return read_call(column);
    // Of simulators; no control has it.
    if (!defines && in_.take_name("END")) {
      draft_.add_event("CYCL END", column, in_.text_to(";"));
      block_.comments.back().of_builder = true;
      return end_statement(draft_);
    }
    const auto number = defines ? in_.number() : std::nullopt;
    if (!number) {
      return in_.fail("keyword-missing"_id, column,
                      defines ? "CYCL DEF has no number" : "CYCL without DEF or CALL",
                      "write CYCL DEF 200 and its parameters, or CYCL CALL");
    }
    const double cycle = std::floor(number->value + 1e-6);
    int part = static_cast<int>(std::lround((number->value - cycle) * 10.0));
    if (!number->decimal_point && in_.take('.')) {  // CYCL DEF 9 .1
      constexpr double kNoPart = 100.0;             // no cycle has so many
      part = static_cast<int>(std::min(in_.whole_number().value_or(0.0), kNoPart));
    }
    if (cycle == 9.0) return read_dwell_cycle(part, column);
    if (is_old_cycle(cycle)) return read_old_cycle(cycle, part, column);
    for (const PassedCycle& passed : kPassedCycles) {
      if (cycle == passed.number) return read_passed(passed.event, column);
    }
    if (cycle == 7.0) return read_shift(part, column);
    if (cycle == 8.0) return read_mirror(part, column);
    if (cycle == 10.0) return read_turn(part, column);
    if (cycle == 11.0) return read_scaling(part, column);
    if (cycle == 19.0) return read_tilt(part, column);
    if (cycle == 26.0) return read_axis_scaling(part, column);
    if (cycle == 12.0) return read_program(part, column);
    for (const ParameterCycle& known : kCycles) {
      if (cycle == known.number) return read_parameters(known, column);
    }
    if (cycle >= 800.0 && cycle < 900.0) {
      return in_.fail("not-milling"_id, column, fmt::format("CYCL DEF {} is one of turning", cycle),
                      "programs of lathes are not simulated");
    }
    in_.fail("not-supported"_id, column, fmt::format("CYCL DEF {} is not simulated", cycle),
             "write the cycle out as L blocks");
  }

 private:
  void read_call(std::uint32_t column) {
    if (in_.take_name("POS")) {
      add_code(block_, *find_code(Dialect::heidenhain, "CYCL CALL POS"), column);
      return read_heidenhain_call_at(draft_, "CYCL CALL POS", column);
    }
    if (in_.take_name("PAT")) {
      add_code(block_, *find_code(Dialect::heidenhain, "CYCL CALL PAT"), column);
      return read_heidenhain_call_at(draft_, "CYCL CALL PAT", column);
    }
    add_code(block_, *find_code(Dialect::heidenhain, "CYCL CALL"), column);
    read_heidenhain_elements(draft_, "CYCL CALL");
  }

  // All that belongs to it, over several lines.
  void read_passed(const char* event, std::uint32_t column) {
    std::string text;
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      const std::string part = in_.text_to(";");
      if (!part.empty()) text += (text.empty() ? "" : " ") + part;
    }
    draft_.add_event(event, column, std::move(text));
  }

  // CYCL DEF 1.1 SET UP -2; the words are in the language of the control.
  void read_old_cycle(double cycle, int part, std::uint32_t column) {
    if (part == 0) {
      const char* event = cycle == 1.0 ? "CYCL DEF 1" : cycle == 2.0 ? "CYCL DEF 2" : "CYCL DEF 17";
      return note(draft_, event, column, in_.text_to(";"));
    }
    const auto* known = std::find_if(
        kOldCycles.begin(), kOldCycles.end(),
        [&](const OldCycleParameter& p) { return p.cycle == cycle && p.part == part; });
    if (known == kOldCycles.end()) {
      return in_.fail("unknown-word"_id, column,
                      fmt::format("CYCL DEF {:g} has no part {}", cycle, part),
                      "write CYCL DEF 1.1 SET UP -2 to 1.5 F100");
    }
    while (!in_.letters().empty() || in_.take('.')) {
    }
    add_code(block_, *find_code(Dialect::heidenhain, known->code), column);
    add_value(draft_, known->letter, known->code, column, "");
    end_statement(draft_);
  }

  // CYCL DEF 7.1 X+60, IX+5
  void read_shift(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 7", column, in_.text_to(";"));
    if (in_.peek() == '#') {
      return in_.fail("not-supported"_id, in_.column(), "datums of a table are not simulated",
                      "give the shift by its values: CYCL DEF 7.1 X+60");
    }
    add_code(block_, *find_code(Dialect::heidenhain, "CYCL DEF 7"), column);
    read_heidenhain_axes(draft_, "CYCL DEF 7");
  }

  // CYCL DEF 8.1 X Y; without axes it ends.
  void read_mirror(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 8", column, in_.text_to(";"));
    const std::size_t place = block_.words.size();
    while (!in_.at_end() && in_.peek() != ';') {
      const std::uint32_t axis_column = in_.column();
      const std::string axes = in_.letters();
      const std::size_t other = axes.find_first_not_of("XYZ");
      if (axes.empty() || other != std::string::npos) {
        return in_.fail("unknown-word"_id, axis_column, "CYCL DEF 8 mirrors X, Y and Z",
                        "write CYCL DEF 8.1 X Y");
      }
      for (const char axis : axes) add_number(block_, axis, 0.0, axis_column);
    }
    const bool on = block_.words.size() > place;
    add_code(block_, *find_code(Dialect::heidenhain, on ? "CYCL DEF 8" : "CYCL DEF 8 OFF"), column);
    end_statement(draft_);
  }

  // CYCL DEF 11.1 SCL 0.99
  void read_scaling(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 11", column, in_.text_to(";"));
    const std::uint32_t place = in_.column();
    if (!in_.take_name("SCL")) {
      return in_.fail("value-missing"_id, place, "CYCL DEF 11 has no SCL",
                      "write CYCL DEF 11.1 SCL 0.99");
    }
    add_code(block_, *find_code(Dialect::heidenhain, "CYCL DEF 11"), column);
    for (const char axis : {'X', 'Y', 'Z'}) add_number(block_, axis, 0.0, column);
    add_value(draft_, 'P', "SCL", place, "SCL");
    block_.words.back().decimal_point = true;  // a factor, no thousandths
    end_statement(draft_);
  }

  // CYCL DEF 26.1 X1.4 Y1.4 Z1.4 CCX+15 CCY+20: factors, about a centre or the datum.
  void read_axis_scaling(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 26", column, in_.text_to(";"));
    add_code(block_, *find_code(Dialect::heidenhain, "CYCL DEF 26"), column);
    struct Factor {
      std::string_view name;
      char letter;
      std::string_view centre_name;
      char centre;
      bool has_centre = false;
    };
    std::array factors{Factor{"X", 'I', "CCX", 'X'}, Factor{"Y", 'J', "CCY", 'Y'},
                       Factor{"Z", 'K', "CCZ", 'Z'}};
    bool any = false;
    while (!in_.at_end() && in_.peek() != ';') {
      const std::uint32_t place = in_.column();
      const std::string name = in_.letters();
      const auto is_named = [&](const Factor& f) {
        return name == f.name || name == f.centre_name;
      };
      const auto factor = std::find_if(factors.begin(), factors.end(), is_named);
      if (factor == factors.end()) {
        if (name.empty()) return in_.fail_unexpected("write CYCL DEF 26.1 X0.99 Y0.99 Z0.99");
        return in_.fail("unknown-word"_id, place,
                        fmt::format("{} has no meaning in CYCL DEF 26", name),
                        "it has the factors X Y Z and their centre CCX CCY CCZ");
      }
      const bool centre = name == factor->centre_name;
      add_value(draft_, centre ? factor->centre : factor->letter, name, place,
                centre ? factor->centre_name.data() : factor->name.data());
      if (in_.failed()) return;
      if (centre) {
        factor->has_centre = true;
      } else {
        block_.words.back().decimal_point = any = true;  // a factor, no thousandths
      }
    }
    if (!any) {
      return in_.fail("value-missing"_id, column, "CYCL DEF 26 has no factor",
                      "write CYCL DEF 26.1 X0.99 Y0.99 Z0.99");
    }
    for (const Factor& factor : factors) {
      if (!factor.has_centre) add_number(block_, factor.centre, 0.0, column);
    }
    end_statement(draft_);
  }

  // CYCL DEF 19.1 A+0 B+45 C+0 F500 SETUP2: the spatial angles of PLANE SPATIAL; a feed turns the
  // axes.
  void read_tilt(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 19", column, in_.text_to(";"));
    const bool off = in_.at_end() || in_.peek() == ';';
    add_code(block_, *find_code(Dialect::heidenhain, off ? "CYCL DEF 19 OFF" : "CYCL DEF 19"),
             column);
    std::string given;
    bool turns = false;
    while (!in_.at_end() && in_.peek() != ';') {
      const std::uint32_t place = in_.column();
      const std::string name = in_.letters();
      if (name == "A" || name == "B" || name == "C") {
        add_value(draft_, name.front(), name, place, nullptr);
        given += name;
        continue;
      }
      const bool clearance = name == "SETUP" || name == "ABST" || name == "DIST";
      if (name != "F" && name != "FMAX" && name != "FAUTO" && !clearance) {
        if (name.empty()) return in_.fail_unexpected("write CYCL DEF 19.1 A+0 B+45 C+0");
        return in_.fail("unknown-word"_id, place,
                        fmt::format("{} has no meaning in CYCL DEF 19", name),
                        "it has the angles A B C, F and SETUP");
      }
      if (!turns) add_number(block_, 'd', 1.0, place, "TURN ");
      turns = true;
      if (name == "FMAX" || name == "FAUTO") continue;
      const double value = in_.signed_number(name, place);
      if (clearance) draft_.add_event("CYCL DEF 19 SETUP", place, shortest_decimal(value));
    }
    for (const char angle : {'A', 'B', 'C'}) {
      if (off || in_.failed() || given.find(angle) != std::string::npos) continue;
      // Of one alone the plane is the same whether it is a spatial angle or that of an axis.
      if (given.size() == 1) {
        add_number(block_, angle, 0.0, column);
        continue;
      }
      return in_.fail("value-missing"_id, column, fmt::format("CYCL DEF 19 has no {}", angle),
                      "give all three spatial angles, A B C; of axis angles only the machine knows "
                      "the plane: use PLANE SPATIAL");
    }
    end_statement(draft_);
  }

  // CYCL DEF 12.1 PGM TNC:\\WORK\\SLOT.H, or the name alone.
  void read_program(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 12", column, in_.text_to(";"));
    (void)in_.take_name("PGM");
    read_heidenhain_program_call(draft_, true);
  }

  // CYCL DEF 10.1 ROT+35, IROT+5: about the datum.
  void read_turn(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 10", column, in_.text_to(";"));
    const std::uint32_t place = in_.column();
    const std::string name = in_.letters();
    if (name != "ROT" && name != "IROT") {
      return in_.fail("value-missing"_id, place, "CYCL DEF 10 has no ROT",
                      "write CYCL DEF 10.1 ROT+35");
    }
    add_code(block_, *find_code(Dialect::heidenhain, "CYCL DEF 10"), column);
    add_number(block_, 'X', 0.0, column);
    add_number(block_, 'Y', 0.0, column);
    add_value(draft_, 'R', name, place, name == "ROT" ? "ROT" : "IROT");
    if (name == "IROT") block_.words.back().measure = Measure::incremental;
    end_statement(draft_);
  }

  void read_parameters(const ParameterCycle& cycle, std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, cycle.code), column);
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      const std::uint32_t place = in_.column();
      const std::string name = in_.name();
      // The cycle's name, in the language of the control.
      if (name.empty() && block_.words.size() == 1 && in_.take(in_.peek())) continue;
      if (name.empty()) return in_.fail_unexpected(std::string(cycle.form));
      if (!in_.take('=')) continue;
      const auto known =
          std::find_if(cycle.parameters.begin(), cycle.parameters.end(),
                       [&](const CycleParameter& parameter) { return name == parameter.name; });
      if (known == cycle.parameters.end()) {
        return in_.fail("unknown-word"_id, place,
                        fmt::format("{} has no meaning in {}", name, cycle.code),
                        std::string(cycle.form));
      }
      if (known->letter == 0) {  // of which only zero is simulated
        if (in_.signed_number(name, place) != 0.0) {
          in_.fail("not-supported"_id, place, fmt::format("{} is not simulated", name),
                   "give it the value 0");
        }
        continue;
      }
      if (known->letter == kWithoutEffect) {
        skip_value(name, place);
        continue;
      }
      if (read_feed_source(*known, place)) continue;
      add_value(draft_, known->letter, name, place, known->spelled);
    }
    for (const CycleParameter& parameter : cycle.parameters) {
      const bool given =
          std::any_of(block_.words.begin(), block_.words.end(),
                      [&](const Word& word) { return word.letter == parameter.letter; });
      if (!parameter.needed || given || in_.failed()) continue;
      if (cycle.number == 247.0) {
        return in_.fail("value-missing"_id, column, "CYCL DEF 247 without a number",
                        std::string(cycle.form));
      }
      return in_.fail("value-missing"_id, column,
                      fmt::format("{} has no {}", cycle.code, parameter.name),
                      std::string(cycle.form));
    }
  }

  // Of feeds: by rapid, or as the tool call has it.
  bool read_feed_source(const CycleParameter& parameter, std::uint32_t column) {
    if (parameter.letter != 'f' && parameter.letter != 'W') return false;
    const bool fastest = in_.take_name("MAX") || in_.take_name("FMAX");
    if (!fastest && !in_.take_name("AUTO") && !in_.take_name("FAUTO")) return false;
    add_number(block_, parameter.letter, 0.0, column, parameter.spelled);
    block_.words.back().source = fastest ? ValueSource::fastest : ValueSource::tool_call;
    return true;
  }

  // A number, a parameter, MAX or AUTO.
  void skip_value(const std::string& name, std::uint32_t column) {
    for (const char* word : {"MAX", "FMAX", "AUTO", "FAUTO"}) {
      if (in_.take_name(word)) return;
    }
    const std::uint32_t place = in_.column();
    const bool is_signed = in_.take('-') || in_.take('+');
    if (is_q_parameter(in_.next_name())) return (void)in_.name();
    if (is_signed) in_.go_to(place);
    (void)in_.signed_number(name, column);
  }

  void read_dwell_cycle(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 9", column, in_.text_to(";"));
    const std::uint32_t place = in_.column();
    // "DWELL 2", "V.ZEIT 2", "V.TIME2"
    while (!in_.letters().empty() || in_.take('.')) {
    }
    add_dwell(draft_, in_.signed_number("CYCL DEF 9.1", place), column);
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_heidenhain_cycle(BlockDraft& draft, std::uint32_t column) {
  CycleReader(draft).read_cycle(column);
}

}  // namespace frustum::parser
