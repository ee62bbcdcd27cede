// The options by which a command takes errors.
#include <CLI/CLI.hpp>

#include "app/job/error_sources.hpp"
#include "app/view/console.hpp"

namespace frustum::app {

void add_error_options(CLI::App& command, ErrorWords& words) {
  command.add_option("--error", words.errors,
                     "NAME=VALUE, repeated; overrides the job, for example --error EB0C=30urad");
  command.add_option("--errors", words.files,
                     "Error file, or the name of a shipped one; repeated; overrides the job");
  command.add_option("--draw", words.draw,
                     "Seed: draws the errors that are written as distributions");
}

}  // namespace frustum::app
