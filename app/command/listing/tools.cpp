// frustum tools: the tools of a job, and the profile of one as a drawing.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/listing/listing_commands.hpp"
#include "app/job/job.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"
#include "core/whole_file.hpp"
#include "cutter/body/cutter.hpp"
#include "report/exchange/tool_drawing.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

struct ToolsOptions : AnswerOptions {
  std::string job{};
  std::string drawing{};
  std::optional<int> number{};
};

// The one that is asked for, or the only one.
Result<std::pair<int, cutter::CutterSpec>> chosen(const ToolsOptions& options,
                                                  const cutter::ToolList& tools) {
  std::string known;
  for (const auto& [number, tool] : tools) {
    known += fmt::format("{}{}", known.empty() ? "" : ", ", number);
  }
  if (options.number) {
    const auto at = tools.find(*options.number);
    if (at != tools.end()) return std::pair<int, cutter::CutterSpec>(*at);
    return error("unknown-tool"_id, fmt::format("the job has no tool {}", *options.number),
                 "it has: " + known);
  }
  if (tools.size() == 1) return std::pair<int, cutter::CutterSpec>(*tools.begin());
  return error("missing-option"_id, "--drawing is of one tool, the job has several",
               "choose one by --number: " + known);
}

Result<std::string> drawing_of(const ToolsOptions& options, const cutter::ToolList& tools) {
  const std::string ending = fs::path(options.drawing).extension().string();
  if (ending != ".dxf" && ending != ".svg") {
    return error("unknown-format"_id,
                 fmt::format("--drawing {}: '{}' is no drawing", options.drawing, ending),
                 "write .dxf or .svg");
  }
  const auto tool = chosen(options, tools);
  if (!tool) return tool.error();
  const auto cutter = cutter::Cutter::make(tool->second);
  if (!cutter) return cutter.error();
  if (ending == ".dxf") return report::tool_dxf(*cutter);
  return report::tool_svg(*cutter,
                          fmt::format("T{} {}", tool->first, cutter::description(tool->second)));
}

int list_tools(const ToolsOptions& options) {
  const auto job = load_job(options.job, {}, false);
  if (!job) return refuse(job.error(), options);
  if (!options.drawing.empty()) {
    const auto drawing = drawing_of(options, job->piece.tools);
    if (!drawing) return refuse(drawing.error(), options);
    const auto written = write_whole_file(options.drawing, *drawing);
    if (!written) return refuse(written.error(), options);
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [number, tool] : job->piece.tools) {
    list.push_back({{"number", number},
                    {"name", tool.name},
                    {"type", cutter::to_string(tool.type)},
                    {"description", cutter::description(tool)}});
  }
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"schema", "frustum/tools/1"},
                                        {"version", program_version()},
                                        {"tools", list}}
                     .dump(2)
              << '\n';
  } else if (!options.quiet) {
    for (const auto& [number, tool] : job->piece.tools) {
      std::cout << fmt::format("T{} {}\n", number, cutter::description(tool));
    }
    if (!options.drawing.empty()) std::cout << options.drawing << '\n';
  }
  return kDone;
}

}  // namespace

void add_tools(Command& program) {
  auto o = std::make_shared<ToolsOptions>();
  Command command = program.command("tools", "Tools of a job; the profile of one as a drawing");
  command.option("job", o->job, "Job file").required();
  command.option("--drawing", o->drawing,
                 "Profile of cutting part, shank and holder to write: .dxf or .svg, mm, x radius, "
                 "y height above the tip");
  command.option("--number", o->number, "Tool whose profile it is");
  add_answer_options(command, *o);
  command.footer("Example: frustum tools piece/job.toml --number 1 --drawing t1.dxf");
  command.runs([o] { return list_tools(*o); });
}

}  // namespace frustum::app
