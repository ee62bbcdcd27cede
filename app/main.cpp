// frustum: a virtual five-axis machine tool on the command line.
#include <CLI/CLI.hpp>
#include <iostream>

#include "app/view/console.hpp"

int main(int argc, char** argv) {
  using namespace frustum::app;  // NOLINT: main is the whole program
  CLI::App program{
      "Frustum: a virtual five-axis machine tool. NC text goes in, a CMM report comes out.\n"
      "Exit codes: 0 done and within tolerance, 1 a tolerance or check failed, 2 the input is "
      "wrong, "
      "3 internal fault.",
      "frustum"};
  program.require_subcommand(1);
  program.set_version_flag("--version", FRUSTUM_VERSION);
  int exit_code = kDone;
  for (const Subcommand add :
       {add_run, add_sensitivity, add_identify, add_design, add_program, add_parse, add_check,
        add_post, add_diff, add_compensate, add_pose, add_cut, add_measure, add_cmm, add_fit,
        add_machines, add_errors, add_volumetric}) {
    add(program, exit_code);
  }
  try {  // exceptions are internal faults: user input is answered with diagnostics
    program.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    const int code = program.exit(problem);
    return code == 0 ? kDone : kBadInput;
  } catch (const std::exception& fault) {
    std::cerr << "frustum: internal fault: " << fault.what() << '\n';
    return kInternalFault;
  }
  return exit_code;
}
