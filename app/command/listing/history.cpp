// frustum history: how a machine's results change over their dates.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/listing/listing_commands.hpp"
#include "app/command/option/style_option.hpp"
#include "app/history/history.hpp"
#include "app/history/history_views.hpp"
#include "app/view/console.hpp"
#include "core/file_set.hpp"

namespace frustum::app {
namespace {

struct HistoryCommandOptions : AnswerOptions {
  std::string folder{};
  std::string out{};
  std::string machine{};
  std::string since{};
  StyleWords style{};
  unsigned baseline = 0;
};

Result<HistoryOptions> options_of(const HistoryCommandOptions& words) {
  HistoryOptions options{.baseline = words.baseline};
  if (words.baseline > 0 && words.baseline < calibration::kFewestForLimits) {
    return error("out-of-range"_id,
                 fmt::format("--baseline {}: too few for control limits", words.baseline),
                 fmt::format("give {} or more", calibration::kFewestForLimits));
  }
  if (words.since.empty()) return options;
  options.since = moment_of(words.since);
  if (options.since) return options;
  return error("wrong-date"_id, fmt::format("--since {}: no date", words.since),
               "year, month, day: 2026-11-23");
}

Result<std::filesystem::path> write_page(const HistoryCommandOptions& words,
                                         const History& history) {
  auto set = FileSet::open(words.out, {"history.json", "history.html"});
  if (!set) return set.error();
  set->add("history.json", history_json(history));
  set->add("history.html", history_page(history, report::Wording(style_of(words.style))));
  return set->write();
}

int show_history(const HistoryCommandOptions& words) {
  const auto options = options_of(words);
  if (!options) return refuse(options.error(), words);
  auto folder = read_results(words.folder, words.machine);
  if (!folder) return refuse(folder.error(), words);
  const auto history = history_of(*std::move(folder), *options);
  if (!history) return refuse(history.error(), words);
  print(std::cerr, history->folder.remarks);
  if (!words.out.empty()) {
    if (const auto written = write_page(words, *history); !written) {
      return refuse(written.error(), words);
    }
  }
  if (words.json) {
    std::cout << history_json(*history);
  } else if (!words.quiet) {
    std::cout << history_text(*history, report::Wording(style_of(words.style)));
  }
  return history->passes() ? kDone : kOutOfTolerance;
}

}  // namespace

void add_history(Command& program) {
  auto o = std::make_shared<HistoryCommandOptions>();
  Command command = program.command(
      "history",
      "Results of one machine over their dates: control limits, tolerances, trends, as found and "
      "as left");
  command
      .option("DIR", o->folder,
              "Folder of result documents, or with history.toml, which lists them")
      .required()
      .existing_folder();
  command.option("--out", o->out, "Folder for history.html and history.json");
  command.option("--machine", o->machine, "Only results that name this machine");
  command.option("--baseline", o->baseline,
                 "Control limits of the first so many results (default: of all)");
  command.option("--since", o->since, "Date from which on results decide the exit code");
  add_style_options(command, o->style);
  add_answer_options(command, *o);
  command.footer(
      "Exit code 1: a result is beyond its control limits or not within its tolerance.\n"
      "Example: frustum history results --out history");
  command.runs([o] { return show_history(*o); });
}

}  // namespace frustum::app
