#include "parser/interpret/cycles/canned_cycle.hpp"

#include <algorithm>

namespace frustum::parser {
namespace {

using enum CycleAction;

std::vector<CycleStep> pecks(const CycleDepths& depths, bool clears) {
  std::vector<CycleStep> steps;
  const double top = depths.peck_from.value_or(depths.level);
  for (double depth = top - depths.peck; depth > depths.bottom; depth -= depths.peck) {
    steps.push_back({feed, depth});
    if (clears) steps.push_back({rapid, depths.level});
    if (clears && depths.dwell_above > 0.0) steps.push_back({dwell, depths.dwell_above});
    const double near = depth + depths.chip;
    steps.push_back({rapid, depths.peck_from ? std::min(near, depths.level) : near});
  }
  steps.push_back({feed, depths.bottom});
  if (depths.dwell > 0.0 && depths.peck_from) steps.push_back({dwell, depths.dwell});
  steps.push_back({rapid, depths.clear});
  return steps;
}

std::vector<CycleStep> rigid_tap(const CycleDepths& depths) {
  std::vector<CycleStep> steps{{feed, depths.bottom}};
  if (depths.dwell > 0.0) steps.push_back({dwell, depths.dwell});
  steps.push_back({reverse_spindle});
  steps.push_back({feed, depths.feed_out});
  steps.push_back({rapid, depths.clear});
  return steps;
}

}  // namespace

std::vector<CycleStep> steps_at_hole(MotionMode cycle, const CycleDepths& d) {
  switch (cycle) {
    case MotionMode::peck_short:
      return pecks(d, false);
    case MotionMode::peck:
      return pecks(d, true);
    case MotionMode::drill_dwell:
      return {{feed, d.bottom}, {dwell, d.dwell}, {rapid, d.clear}};
    case MotionMode::tap:
    case MotionMode::tap_left:
      if (d.rigid) return rigid_tap(d);
      return {{feed, d.bottom},   {stop_spindle}, {reverse_spindle}, {dwell, d.dwell},
              {feed, d.feed_out}, {stop_spindle}, {start_spindle},   {rapid, d.clear}};
    case MotionMode::bore:
      return {{feed, d.bottom}, {feed, d.level}, {rapid, d.clear}};
    case MotionMode::bore_stop:
      return {
          {feed, d.bottom}, {dwell, d.dwell}, {stop_spindle}, {rapid, d.clear}, {start_spindle}};
    case MotionMode::fine_bore:
      return {{feed, d.bottom},        {dwell, d.dwell},       {stop_spindle},   {orient_spindle},
              {rapid, d.bottom, true}, {rapid, d.clear, true}, {rapid, d.clear}, {start_spindle}};
    case MotionMode::bore_back:
      if (d.from_level) {
        return {{stop_spindle},   {orient_spindle}, {rapid, d.clear, true},  {rapid, d.level, true},
                {rapid, d.level}, {start_spindle},  {feed, d.bottom},        {dwell, d.dwell},
                {stop_spindle},   {orient_spindle}, {rapid, d.bottom, true}, {rapid, d.clear, true},
                {rapid, d.clear}, {start_spindle}};
      }
      return {{rapid, d.level, true},  {stop_spindle},          {orient_spindle},
              {rapid, d.bottom, true}, {rapid, d.bottom},       {start_spindle},
              {feed, d.back},          {feed, d.bottom},        {stop_spindle},
              {orient_spindle},        {rapid, d.bottom, true}, {rapid, d.clear, true},
              {rapid, d.clear},        {start_spindle}};
    case MotionMode::bore_manual:
      if (d.out_by_hand) {
        return {{feed, d.bottom}, {dwell, d.dwell}, {stop_spindle},  {wait},
                {rapid, d.level}, {start_spindle},  {rapid, d.clear}};
      }
      return {{feed, d.bottom}, {dwell, d.dwell}, {stop_spindle}, {wait}, {start_spindle}};
    case MotionMode::bore_dwell:
      return {{feed, d.bottom}, {dwell, d.dwell}, {feed, d.feed_out}, {rapid, d.clear}};
    default:
      return {{feed, d.bottom}, {rapid, d.clear}};
  }
}

}  // namespace frustum::parser
