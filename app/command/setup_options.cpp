// The options by which a command takes a machine, its set-up and its errors.

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/error_sources.hpp"
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

void add_control_options(Command& command, SetupWords& words) {
  command.option("--start", words.start,
                 "X0,Y0,Z100: where the axes are before the program, in its coordinates, mm and "
                 "degrees (default: the machine's home; without a machine not known)");
  command.option("--builder-word", words.words,
                 "An M or G word of the machine's builder that moves nothing, repeated");
  command.option("--max-blocks", words.max_blocks,
                 "Blocks that may run again before they are an endless loop (default: as the "
                 "machine file says, else 2000000)");
  command
      .option("--decimal-point", words.decimal_point,
              "How numbers without a point count: calculator (X10 is 10 mm) or increment (0.010 "
              "mm) (default: as the machine file says, else calculator)")
      .one_of({"calculator", "increment"});
  command
      .option(
          "--units", words.units,
          "The unit before G20 and G21: mm or inch (default: as the machine file says, else mm, "
          "with a warning)")
      .one_of({"mm", "inch"});
}

void add_error_options(Command& command, ErrorWords& words) {
  command.option("--error", words.errors,
                 "NAME=VALUE, repeated; overrides the job, for example --error EB0C=30urad");
  command.option("--errors", words.files,
                 "Error file, or the name of a shipped one; repeated; overrides the job");
  command.option("--draw", words.draw, "Seed: draws the errors that are written as distributions");
}

}  // namespace frustum::app
