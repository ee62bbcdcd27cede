#include "kinematics/controller/commanded_program.hpp"

namespace frustum::kinematics {

std::vector<AxisSample> block_ends(const CommandedProgram& program) {
  std::vector<AxisSample> ends{{0, PathKind::rapid, program.start}};
  ends.reserve(program.steps.size() + 1);
  for (const CommandedStep& step : program.steps) {
    if (const auto* move = std::get_if<CommandedMove>(&step)) {
      ends.push_back({move->source_line, move->kind, move->motion.end()});
    }
  }
  return ends;
}

}  // namespace frustum::kinematics
