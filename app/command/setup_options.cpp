// The options by which a command takes a machine and its setup.
#include <CLI/CLI.hpp>

#include "app/job/machine_setup.hpp"
#include "app/view/console.hpp"

namespace frustum::app {

void add_setup_options(CLI::App& command, SetupWords& words) {
  command.add_option("--machine", words.machine,
                     "Machine file, or the name of a shipped machine (default: the job's)");
  command.add_option("--job", words.job, "Takes machine, tool lengths and work offsets from a job");
  command.add_option("--tool-length", words.tool_lengths, "NUMBER=LENGTH in mm, repeated");
  command.add_option("--tool-diameter", words.tool_diameters,
                     "NUMBER=DIAMETER in mm, which G41 and G42 count with, repeated");
  command.add_option(
      "--offset", words.offsets,
      "G54=X,Y,Z (G59.1=, G54.1P1=): program origin in the table frame, mm, repeated (G54=0,0,0)");
}

}  // namespace frustum::app
