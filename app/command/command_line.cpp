#include "app/command/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "app/view/console.hpp"

namespace frustum::app {

ValueCheck positive_number(double largest) {
  return [largest](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool is_number = !text.empty() && *end == '\0' && std::isfinite(value);
    if (!is_number || !(value > 0.0)) return "must be a number above 0, is " + text;
    return value > largest ? fmt::format("must be at most {:g}, is {}", largest, text) : "";
  };
}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::one_of(std::vector<std::string> words) {
  option_->check(CLI::IsMember(std::move(words)));
  return *this;
}

Option& Option::holds(ValueCheck check) {
  option_->check(std::move(check));
  return *this;
}

Option& Option::existing_folder() {
  option_->check(CLI::ExistingDirectory);
  return *this;
}

Option& Option::separated_by(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}

Option& Option::default_shown() {
  option_->capture_default_str();
  return *this;
}

template <typename Number>
Option& Option::within(Number smallest, Number largest) {
  option_->check(CLI::Range(smallest, largest));
  return *this;
}

template Option& Option::within(int smallest, int largest);
template Option& Option::within(unsigned smallest, unsigned largest);
template Option& Option::within(std::uint64_t smallest, std::uint64_t largest);

Command Command::command(const std::string& name, const std::string& help) {
  return {app_->add_subcommand(name, help), exit_code_};
}

void Command::needs_a_command() { app_->require_subcommand(1); }

template <typename Target>
Option Command::option(const std::string& names, Target& target, const std::string& help) {
  return Option(app_->add_option(names, target, help));
}

template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&, int&, const std::string&);
template Option Command::option(const std::string&, unsigned&, const std::string&);
template Option Command::option(const std::string&, std::uint64_t&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::string>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::option(const std::string&, std::optional<int>&, const std::string&);
template Option Command::option(const std::string&, std::optional<unsigned>&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::uint64_t>&,
                                const std::string&);

Option Command::flag(const std::string& names, bool& target, const std::string& help) {
  return Option(app_->add_flag(names, target, help));
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::runs(std::function<int()> action) {
  app_->callback([action = std::move(action), exit_code = exit_code_] { *exit_code = action(); });
}

bool Command::was_given(const std::string& name) const { return app_->count(name) > 0; }

int run_command_line(const ProgramText& text, const std::vector<AddsCommand>& commands, int argc,
                     char** argv) {
  open_standard_streams();
  CLI::App app{text.description, text.name};
  app.set_version_flag("--version", text.version);
  int exit_code = kDone;
  Command program(&app, &exit_code);
  program.needs_a_command();
  for (const AddsCommand add : commands) add(program);
  try {  // exceptions are internal faults: user input is answered with diagnostics
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return output_lost(app.exit(problem) == 0 ? kDone : kBadInput);
  } catch (const std::exception& fault) {
    std::cerr << text.name << ": internal fault: " << fault.what() << '\n';
    return kInternalFault;
  }
  return output_lost(exit_code);
}

}  // namespace frustum::app
