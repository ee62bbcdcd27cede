// frustum diff: whether two NC programs move the tool the same way on one machine.
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_setup.hpp"
#include "app/job/nc_file.hpp"
#include "app/job/unmeasured_tools.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"
#include "parser/doubts.hpp"
#include "post/comparing/program_difference.hpp"

namespace frustum::app {
namespace {

struct DiffOptions : AnswerOptions {
  std::string first{};
  std::string second{};
  std::string first_dialect{};  // recognised when not given
  std::string second_dialect{};
  SetupWords setup_words{};
  double tip = 2.0;    // um
  double axis = 50.0;  // urad
  double feed = 2.0;   // percent
};

constexpr const char* kKinds[] = {"none", "tip",     "axis",  "feed",
                                  "tool", "missing", "extra", "spindle"};

// Without a line where a program has no block there.
std::string place_text(const std::string& program, const std::string& file, std::uint32_t line) {
  const std::string& name = file.empty() ? program : file;
  return line == 0 ? name : fmt::format("{}:{}", name, line);
}

std::string in_words(const DiffOptions& options, const post::Difference& at) {
  std::string what;
  if (at.first_line == 0 || at.second_line == 0 || at.kind == post::DifferenceKind::spindle) {
    what = at.likely_cause;
  } else if (at.kind == post::DifferenceKind::feed) {
    what = fmt::format("the time it takes is {:.4g} times that of the first", at.time_ratio);
  } else {
    what =
        fmt::format("tip {:.4f} mm and tool axis {:.5f} deg apart", at.tip, at.axis * kDegPerRad);
  }
  const std::string text =
      fmt::format("{} and {}: {}\n", place_text(options.first, at.first_file, at.first_line),
                  place_text(options.second, at.second_file, at.second_line), what);
  if (what == at.likely_cause) return text;
  if (!at.likely_cause.empty()) return text + "likely cause: " + at.likely_cause + '\n';
  return text + "no single known cause explains it\n";
}

nlohmann::ordered_json as_json(const DiffOptions& options, const post::ProgramComparison& found) {
  nlohmann::ordered_json doc{{"schema", "frustum/diff/1"},
                             {"version", program_version()},
                             {"same", found.same()},
                             {"largest_tip_um", found.largest_tip * kUmPerMm},
                             {"largest_axis_urad", found.largest_axis * kUradPerRad},
                             {"largest_time_ratio", found.largest_time_ratio}};
  if (found.same()) return doc;
  const post::Difference& at = found.first;
  doc["first_difference"] = {
      {"kind", kKinds[static_cast<std::size_t>(at.kind)]},
      {"first_line", at.first_line},
      {"second_line", at.second_line},
      {"first_file", at.first_file.empty() ? options.first : at.first_file},
      {"second_file", at.second_file.empty() ? options.second : at.second_file},
      {"tip_um", at.tip * kUmPerMm},
      {"axis_urad", at.axis * kUradPerRad},
      {"time_ratio", at.time_ratio},
      {"likely_cause", at.likely_cause}};
  return doc;
}

int diff(const DiffOptions& options) {
  auto setup_words = machine_setup_of(options.setup_words);
  if (!setup_words) return refuse(setup_words.error(), options);
  auto first = motions_of_file(options.first, options.first_dialect, *setup_words);
  if (!first) return refuse(first.error(), options);
  auto second = motions_of_file(options.second, options.second_dialect, *setup_words);
  if (!second) return refuse(second.error(), options);
  print(std::cerr, in_file(parser::doubts_of(*first), options.first));
  print(std::cerr, in_file(parser::doubts_of(*second), options.second));
  for (const int tool : unmeasured_tools(setup_words->setup, {*first, *second})) {
    setup_words->setup.tools[tool].length = kAssumedToolLength;
    std::cerr << fmt::format(
        "note: tool {} counts as {} mm long; --tool-length {}=.. says better\n", tool,
        kAssumedToolLength, tool);
  }
  const post::DifferenceLimits limits{.tip = options.tip / kUmPerMm,
                                      .axis = options.axis / kUradPerRad,
                                      .time_ratio = options.feed / 100.0};
  const auto found = with_progress(options, "compare", [&](report::Progress&) {
    return post::compare_programs(setup_words->machine,
                                  {options.first, *std::move(first), setup_words->setup},
                                  {options.second, *std::move(second), setup_words->setup}, limits);
  });
  if (!found) return refuse(found.error(), options);
  if (options.json) {
    std::cout << as_json(options, *found).dump(2) << '\n';
  } else if (options.quiet) {
    // The exit code says it.
  } else if (found->same()) {
    std::cout << fmt::format(
        "the programs agree: tip within {:.4f} um, tool axis within {:.4f} urad, times within "
        "{:.3f} %\n",
        found->largest_tip * kUmPerMm, found->largest_axis * kUradPerRad,
        100.0 * std::abs(std::log(found->largest_time_ratio)));
  } else {
    std::cout << in_words(options, found->first);
  }
  return found->same() ? kDone : kOutOfTolerance;
}

}  // namespace

void add_diff(Command& program) {
  auto o = std::make_shared<DiffOptions>();
  Command command = program.command(
      "diff", "Whether two NC programs, of any dialects, move the tool the same way");
  const std::vector<std::string> dialects(
      {"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"});
  command.option("first", o->first, "Program that is right").required();
  command.option("second", o->second, "Program to compare with it").required();
  command.option("--dialect", o->first_dialect, "Of the first (default: recognised)")
      .one_of(dialects);
  command.option("--second-dialect", o->second_dialect, "Of the second (default: recognised)")
      .one_of(dialects);
  add_setup_options(command, o->setup_words);
  command.option("--tip", o->tip, "Tolerance of the tip, um (2)").holds(positive_number(1e6));
  command.option("--axis", o->axis, "Tolerance of the tool axis, urad (50)")
      .holds(positive_number(1e6));
  command.option("--feed", o->feed, "Tolerance of the time that a path segment takes, percent (2)")
      .holds(positive_number(1e3));
  add_answer_options(command, *o);
  command.footer(
      "Only feed moves count. Exit code 1 when the programs differ.\n"
      "Example: frustum diff cone.nc cone.mpf --machine iwf-bc --offset G54=-65,0,150");
  command.computes([o] { return diff(*o); });
}

}  // namespace frustum::app
