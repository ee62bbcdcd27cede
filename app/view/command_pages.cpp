#include "app/view/command_pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace frustum::app {
namespace {

void for_all(const CommandFacts& command, const auto& visit) {
  visit(command);
  for (const CommandFacts& each : command.commands) for_all(each, visit);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// A line of troff that begins with neither . nor ' and keeps its dashes and backslashes.
std::string roff(const std::string& text) {
  std::string line = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  line = replaced(line, "\n", "\n.br\n");
  return line.starts_with('.') || line.starts_with('\'') ? "\\&" + line : line;
}

std::string page_name(const CommandFacts& command) { return replaced(command.name, " ", "-"); }

std::string man_page(const CommandFacts& command, const std::string& version) {
  std::string upper = page_name(command);
  std::ranges::transform(upper, upper.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  });
  const std::string first_line = command.description.substr(0, command.description.find('\n'));
  std::string page = fmt::format(".TH \"{}\" 1 \"\" \"Frustum {}\" \"Frustum\"\n", upper, version);
  page += fmt::format(".SH NAME\n{} \\- {}\n", roff(page_name(command)), roff(first_line));
  page += fmt::format(".SH SYNOPSIS\n.B {}\n", roff(synopsis_of(command)));
  page += fmt::format(".SH DESCRIPTION\n{}\n", roff(command.description));
  if (!command.commands.empty()) {
    page += ".SH COMMANDS\n";
    for (const CommandFacts& each : command.commands) {
      page +=
          fmt::format(".TP\n.B {}\n{}\n", roff(page_name(each)) + "(1)", roff(each.description));
    }
  }
  page += ".SH OPTIONS\n";
  for (const OptionFacts& option : command.options) {
    page += fmt::format(".TP\n.B {}\n{}{}\n", roff(spelling_of(option)), roff(option.help),
                        option.is_required ? " (required)" : "");
  }
  if (!command.footer.empty()) page += fmt::format(".SH NOTES\n{}\n", roff(command.footer));
  page +=
      ".SH EXIT STATUS\n0 done and within tolerance; 1 a tolerance or check failed; 2 the input is "
      "wrong; 3 internal fault.\n";
  return page;
}

std::vector<std::string> words_after(const CommandFacts& command) {
  std::vector<std::string> words;
  for (const CommandFacts& each : command.commands) {
    words.push_back(each.name.substr(each.name.rfind(' ') + 1));
  }
  for (const OptionFacts& option : command.options) {
    const auto& offered = option.is_positional ? option.words : option.names;
    words.insert(words.end(), offered.begin(), offered.end());
  }
  return words;
}

}  // namespace

std::map<std::string, std::string> man_pages(const CommandFacts& program,
                                             const std::string& version) {
  std::map<std::string, std::string> pages;
  for_all(program, [&](const CommandFacts& command) {
    pages[page_name(command) + ".1"] = man_page(command, version);
  });
  return pages;
}

std::string bash_completion(const CommandFacts& program) {
  std::string commands, options, values;
  for_all(program, [&](const CommandFacts& command) {
    if (!command.commands.empty()) {
      std::vector<std::string> names;
      for (const CommandFacts& each : command.commands) names.push_back("\"" + each.name + "\"");
      commands += fmt::format("{}{}", commands.empty() ? "" : "|", fmt::join(names, "|"));
    }
    std::vector<std::string> named;
    for (const OptionFacts& option : command.options) {
      if (option.is_positional) named.insert(named.end(), option.words.begin(), option.words.end());
    }
    options += fmt::format("    \"{}\") words=\"{}\" named=\"{}\" files={} ;;\n", command.name,
                           fmt::join(words_after(command), " "), fmt::join(named, " "),
                           command.commands.empty() ? "yes" : "");
    for (const OptionFacts& option : command.options) {
      if (option.words.empty() || option.is_positional) continue;
      for (const std::string& name : option.names) {
        values += fmt::format("    \"{} {}\") words=\"{}\" ;;\n", command.name, name,
                              fmt::join(option.words, " "));
      }
    }
  });
  return fmt::format(R"(# Completes the words of frustum in bash.
_frustum() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} path=frustum words="" files="" named="" i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$path ${{COMP_WORDS[i]}}" in
    {}) path="$path ${{COMP_WORDS[i]}}" ;;
    *) break ;;
    esac
  done
  case "$path $before" in
{}  esac
  if [[ -n $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    return
  fi
  case "$path" in
{}  esac
  # What is not an option of a command that has none within is a file.
  [[ $word == -* || -z $files ]] || words=$named
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o bashdefault -o default -F _frustum frustum
)",
                     commands, values, options);
}

std::string zsh_completion(const CommandFacts& program) {
  return "#compdef frustum\nautoload -U +X bashcompinit && bashcompinit\n" +
         bash_completion(program);
}

std::string commands_markdown(const CommandFacts& program) {
  std::string page =
      "# Commands\n\nEvery command with its options, as `--help` prints them; this page is written "
      "by "
      "`frustum reference --markdown`.\n\n" +
      replaced(program.description, "\n", "\n\n") + "\n";
  for_all(program, [&](const CommandFacts& command) {
    if (&command == &program) return;
    page += fmt::format("\n## {}\n\n{}\n\n    {}\n", command.name, command.description,
                        synopsis_of(command));
    if (!command.commands.empty()) return;
    page += "\n| option | meaning |\n| --- | --- |\n";
    for (const OptionFacts& option : command.options) {
      page += fmt::format("| `{}` | {}{} |\n", replaced(spelling_of(option), "|", "\\|"),
                          replaced(replaced(option.help, "|", "\\|"), "\n", " "),
                          option.is_required ? " (required)" : "");
    }
    if (!command.footer.empty()) page += "\n" + replaced(command.footer, "\n", "\n\n") + "\n";
  });
  return page;
}

}  // namespace frustum::app
