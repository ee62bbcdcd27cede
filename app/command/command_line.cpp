#include "app/command/command_line.hpp"

#include <fmt/format.h>

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <type_traits>

#include "app/view/console.hpp"
#include "core/spelling.hpp"

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

namespace {

// The library takes -1 for the largest number there is.
std::string no_sign(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  const bool negative = first != std::string::npos && text[first] == '-';
  return negative ? "must be 0 or more, is " + text : "";
}
template <typename Target>
constexpr bool kIsCount =
    std::is_same_v<Target, unsigned> || std::is_same_v<Target, std::uint64_t> ||
    std::is_same_v<Target, std::optional<unsigned>> ||
    std::is_same_v<Target, std::optional<std::uint64_t>>;

}  // namespace

template <typename Target>
Option Command::option(const std::string& names, Target& target, const std::string& help) {
  CLI::Option* option = app_->add_option(names, target, help);
  if constexpr (kIsCount<Target>) option->check(no_sign);
  return Option(option);
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

void Command::computes(std::function<int()> action) {
  auto threads = std::make_shared<unsigned>(0U);
  option("--threads", *threads, "Threads to compute with (default: one for each processor)")
      .within(1U, 1024U);
  runs([action = std::move(action), threads] {
    std::optional<tbb::global_control> limit;
    if (*threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, *threads);
    return action();
  });
}

bool Command::was_given(const std::string& name) const { return app_->count(name) > 0; }

namespace {

// Of "TEXT:{a,b}" the words; the library tells no other way.
std::vector<std::string> words_in(const std::string& type) {
  std::vector<std::string> words;
  const auto open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos) return words;
  std::istringstream in(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts{.is_required = option.get_required(), .help = option.get_description()};
  if (const std::string usual = option.get_default_str(); !usual.empty()) {
    facts.help += " (default " + usual + ")";
  }
  for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  facts.is_positional = facts.names.empty();
  if (facts.is_positional) facts.names.push_back(option.get_name(true));
  if (option.get_items_expected_max() == 0) return facts;
  const std::string type = option.get_type_name();
  facts.value = type.substr(0, type.find_first_of(": "));
  facts.words = words_in(type);
  return facts;
}

CommandFacts facts_of(const CLI::App& app, const std::string& name) {
  CommandFacts facts{
      .name = name, .description = app.get_description(), .footer = app.get_footer()};
  for (const CLI::Option* option : app.get_options()) facts.options.push_back(facts_of(*option));
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    facts.commands.push_back(facts_of(*each, name + " " + each->get_name()));
  }
  return facts;
}

}  // namespace

CommandFacts Command::facts() const { return facts_of(*app_, app_->get_name()); }

namespace {

// The names that the user has to choose from.
std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* each : commands) names.push_back(each->get_name());
  return names;
}

// The first word that should be a command and is none.
std::optional<Diagnostic> misspelt_command(const CLI::App& program, int argc, char** argv) {
  const auto children = [](const CLI::App* of) -> std::vector<const CLI::App*> {
    return of->get_subcommands([](const CLI::App*) { return true; });
  };
  const CLI::App* at = &program;
  for (int i = 1; i < argc && *argv[i] != '-'; ++i) {
    const auto known = children(at);
    if (known.empty()) return std::nullopt;
    const auto next = std::ranges::find(known, std::string(argv[i]), &CLI::App::get_name);
    if (next == known.end()) {
      return error("unknown-command"_id, fmt::format("'{}' is not a command", argv[i]),
                   suggestion(argv[i], names_of(known)));
    }
    at = *next;
  }
  return std::nullopt;
}

// What the library says, and the option that is near to the one it does not know.
Diagnostic usage_error(const CLI::App& program, const CLI::ParseError& problem) {
  std::string usage = program.get_name(), near;
  const CLI::App* at = &program;
  for (auto used = at->get_subcommands(); !used.empty(); used = at->get_subcommands()) {
    at = used.front();
    usage += " " + at->get_name();
  }
  std::vector<std::string> known;
  for (const CLI::Option* each : at->get_options()) {
    for (const std::string& name : each->get_lnames()) known.push_back(name);
  }
  for (const std::string& word : program.remaining(true)) {
    if (!word.starts_with("--")) continue;
    // Dashes are no letters: four that are right would let half of a short name be wrong.
    const auto meant = nearest_word(word.substr(2, word.find('=') - 2), known);
    if (meant) near = fmt::format("did you mean --{}? ", *meant);
  }
  return error("usage"_id, problem.what(), near + usage + " --help lists what there is");
}

}  // namespace

int run_command_line(const ProgramText& text, const std::vector<AddsCommand>& commands, int argc,
                     char** argv) {
  open_standard_streams();
  CLI::App app{text.description, text.name};
  app.set_version_flag("--version", text.version);
  int exit_code = kDone;
  Command program(&app, &exit_code);
  program.needs_a_command();
  for (const AddsCommand add : commands) add(program);
  const AnswerOptions answer{.json = std::find(argv, argv + argc, std::string_view("--json")) !=
                                     argv + argc};
  if (const auto misspelt = misspelt_command(app, argc, argv)) {
    return output_lost(refuse(*misspelt, answer));
  }
  try {  // exceptions are internal faults: user input is answered with diagnostics
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() != 0) return output_lost(refuse(usage_error(app, problem), answer));
    return output_lost(app.exit(problem));
  } catch (const std::exception& fault) {
    std::cerr << text.name << ": internal fault: " << fault.what() << '\n';
    return kInternalFault;
  }
  return output_lost(exit_code);
}

}  // namespace frustum::app
