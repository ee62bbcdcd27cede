#include "cutter/body/tool_table.hpp"

#include "parser/tool_table.hpp"

namespace frustum::cutter {
namespace {

Result<ToolList> cutters_of(const Result<parser::ToolTable>& table,
                            const std::filesystem::path& file) {
  if (!table) return table.error();
  constexpr auto kZ = static_cast<std::size_t>(parser::AxisLetter::Z);
  ToolList tools;
  for (const auto& [number, tool] : *table) {
    const double length = tool.offset.at(kZ);
    if (number == 0 || !(tool.diameter > 0.0) || !(length > 0.0)) continue;
    tools.emplace(number,
                  CutterSpec{.name = tool.remark, .diameter = {tool.diameter}, .length = {length}});
  }
  if (!tools.empty()) return tools;
  Diagnostic none =
      error("empty-tool-table"_id, "the tool table has no tool with a diameter and a length",
            "one tool a line: T1 P1 D12 Z100 ; remark");
  none.file = file.string();
  return none;
}

}  // namespace

Result<ToolList> read_tool_table(std::string_view text, const std::filesystem::path& file) {
  return cutters_of(parser::tool_table_of(text, file.string()), file);
}

Result<ToolList> load_tool_table(const std::filesystem::path& file) {
  return cutters_of(parser::read_tool_table(file), file);
}

}  // namespace frustum::cutter
