#include "parser/interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "parser/interpret/program_run.hpp"
#include "parser/not_milling.hpp"

namespace frustum::parser {

Result<RunSummary> interpret(const Program& program, const MotionSink& sink,
                             const InterpreterOptions& options) {
  if (auto foreign = not_milling(program)) return *std::move(foreign);
  return ProgramRun(program, sink, options)();
}

Result<std::vector<Motion>> motions_of(const Program& program, const InterpreterOptions& options) {
  std::vector<Motion> motions;
  const auto summary = interpret(
      program, [&motions](Motion&& motion) { motions.push_back(std::move(motion)); }, options);
  if (!summary) return summary.error();
  return motions;
}

}  // namespace frustum::parser
