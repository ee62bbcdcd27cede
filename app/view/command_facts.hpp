// What the command line knows of its commands, for pages about them.
//
// Units : none. Errors: none
#pragma once

#include <string>
#include <vector>

namespace frustum::app {

struct OptionFacts {
  std::vector<std::string> names{};  // "-o", "--out"; of a value without a name the name in texts
  bool is_positional = false;
  bool is_required = false;
  std::string value{};               // "TEXT", "FLOAT", "UINT"; empty: a flag
  std::vector<std::string> words{};  // that the value is one of; empty: anything
  std::string help{};
};

struct CommandFacts {
  std::string name{};  // "frustum program cone"
  std::string description{};
  std::string footer{};  // with an example
  std::vector<OptionFacts> options{};
  std::vector<CommandFacts> commands{};
};

// "program cone --machine TEXT [OPTIONS]" after the name.
[[nodiscard]] std::string synopsis_of(const CommandFacts& command);
// "-o,--out TEXT", "--element {line,plane}".
[[nodiscard]] std::string spelling_of(const OptionFacts& option);

}  // namespace frustum::app
