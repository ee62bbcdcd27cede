#include "kinematics/controller/commanded_program.hpp"

namespace frustum::kinematics {

std::vector<AxisSample> block_ends(const CommandedProgram& program) {
  std::vector<AxisSample> ends{{.kind = PathKind::rapid, .axes = program.start}};
  ends.reserve(program.steps.size() + 1);
  for (const CommandedStep& step : program.steps) {
    if (const auto* move = std::get_if<CommandedMove>(&step)) {
      ends.push_back(
          {move->source_line, move->source_file, move->main_line, move->kind, move->motion.end()});
    }
  }
  return ends;
}

}  // namespace frustum::kinematics
