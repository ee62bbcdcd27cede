// The options by which a command takes errors.

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/error_sources.hpp"
#include "app/view/console.hpp"

namespace frustum::app {

void add_error_options(Command& command, ErrorWords& words) {
  command.option("--error", words.errors,
                 "NAME=VALUE, repeated; overrides the job, for example --error EB0C=30urad");
  command.option("--errors", words.files,
                 "Error file, or the name of a shipped one; repeated; overrides the job");
  command.option("--draw", words.draw, "Seed: draws the errors that are written as distributions");
}

}  // namespace frustum::app
