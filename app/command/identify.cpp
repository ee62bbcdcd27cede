// frustum identify: the machine errors that explain measured test pieces.
#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/motion/measured_motion.hpp"
#include "app/view/console.hpp"
#include "app/view/identification_view.hpp"

namespace frustum::app {
namespace {

struct IdentifyOptions : AnswerOptions {
  std::string study{};
};

int show_identification(const IdentifyOptions& options) {
  const auto study = load_study(options.study, read_measured_motion);
  if (!study) return refuse(study.error(), options);
  const auto result =
      with_progress(options, "identify", [&](report::Progress&) { return identify_study(*study); });
  if (!result) {
    Diagnostics problems = result.error();
    for (Diagnostic& d : problems) {
      if (d.file.empty()) d.file = options.study;
    }
    return refuse(problems, options);
  }
  if (options.json) {
    std::cout << identification_json(*study, *result);
  } else if (!options.quiet) {
    std::cout << identification_text(*study, *result);
  }
  const auto& identification = result->identification;
  const bool holds = is_answered(*result) && !identification.agreement.rejected;
  return holds ? kDone : kOutOfTolerance;
}

}  // namespace

void add_identify(Command& program) {
  auto o = std::make_shared<IdentifyOptions>();
  Command command = program.command(
      "identify",
      "Machine errors that explain measured test pieces and motion tests, with uncertainties");
  command
      .option("STUDY", o->study,
              "Study file: parts and motion tests, what was measured, what is known")
      .required();
  add_answer_options(command, *o);
  command.footer(
      "Exit code 1: errors of the study that the measurements do not identify (what they leave "
      "open "
      "of set-ups does not count), or measurements that the machine model does not explain.\n"
      "Example: frustum identify examples/ibaraki-2010/study.toml");
  command.computes([o] { return show_identification(*o); });
}

}  // namespace frustum::app
