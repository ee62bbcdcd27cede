// frustum: a virtual five-axis machine tool on the command line.
#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/listing/listing_commands.hpp"
#include "core/files_read.hpp"

int main(int argc, char** argv) {
  using namespace frustum::app;  // NOLINT: main is the whole program
  frustum::keep_what_is_read();
  return run_command_line(
      {.name = "frustum",
       .description =
           "Frustum: a virtual five-axis machine tool. NC text goes in, a CMM report comes out.\n"
           "Exit codes: 0 done and within tolerance, 1 a tolerance or check failed, 2 the input is "
           "wrong, 3 internal fault.",
       .version = FRUSTUM_VERSION},
      {add_run,       add_sensitivity, add_identify, add_design,     add_program,  add_parse,
       add_check,     add_post,        add_diff,     add_compensate, add_compare,  add_pose,
       add_cut,       add_view,        add_measure,  add_cmm,        add_fit,      add_machines,
       add_errors,    add_volumetric,  add_study,    add_motion,     add_dynamics, add_history,
       add_benchmark, add_serve,       add_tools,    add_reference},
      argc, argv);
}
