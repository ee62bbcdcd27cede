// The options by which a command takes a machine and its setup.

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_setup.hpp"
#include "app/view/console.hpp"

namespace frustum::app {

void add_setup_options(Command& command, SetupWords& words) {
  command.option("--machine", words.machine,
                 "Machine file, or the name of a shipped machine (default: the job's)");
  command.option("--job", words.job, "Takes machine, tool lengths and work offsets from a job");
  command.option("--tool-length", words.tool_lengths, "NUMBER=LENGTH in mm, repeated");
  command.option("--tool-diameter", words.tool_diameters,
                 "NUMBER=DIAMETER in mm, which G41 and G42 count with, repeated");
  command.option(
      "--offset", words.offsets,
      "G54=X,Y,Z (G59.1=, G54.1P1=): program origin in the table frame, mm, repeated (G54=0,0,0)");
}

}  // namespace frustum::app
