// The command line: commands, and tables of their options. Only command_line.cpp knows the library
// that reads them.
//
// A command declares each option with its name, where its value goes, one line of help, and what
// holds of it:
//
//     command.option("--criterion", o->criterion, "ls (default), mz").one_of({"ls", "mz"});
//     command.flag("--json", o->json, "One JSON document on stdout");
//     command.runs([o] { return fit(*o); });
//
// Units  : as each option says
// Errors : what a user may write wrongly is reported on stderr, with kBadInput as exit code, before
//          a command runs
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/view/command_facts.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace frustum::app {

// Says what is wrong with the text of a value; empty where nothing is.
using ValueCheck = std::function<std::string(const std::string&)>;

// A finite number above 0 and at most `largest`; "nan" is none.
[[nodiscard]] ValueCheck positive_number(double largest = 1e12);

class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& one_of(std::vector<std::string> words);
  Option& holds(ValueCheck check);
  Option& existing_folder();
  // Several values in one word.
  Option& separated_by(char delimiter);
  // --help shows what the value is without the option.
  Option& default_shown();
  // For int, unsigned and std::uint64_t.
  template <typename Number>
  Option& within(Number smallest, Number largest);

 private:
  CLI::Option* option_;
};

// One command, or a group of commands. A copy is the same command.
class Command {
 public:
  Command(CLI::App* app, int* exit_code) : app_(app), exit_code_(exit_code) {}

  [[nodiscard]] Command command(const std::string& name, const std::string& help);
  // One of the commands within must be given.
  void needs_a_command();

  // A name with dashes, or several ("-o,--out"), or none for a value without a name. For
  // std::string, double, int, unsigned, std::uint64_t, each of them optional, and
  // std::vector<std::string>, which may be repeated. The target outlives the command line.
  template <typename Target>
  Option option(const std::string& names, Target& target, const std::string& help);
  Option flag(const std::string& names, bool& target, const std::string& help);
  void footer(const std::string& text);

  // What the command does; its result is the exit code of the program.
  void runs(std::function<int()> action);
  // The same for a command that computes: it has --threads, with the same result for any number.
  void computes(std::function<int()> action);
  // Whether the option was given; known when the command runs.
  [[nodiscard]] bool was_given(const std::string& name) const;
  // Of it and of all commands within.
  [[nodiscard]] CommandFacts facts() const;

 private:
  CLI::App* app_;
  int* exit_code_;
};

// Adds itself to the command line.
using AddsCommand = void (*)(Command& program);

struct ProgramText {
  std::string name{};
  std::string description{};
  std::string version{};
};

// Reads the arguments and runs the command that they name. Returns the exit code.
[[nodiscard]] int run_command_line(const ProgramText& program,
                                   const std::vector<AddsCommand>& commands, int argc, char** argv);

}  // namespace frustum::app
