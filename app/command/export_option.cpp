// The option by which a command writes its results in other formats too.
#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"

namespace frustum::app {

void add_export_option(Command& command, std::vector<std::string>& files) {
  command.option("--export", files,
                 "Results in another format, by the extension: .qif (QIF 3.0), .csv, .xml "
                 "(JUnit), .dfq (Q-DAS), .json; may be repeated");
}

}  // namespace frustum::app
