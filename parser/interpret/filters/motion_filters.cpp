#include "parser/interpret/filters/motion_filters.hpp"

#include <utility>
#include <variant>

namespace frustum::parser {
namespace {

bool moves_axes(const Command& command) {
  return std::holds_alternative<Traverse>(command) || std::holds_alternative<HomeReturn>(command) ||
         std::holds_alternative<LinearFeed>(command) || std::holds_alternative<ArcFeed>(command) ||
         std::holds_alternative<Probe>(command);
}

void place_and_send(InterpreterState& state, const MotionSink& sink, Motion&& motion) {
  const ModalState& modes = state.modes;
  if (!modes.programmed_frame.is_identity()) modes.programmed_frame.place(motion.command);
  if (modes.tool_lengthening != 0.0) {
    ProgrammedFrame above;
    above.shift.z() = modes.tool_lengthening;
    above.place(motion.command);
  }
  if (!modes.offset_frame.is_identity()) modes.offset_frame.place(motion.command);
  if (moves_axes(motion.command)) ++state.output.moves;
  sink(std::move(motion));
}

// The first failure of a block counts.
void keep_failure(Output& output, std::optional<Diagnostic>&& failure) {
  if (failure && !output.failure) output.failure = std::move(failure);
}

}  // namespace

MotionFilters::MotionFilters(InterpreterState& state, const MotionSink& sink)
    : to_sink([&state, &sink](Motion&& motion) { place_and_send(state, sink, std::move(motion)); }),
      to_radius([this, &state](Motion&& motion) {
        if (!radius.is_on()) return to_sink(std::move(motion));
        keep_failure(state.output, radius.take(std::move(motion), to_sink));
      }),
      to_corners([this, &state](Motion&& motion) {
        if (const auto contour = approach.take_arrival()) corners.start(*contour);
        keep_failure(state.output, corners.take(std::move(motion), to_radius));
      }) {
  pass_corners(state, state.rules.inserts_corners);
}

void MotionFilters::pass_corners(InterpreterState& state, bool on) {
  passes_corners = on;
  if (!on) {
    state.output.take = to_radius;
    return;
  }
  state.output.take = [this, &state](Motion&& motion) {
    keep_failure(state.output, approach.take(std::move(motion), to_corners, to_sink, radius));
  };
}

}  // namespace frustum::parser
