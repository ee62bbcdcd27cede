// CYCL DEF and CYCL CALL of Klartext.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

// Feeds that are no numbers: hole_cycle.hpp.
constexpr double kFastestFeed = 99'999.0;
constexpr double kFeedOfTool = -1.0;

struct CycleParameter {
  const char* name;
  char letter;  // hole_cycle.hpp
  const char* spelled;
  bool needed = false;
};
// The feed to a deepened start, which Q379 has to leave out.
constexpr char kWithoutEffect = '-';
struct ParameterCycle {
  double number;
  const char* code;
  std::span<const CycleParameter> parameters;
  std::string_view form;
};
constexpr std::array kPreset{CycleParameter{"Q339", 'P', "Q339=", true}};
constexpr std::array kDrill{CycleParameter{"Q200", 'u', "Q200=", true},
                            CycleParameter{"Q201", 'z', "Q201=", true},
                            CycleParameter{"Q206", 'f', "Q206=", true},
                            CycleParameter{"Q202", 'Q', "Q202="},
                            CycleParameter{"Q210", 'w', "Q210="},
                            CycleParameter{"Q203", 'V', "Q203=", true},
                            CycleParameter{"Q204", 'v', "Q204="},
                            CycleParameter{"Q211", 'P', "Q211="},
                            CycleParameter{"Q395", 0, ""}};
constexpr std::array kReam{
    CycleParameter{"Q200", 'u', "Q200=", true}, CycleParameter{"Q201", 'z', "Q201=", true},
    CycleParameter{"Q206", 'f', "Q206=", true}, CycleParameter{"Q211", 'P', "Q211="},
    CycleParameter{"Q208", 'W', "Q208="},       CycleParameter{"Q203", 'V', "Q203=", true},
    CycleParameter{"Q204", 'v', "Q204="}};
constexpr std::array kDeep{
    CycleParameter{"Q200", 'u', "Q200=", true}, CycleParameter{"Q201", 'z', "Q201=", true},
    CycleParameter{"Q206", 'f', "Q206=", true}, CycleParameter{"Q202", 'Q', "Q202=", true},
    CycleParameter{"Q210", 'w', "Q210="},       CycleParameter{"Q203", 'V', "Q203=", true},
    CycleParameter{"Q204", 'v', "Q204="},       CycleParameter{"Q212", 'D', "Q212="},
    CycleParameter{"Q213", 'K', "Q213="},       CycleParameter{"Q205", 'L', "Q205="},
    CycleParameter{"Q211", 'P', "Q211="},       CycleParameter{"Q208", 'W', "Q208="},
    CycleParameter{"Q256", 'H', "Q256="},       CycleParameter{"Q395", 0, ""}};
constexpr std::array kDeepPecks{CycleParameter{"Q200", 'u', "Q200=", true},
                                CycleParameter{"Q201", 'z', "Q201=", true},
                                CycleParameter{"Q206", 'f', "Q206=", true},
                                CycleParameter{"Q202", 'Q', "Q202=", true},
                                CycleParameter{"Q203", 'V', "Q203=", true},
                                CycleParameter{"Q204", 'v', "Q204="},
                                CycleParameter{"Q212", 'D', "Q212="},
                                CycleParameter{"Q205", 'L', "Q205="},
                                CycleParameter{"Q258", 'g', "Q258="},
                                CycleParameter{"Q259", 'h', "Q259="},
                                CycleParameter{"Q257", 'E', "Q257="},
                                CycleParameter{"Q256", 'H', "Q256="},
                                CycleParameter{"Q211", 'P', "Q211="},
                                CycleParameter{"Q379", 0, ""},
                                CycleParameter{"Q253", kWithoutEffect, ""},
                                CycleParameter{"Q208", 'W', "Q208="},
                                CycleParameter{"Q395", 0, ""}};
constexpr std::array kTap{
    CycleParameter{"Q200", 'u', "Q200=", true}, CycleParameter{"Q201", 'z', "Q201=", true},
    CycleParameter{"Q239", 'r', "Q239=", true}, CycleParameter{"Q203", 'V', "Q203=", true},
    CycleParameter{"Q204", 'v', "Q204="}};
constexpr std::array kTapFloating{
    CycleParameter{"Q200", 'u', "Q200=", true}, CycleParameter{"Q201", 'z', "Q201=", true},
    CycleParameter{"Q206", 'f', "Q206=", true}, CycleParameter{"Q211", 'P', "Q211="},
    CycleParameter{"Q203", 'V', "Q203=", true}, CycleParameter{"Q204", 'v', "Q204="}};
constexpr std::array kBore{
    CycleParameter{"Q200", 'u', "Q200=", true}, CycleParameter{"Q201", 'z', "Q201=", true},
    CycleParameter{"Q206", 'f', "Q206=", true}, CycleParameter{"Q211", 'P', "Q211="},
    CycleParameter{"Q208", 'W', "Q208="},       CycleParameter{"Q203", 'V', "Q203=", true},
    CycleParameter{"Q204", 'v', "Q204="},       CycleParameter{"Q214", 'n', "Q214="},
    CycleParameter{"Q336", kWithoutEffect, ""}, CycleParameter{"Q357", 'o', "Q357="}};
constexpr std::array kCentre{
    CycleParameter{"Q200", 'u', "Q200=", true}, CycleParameter{"Q343", 0, ""},
    CycleParameter{"Q201", 'z', "Q201=", true}, CycleParameter{"Q344", kWithoutEffect, ""},
    CycleParameter{"Q206", 'f', "Q206=", true}, CycleParameter{"Q211", 'P', "Q211="},
    CycleParameter{"Q203", 'V', "Q203=", true}, CycleParameter{"Q204", 'v', "Q204="},
    CycleParameter{"Q342", kWithoutEffect, ""}, CycleParameter{"Q253", kWithoutEffect, ""}};
constexpr std::array kRing{
    CycleParameter{"Q216", 'x', "Q216=", true}, CycleParameter{"Q217", 'y', "Q217=", true},
    CycleParameter{"Q244", 'd', "Q244=", true}, CycleParameter{"Q245", 'a', "Q245="},
    CycleParameter{"Q246", 'b', "Q246="},       CycleParameter{"Q247", 'c', "Q247="},
    CycleParameter{"Q241", 'K', "Q241=", true}, CycleParameter{"Q200", 'u', "Q200="},
    CycleParameter{"Q203", 'V', "Q203="},       CycleParameter{"Q204", 'v', "Q204="},
    CycleParameter{"Q301", 'e', "Q301="},       CycleParameter{"Q365", 'l', "Q365="}};
constexpr std::array kGrid{
    CycleParameter{"Q225", 'x', "Q225=", true}, CycleParameter{"Q226", 'y', "Q226=", true},
    CycleParameter{"Q237", 'a', "Q237="},       CycleParameter{"Q238", 'b', "Q238="},
    CycleParameter{"Q242", 'K', "Q242=", true}, CycleParameter{"Q243", 'L', "Q243=", true},
    CycleParameter{"Q224", 'c', "Q224="},       CycleParameter{"Q200", 'u', "Q200="},
    CycleParameter{"Q203", 'V', "Q203="},       CycleParameter{"Q204", 'v', "Q204="},
    CycleParameter{"Q301", 'e', "Q301="}};
constexpr std::array kCycles{
    ParameterCycle{247.0, "CYCL DEF 247", kPreset, "the preset's number is Q339"},
    ParameterCycle{200.0, "CYCL DEF 200", kDrill,
                   "it has Q200 Q201 Q206 Q202 Q210 Q203 Q204 Q211, for example Q200=+2"},
    ParameterCycle{201.0, "CYCL DEF 201", kReam,
                   "it has Q200 Q201 Q206 Q211 Q208 Q203 Q204, for example Q200=+2"},
    ParameterCycle{203.0, "CYCL DEF 203", kDeep,
                   "it has Q200 Q201 Q206 Q202 Q210 Q203 Q204 Q212 Q213 Q205 Q211 Q208 Q256, for "
                   "example Q200=+2"},
    ParameterCycle{205.0, "CYCL DEF 205", kDeepPecks,
                   "it has Q200 Q201 Q206 Q202 Q203 Q204 Q212 Q205 Q258 Q259 Q257 Q256 Q211 Q379 "
                   "Q253 Q208, for example Q200=+2"},
    ParameterCycle{207.0, "CYCL DEF 207", kTap,
                   "it has Q200 Q201 Q239 Q203 Q204, for example Q200=+2"},
    ParameterCycle{206.0, "CYCL DEF 206", kTapFloating,
                   "it has Q200 Q201 Q206 Q211 Q203 Q204, for example Q200=+2"},
    ParameterCycle{202.0, "CYCL DEF 202", kBore,
                   "it has Q200 Q201 Q206 Q211 Q208 Q203 Q204 Q214 Q336, for example Q200=+2"},
    ParameterCycle{240.0, "CYCL DEF 240", kCentre,
                   "it has Q200 Q343 Q201 Q344 Q206 Q211 Q203 Q204, for example Q200=+2"},
    ParameterCycle{220.0, "CYCL DEF 220", kRing,
                   "it has Q216 Q217 Q244 Q245 Q246 Q247 Q241 Q200 Q203 Q204 Q301 Q365, for "
                   "example Q241=+8"},
    ParameterCycle{221.0, "CYCL DEF 221", kGrid,
                   "it has Q225 Q226 Q237 Q238 Q242 Q243 Q224 Q200 Q203 Q204 Q301, for example "
                   "Q242=+6"}};
// Cycles of older controls, whose parameters are in blocks of their own: 1.1 SET UP, 1.2 DEPTH.
struct OldCycleParameter {
  double cycle;
  int part;
  const char* code;
  char letter;
};
constexpr std::array kOldCycles{
    OldCycleParameter{1.0, 1, "CYCL DEF 1.1", 'u'}, OldCycleParameter{1.0, 2, "CYCL DEF 1.2", 'z'},
    OldCycleParameter{1.0, 3, "CYCL DEF 1.3", 'Q'}, OldCycleParameter{1.0, 4, "CYCL DEF 1.4", 'P'},
    OldCycleParameter{1.0, 5, "CYCL DEF 1.5", 'f'}, OldCycleParameter{2.0, 1, "CYCL DEF 2.1", 'u'},
    OldCycleParameter{2.0, 2, "CYCL DEF 2.2", 'z'}, OldCycleParameter{2.0, 3, "CYCL DEF 2.3", 'P'},
    OldCycleParameter{2.0, 4, "CYCL DEF 2.4", 'f'}};
// Known and not simulated: tolerance, load and vibration of the machine.
struct PassedCycle {
  double number;
  const char* event;
};
constexpr std::array kPassedCycles{
    PassedCycle{32.0, "CYCL DEF 32"}, PassedCycle{239.0, "CYCL DEF 239"},
    PassedCycle{332.0, "CYCL DEF 332"}, PassedCycle{392.0, "CYCL DEF 392"}};

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
      part = static_cast<int>(in_.whole_number().value_or(0.0));
    }
    if (cycle == 9.0) return read_dwell_cycle(part, column);
    if (cycle == 1.0 || cycle == 2.0) return read_old_cycle(cycle, part, column);
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
    struct Remedy {
      double cycle;
      const char* text;
    };
    constexpr std::array kRemedies{
        Remedy{209.0, "use CYCL DEF 207, or write the cycle out as L blocks"}};
    if (cycle >= 800.0 && cycle < 900.0) {
      return in_.fail("not-milling"_id, column, fmt::format("CYCL DEF {} is one of turning", cycle),
                      "programs of lathes are not simulated");
    }
    const auto* remedy = std::find_if(kRemedies.begin(), kRemedies.end(),
                                      [&](const Remedy& r) { return r.cycle == cycle; });
    in_.fail("not-supported"_id, column, fmt::format("CYCL DEF {} is not simulated", cycle),
             remedy == kRemedies.end() ? "write the cycle out as L blocks" : remedy->text);
  }

 private:
  void read_call(std::uint32_t column) {
    const std::uint32_t place = in_.column();
    if (in_.take_name("POS")) {
      add_code(block_, *find_code(Dialect::heidenhain, "CYCL CALL POS"), column);
      return read_heidenhain_call_at(draft_, "CYCL CALL POS", column);
    }
    if (in_.take_name("PAT")) {
      return in_.fail("not-supported"_id, place, "CYCL CALL PAT is not simulated",
                      "call the cycle by CYCL CALL POS or M99 at each hole");
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
      return note(draft_, cycle == 1.0 ? "CYCL DEF 1" : "CYCL DEF 2", column, in_.text_to(";"));
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
        (void)in_.signed_number(name, place);
        continue;
      }
      // Of feeds: by rapid, or as the tool call has it.
      if (in_.take_name("MAX") || in_.take_name("FMAX")) {
        add_number(block_, known->letter, kFastestFeed, place, known->spelled);
        continue;
      }
      if (in_.take_name("AUTO") || in_.take_name("FAUTO")) {
        add_number(block_, known->letter, kFeedOfTool, place, known->spelled);
        continue;
      }
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
