#include "kinematics/path/travel.hpp"

namespace frustum::kinematics {

Travel travel(const Machine& machine, const Setup& setup, const CommandedProgram& commanded,
              const GeometricErrors& errors, const TravelOptions& options) {
  PathRecorder recorder(machine, setup, errors, commanded.start, options);
  for (const CommandedStep& step : commanded.steps) recorder.follow(step);
  Travel done{.path = recorder.finish()};
  done.cycle_time = recorder.clock();
  return done;
}

}  // namespace frustum::kinematics
