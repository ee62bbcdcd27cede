// LinuxCNC tool tables (.tbl).
//
// Model    : one tool a line: words of a letter and a number in any order (T tool, P pocket, Z length,
//            D diameter; X Y A B C U V W offsets, I J angles and Q orientation of lathe tools are read over),
//            then ';' and a remark. A table knows no shape: a tool is taken as a flat end mill. Lines without
//            a length or diameter above 0 (probes, empty pockets) give no tool
// Units    : mm, as the table of a metric machine has them; `mm_per_unit` scales those of others
// Errors   : file, line and column of a word that is none, a letter that no table has, a letter twice on a
//            line, a tool number that is none or stands on two lines, a table without tools
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"
#include "cutter/cutter_file.hpp"

namespace frustum::cutter {

[[nodiscard]] Result<ToolList> read_tool_table(std::string_view text,
                                               const std::filesystem::path& file,
                                               double mm_per_unit = 1.0);
[[nodiscard]] Result<ToolList> load_tool_table(const std::filesystem::path& file,
                                               double mm_per_unit = 1.0);

}  // namespace frustum::cutter
