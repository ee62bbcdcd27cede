#include "app/view/command_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frustum::app {

std::string spelling_of(const OptionFacts& option) {
  std::string text = fmt::format("{}", fmt::join(option.names, ","));
  if (option.value.empty()) return text;
  if (!option.words.empty()) return text + fmt::format(" {{{}}}", fmt::join(option.words, ","));
  return option.is_positional ? text : text + " " + option.value;
}

std::string synopsis_of(const CommandFacts& command) {
  std::string text = command.name;
  for (const OptionFacts& option : command.options) {
    if (!option.is_positional) continue;
    text += " " + (option.is_required ? option.names.front() : "[" + option.names.front() + "]");
  }
  for (const OptionFacts& option : command.options) {
    if (option.is_required && !option.is_positional) text += " " + spelling_of(option);
  }
  return text + (command.commands.empty() ? " [OPTIONS]" : " COMMAND [OPTIONS]");
}

}  // namespace frustum::app
