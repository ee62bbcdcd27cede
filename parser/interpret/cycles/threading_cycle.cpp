#include "parser/interpret/cycles/threading_cycle.hpp"

#include <cmath>

namespace frustum::parser {
namespace {

// mm: a pass that leaves less than this is the last one.
constexpr double kSameDepth = 1e-9;

double depth_of(const ThreadingCycle& cycle, int pass) {
  return cycle.first_depth * std::pow(pass, 1.0 / cycle.degression);
}

void add_pass(const ThreadingCycle& cycle, double depth, std::vector<ThreadMove>& moves) {
  const double side = cycle.crest < 0.0 ? -1.0 : 1.0;
  const double along = cycle.end_z < cycle.start_z ? -1.0 : 1.0;
  const double slide = along * std::tan(cycle.slide_angle);
  const double groove = cycle.start_x + cycle.crest + side * depth;
  const double crest = groove - side * cycle.full_depth;
  const double clear = cycle.start_x - side * (cycle.full_depth - depth);
  const double from = cycle.start_z + slide * depth;
  const double to = cycle.end_z - slide * (cycle.full_depth - depth);
  const bool tapers_in = cycle.taper > 0.0 && cycle.tapers_in;
  const bool tapers_out = cycle.taper > 0.0 && cycle.tapers_out;
  const double taper_lead =
      cycle.taper > 0.0 ? cycle.lead * std::hypot(cycle.taper, cycle.full_depth) / cycle.taper
                        : 0.0;

  moves.push_back({clear, from});
  if (tapers_in) {
    moves.push_back({crest, from, taper_lead});
    moves.push_back({groove, from + along * cycle.taper, taper_lead});
  } else {
    moves.push_back({groove, from});
  }
  if (tapers_out) {
    moves.push_back({groove, to - along * cycle.taper, cycle.lead});
    moves.push_back({crest, to, taper_lead});
  } else {
    moves.push_back({groove, to, cycle.lead});
  }
  moves.push_back({clear, to});
}

}  // namespace

double ThreadingCycle::passes() const {
  return std::ceil(std::pow(full_depth / first_depth, degression)) + spring_passes;
}

std::vector<ThreadMove> moves_of(const ThreadingCycle& cycle) {
  std::vector<ThreadMove> moves;
  for (int pass = 1; depth_of(cycle, pass) < cycle.full_depth - kSameDepth; ++pass) {
    add_pass(cycle, depth_of(cycle, pass), moves);
  }
  for (int pass = 0; pass <= cycle.spring_passes; ++pass) {
    add_pass(cycle, cycle.full_depth, moves);
  }
  moves.push_back({cycle.start_x, cycle.end_z});
  return moves;
}

}  // namespace frustum::parser
