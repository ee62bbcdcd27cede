// frustum reference: pages about the commands, for man, for shells and for the documents.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/view/command_pages.hpp"
#include "core/file_set.hpp"
#include "core/program_version.hpp"
#include "core/whole_file.hpp"

namespace frustum::app {
namespace {

struct ReferenceOptions : AnswerOptions {
  std::string man{};
  std::string completion{};
  std::string markdown{};
};

nlohmann::ordered_json json_of(const CommandFacts& command) {
  nlohmann::ordered_json options = nlohmann::ordered_json::array();
  for (const OptionFacts& option : command.options) {
    options.push_back({{"names", option.names},
                       {"positional", option.is_positional},
                       {"required", option.is_required},
                       {"value", option.value},
                       {"words", option.words},
                       {"help", option.help}});
  }
  nlohmann::ordered_json commands = nlohmann::ordered_json::array();
  for (const CommandFacts& each : command.commands) commands.push_back(json_of(each));
  return {{"name", command.name},
          {"description", command.description},
          {"options", options},
          {"commands", commands}};
}

int write_reference(const ReferenceOptions& options, const CommandFacts& program) {
  if (options.man.empty() && options.completion.empty() && options.markdown.empty()) {
    if (options.json) {
      std::cout << nlohmann::ordered_json{{"schema", "frustum/reference/1"},
                                          {"version", program_version()},
                                          {"program", json_of(program)}}
                       .dump(1)
                << '\n';
    } else if (!options.quiet) {
      std::cout << commands_markdown(program);
    }
    return kDone;
  }
  const auto write_into = [&](const std::string& folder,
                              const std::map<std::string, std::string>& files) -> Diagnostics {
    if (folder.empty()) return {};
    std::vector<std::string> names;
    for (const auto& [name, text] : files) names.push_back(name);
    auto set = FileSet::open(folder, names);
    if (!set) return set.error();
    for (const auto& [name, text] : files) set->add(name, text);
    const auto written = set->write();
    return written ? Diagnostics{} : written.error();
  };
  if (auto problems = write_into(options.man, man_pages(program, FRUSTUM_VERSION));
      !problems.empty()) {
    return refuse(problems, options);
  }
  if (auto problems = write_into(options.completion, {{"frustum", bash_completion(program)},
                                                      {"_frustum", zsh_completion(program)}});
      !problems.empty()) {
    return refuse(problems, options);
  }
  if (options.markdown.empty()) return kDone;
  const auto written = write_whole_file(options.markdown, commands_markdown(program));
  return written ? kDone : refuse(written.error(), options);
}

}  // namespace

void add_reference(Command& program) {
  auto o = std::make_shared<ReferenceOptions>();
  Command command =
      program.command("reference", "Every command and option: man pages, completion, Markdown");
  command.option("--man", o->man, "Folder for a page of man a command");
  command.option("--completion", o->completion,
                 "Folder for the completion of bash (frustum) and zsh (_frustum)");
  command.option("--markdown", o->markdown, "File for all commands as Markdown (default: stdout)");
  add_answer_options(command, *o);
  command.footer("Example: frustum reference --man man1");
  command.runs([o, program] { return write_reference(*o, program.facts()); });
}

}  // namespace frustum::app
