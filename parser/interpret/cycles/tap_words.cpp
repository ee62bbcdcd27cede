#include "parser/interpret/cycles/tap_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/units.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/cycles/drilling_steps.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

// PIT by _PTAB: in the unit of the program, mm, threads an inch, inches.
double lead_of(const InterpreterState& state, double value, int unit) {
  switch (unit) {
    case 1:
      return value;
    case 2:
      return value == 0.0 ? 0.0 : kMmPerInch / value;
    case 3:
      return value * kMmPerInch;
    default:
      return value * unit_scale(state);
  }
}

// _VARI 1 breaks the chip by _VRT after each _DAM, 2 leaves the hole.
Outcome set_tap_strokes(const InterpreterState& state, const BlockWords& words,
                        DrillingCycle& cycle) {
  const double scale = unit_scale(state);
  // Exact stops, feed forward, jerk.
  if (const auto technology = whole(state, words, 'r', 0, 99999); !technology) {
    return technology.error();
  }
  const auto strokes = whole(state, words, 't', 0, 2);
  if (!strokes) return strokes.error();
  if (*strokes == 0) return Done{};
  cycle.clears = *strokes == 2;
  cycle.first = words['Q'].value != 0.0 ? words['Q'].value * scale : std::abs(cycle.bottom);
  cycle.degression = cycle.first;
  if (words['v'].value > 0.0) cycle.chip = words['v'].value * scale;
  if (cycle.first > cycle.reference - cycle.bottom) {
    return fail(state, words.has('Q') ? words['Q'].column : words['t'].column, "cycle-depth"_id,
                "the first depth of CYCLE84 is not within the hole",
                "give _DAM, how deep each stroke goes");
  }
  if (!pecks(cycle).empty()) return Done{};
  return fail(state, words['Q'].column, "cycle-pecks"_id,
              fmt::format("the cycle makes more than {} pecks", kMostPecks), "give a larger _DAM");
}

// By MPIT or PIT; zero: neither is given.
Result<double> thread_lead(const InterpreterState& state, const BlockWords& words) {
  constexpr double kSame = 1e-6;  // mm: what a lead in inches is rounded by
  const auto unit = whole(state, words, 'f', 0, 3);
  if (!unit) return unit.error();
  const double pitch = lead_of(state, words['k'].value, *unit);
  if (words['m'].value == 0.0) return pitch;
  const auto metric = metric_lead(words['m'].value);
  if (!metric) {
    return fail(state, words['m'].column, "cycle-lead"_id,
                fmt::format("{} is no metric thread", words.text_of('m')),
                "give M3 to M48 by its number, or the lead by PIT");
  }
  if (pitch != 0.0 && std::abs(pitch - *metric) > kSame) {
    return fail(state, words['k'].column, "cycle-lead"_id,
                fmt::format("{} and {} are two leads: {:g} and {:g} mm", words.text_of('m'),
                            words.text_of('k'), *metric, pitch),
                "give one of them");
  }
  return *metric;
}

// SDR of CYCLE840: how the spindle turns on the way back; none: the reverse of the way in.
Result<std::optional<SpindleDirection>> direction_back(const InterpreterState& state,
                                                       const BlockWords& words) {
  const double value = words['s'].value;
  if (value == 0.0) return std::optional<SpindleDirection>{};
  if (value == 3.0) return std::optional(SpindleDirection::clockwise);
  if (value == 4.0) return std::optional(SpindleDirection::counterclockwise);
  return fail(state, words['s'].column, "out-of-range"_id,
              fmt::format("{} is no direction", words.text_of('s')),
              "SDR is 3 (M3) or 4 (M4), or 0 with an encoder: the spindle reverses by itself");
}

}  // namespace

Outcome set_tap(const InterpreterState& state, const BlockWords& words, DrillingCycle& cycle) {
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const auto metric = thread_lead(state, words);
  if (!metric) return metric.error();
  if (*metric == 0.0) {
    return fail(state, code.column, "cycle-lead"_id, code.code->name() + " has no lead",
                "give MPIT, the size of a metric thread, or PIT, its lead");
  }
  cycle.lead = *metric;
  cycle.by_spindle = true;
  cycle.speed = words['s'].value;
  cycle.speed_back = words['l'].value != 0.0 ? words['l'].value : cycle.speed;
  if (!(cycle.speed > 0.0 && cycle.speed_back > 0.0)) {
    return fail(state, words.has('s') ? words['s'].column : code.column, "cycle-speed-missing"_id,
                code.code->name() + " has no spindle speed", "give SST, in revolutions per minute");
  }
  return set_tap_strokes(state, words, cycle);
}

// CYCLE840: with an encoder the axis follows the spindle (ENC 0), else it goes by F, or by the lead
// and S (ENC 1).
Outcome set_floating_tap(InterpreterState& state, const BlockWords& words, DrillingCycle& cycle) {
  if (const auto technology = whole(state, words, 'r', 0, 99999); !technology) {
    return technology.error();
  }
  const auto back = direction_back(state, words);
  if (!back) return back.error();
  cycle.direction_back = *back;
  const auto lead = thread_lead(state, words);
  if (!lead) return lead.error();
  const std::uint32_t column = words[CodeGroup::drilling_cycle].column;
  if (*lead < 0.0) {
    assume(state, column, "CYCLE840 lead",
           "its sign has no effect: the spindle's direction makes a thread left-handed");
  }
  cycle.lead = std::abs(*lead);
  constexpr int kWithout = 1;
  constexpr int kWithoutByLead = 11;
  constexpr int kWithAndDwell = 20;
  const auto encoder = whole(state, words, 't', 0, kWithAndDwell);
  if (!encoder) return encoder.error();
  switch (*encoder) {
    case 0:
      cycle.by_spindle = cycle.lead > 0.0;
      if (cycle.lead == 0.0) {
        assume(state, column, "CYCLE840",
               "without a lead it goes by F: ENC=0 counts as 1 where there is no encoder");
      }
      break;
    case kWithout:
      break;
    case kWithoutByLead:
    case kWithAndDwell:
      assume(state, words['t'].column, "CYCLE840 ENC",
             "11 is without an encoder, by the lead and S; 20 with one, and with the dwell");
      if (cycle.lead == 0.0) {
        return fail(state, column, "cycle-lead"_id,
                    fmt::format("CYCLE840 with {} has no lead", words.text_of('t')),
                    "give MPIT, the size of a metric thread, or PIT, its lead");
      }
      cycle.by_spindle = *encoder == kWithAndDwell;
      break;
    default:
      return fail(state, words['t'].column, "out-of-range"_id,
                  fmt::format("{} is not known", words.text_of('t')),
                  "ENC is 0 or 20 with an encoder, 1 or 11 without");
  }
  if (cycle.by_spindle || cycle.direction_back) return Done{};
  return fail(state, column, "cycle-direction"_id, "CYCLE840 without an encoder has no SDR",
              "give 3 or 4, how the spindle turns on the way back");
}

}  // namespace frustum::parser
