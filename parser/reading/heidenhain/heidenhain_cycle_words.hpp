// The cycles of Klartext and the letters that their parameters have: hole_cycle.hpp.
//
// Units : none; values are as written
// Errors: none
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace frustum::parser::klartext_cycles {

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
constexpr std::array kTapInSteps{
    CycleParameter{"Q200", 'u', "Q200=", true}, CycleParameter{"Q201", 'z', "Q201=", true},
    CycleParameter{"Q239", 'r', "Q239=", true}, CycleParameter{"Q203", 'V', "Q203=", true},
    CycleParameter{"Q204", 'v', "Q204="},       CycleParameter{"Q257", 'E', "Q257="},
    CycleParameter{"Q256", 'H', "Q256="},       CycleParameter{"Q336", kWithoutEffect, ""},
    CycleParameter{"Q403", kWithoutEffect, ""}};
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
constexpr std::array kSingleLip{CycleParameter{"Q200", 'u', "Q200=", true},
                                CycleParameter{"Q201", 'z', "Q201=", true},
                                CycleParameter{"Q206", 'f', "Q206=", true},
                                CycleParameter{"Q211", 'P', "Q211="},
                                CycleParameter{"Q203", 'V', "Q203=", true},
                                CycleParameter{"Q204", 'v', "Q204="},
                                CycleParameter{"Q379", 0, ""},
                                CycleParameter{"Q253", kWithoutEffect, ""},
                                CycleParameter{"Q208", 'W', "Q208="},
                                CycleParameter{"Q426", kWithoutEffect, ""},
                                CycleParameter{"Q427", kWithoutEffect, ""},
                                CycleParameter{"Q428", kWithoutEffect, ""},
                                CycleParameter{"Q429", kWithoutEffect, ""},
                                CycleParameter{"Q430", kWithoutEffect, ""},
                                CycleParameter{"Q435", 0, ""},
                                CycleParameter{"Q401", kWithoutEffect, ""},
                                CycleParameter{"Q202", 'Q', "Q202="},
                                CycleParameter{"Q212", 0, ""},
                                CycleParameter{"Q205", kWithoutEffect, ""}};
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
    ParameterCycle{209.0, "CYCL DEF 209", kTapInSteps,
                   "it has Q200 Q201 Q239 Q203 Q204 Q257 Q256 Q336 Q403, for example Q200=+2"},
    ParameterCycle{206.0, "CYCL DEF 206", kTapFloating,
                   "it has Q200 Q201 Q206 Q211 Q203 Q204, for example Q200=+2"},
    ParameterCycle{202.0, "CYCL DEF 202", kBore,
                   "it has Q200 Q201 Q206 Q211 Q208 Q203 Q204 Q214 Q336, for example Q200=+2"},
    ParameterCycle{240.0, "CYCL DEF 240", kCentre,
                   "it has Q200 Q343 Q201 Q344 Q206 Q211 Q203 Q204, for example Q200=+2"},
    ParameterCycle{241.0, "CYCL DEF 241", kSingleLip,
                   "it has Q200 Q201 Q206 Q211 Q203 Q204 Q253 Q208 Q426 to Q430, for example "
                   "Q200=+2"},
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
constexpr std::array kOldCycles{OldCycleParameter{1.0, 1, "CYCL DEF 1.1", 'u'},
                                OldCycleParameter{1.0, 2, "CYCL DEF 1.2", 'z'},
                                OldCycleParameter{1.0, 3, "CYCL DEF 1.3", 'Q'},
                                OldCycleParameter{1.0, 4, "CYCL DEF 1.4", 'P'},
                                OldCycleParameter{1.0, 5, "CYCL DEF 1.5", 'f'},
                                OldCycleParameter{2.0, 1, "CYCL DEF 2.1", 'u'},
                                OldCycleParameter{2.0, 2, "CYCL DEF 2.2", 'z'},
                                OldCycleParameter{2.0, 3, "CYCL DEF 2.3", 'P'},
                                OldCycleParameter{2.0, 4, "CYCL DEF 2.4", 'f'},
                                OldCycleParameter{17.0, 1, "CYCL DEF 17.1", 'u'},
                                OldCycleParameter{17.0, 2, "CYCL DEF 17.2", 'z'},
                                OldCycleParameter{17.0, 3, "CYCL DEF 17.3", 'r'}};
constexpr bool is_old_cycle(double cycle) {
  return std::ranges::any_of(kOldCycles,
                             [cycle](const OldCycleParameter& p) { return p.cycle == cycle; });
}
// Known and not simulated: the spindle's angle, tolerance, load and vibration of the machine.
struct PassedCycle {
  double number;
  const char* event;
};
constexpr std::array kPassedCycles{
    PassedCycle{13.0, "CYCL DEF 13"}, PassedCycle{32.0, "CYCL DEF 32"},
    PassedCycle{239.0, "CYCL DEF 239"}, PassedCycle{332.0, "CYCL DEF 332"},
    PassedCycle{392.0, "CYCL DEF 392"}};

}  // namespace frustum::parser::klartext_cycles
