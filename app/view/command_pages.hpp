// Pages about the commands: for man, for a shell that completes words, for docs/commands.md.
//
// Units : none. Errors: none
#pragma once

#include <map>
#include <string>

#include "app/view/command_facts.hpp"

namespace frustum::app {

// By file name: frustum.1, frustum-run.1, frustum-program-cone.1, ...
[[nodiscard]] std::map<std::string, std::string> man_pages(const CommandFacts& program,
                                                           const std::string& version);
// Commands, their options, words that an option takes, else files.
[[nodiscard]] std::string bash_completion(const CommandFacts& program);
[[nodiscard]] std::string zsh_completion(const CommandFacts& program);
[[nodiscard]] std::string commands_markdown(const CommandFacts& program);

}  // namespace frustum::app
