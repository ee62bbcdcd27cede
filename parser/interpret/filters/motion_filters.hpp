// The filters that motions pass on their way out: ways on to a contour, roundings and chamfers
// between them, then radius compensation; and last the frames between the words and the coordinates
// of the work offset.
//
// Units : mm, rad
// Errors: a motion that a filter cannot make is Output::failure of the state
#pragma once

#include "parser/interpret/filters/contour_approach.hpp"
#include "parser/interpret/filters/corner_insertion.hpp"
#include "parser/interpret/filters/radius_compensation.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct MotionFilters {
  // From now on the state's output passes them on its way to the sink.
  MotionFilters(InterpreterState& state, const MotionSink& sink);
  MotionFilters(const MotionFilters&) = delete;  // the output looks at them
  MotionFilters& operator=(const MotionFilters&) = delete;

  // Motions pass the corners, or go by: where words in the block of the first move make corners,
  // the others need not wait.
  void pass_corners(InterpreterState& state, bool on);

  ContourApproach approach{};
  CornerInsertion corners{};
  bool passes_corners = false;
  RadiusCompensation radius{};
  SourcePlace radius_since{};        // where it was switched on
  std::uint64_t contour_moves = 0;   // of the radius compensation, up to the last block
  std::uint32_t blocks_at_rest = 0;  // since the last one of them
  RadiusCompensation::Sink to_sink;
  CornerInsertion::Sink to_radius;
  ContourApproach::Sink to_corners;
};

}  // namespace frustum::parser
