// The cutters of a LinuxCNC tool table (.tbl), whose text parser/tool_table.hpp reads.
//
// Model    : a table knows no shape: a tool is taken as a flat end mill of its D and Z. Lines
//            without a length or
//            diameter above 0 (probes, empty pockets) give no tool
// Units    : mm, as the table of a metric machine has them
// Errors   : those of the table, and one without tools
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"
#include "cutter/body/cutter_file.hpp"

namespace frustum::cutter {

[[nodiscard]] Result<ToolList> read_tool_table(std::string_view text,
                                               const std::filesystem::path& file);
[[nodiscard]] Result<ToolList> load_tool_table(const std::filesystem::path& file);

}  // namespace frustum::cutter
