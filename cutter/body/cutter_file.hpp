// Cutters as people write them: the table of one tool in a job or a tool library, and whole
// libraries.
//
// Model    : [tool.N] holds `type` and the keys of that type (cutter_types()). A table may build on
//            a tool
//            that is known already and then says only what differs
// Units    : in files mm and degrees, or text with a unit; inside mm and rad
// Errors   : every missing, misspelt or wrong key with file, line and key; tools named twice; files
//            that
//            cannot be read
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "core/toml_document.hpp"
#include "cutter/body/cutter_spec.hpp"

namespace frustum::cutter {

// What is wrong is noted in the table's document.
[[nodiscard]] CutterSpec read_cutter(const TomlTable& table,
                                     const std::optional<CutterSpec>& base = std::nullopt);
// The tables of `tools` by tool number, each built on the tool of that number in `base`, over all
// of `base`.
[[nodiscard]] ToolList read_tools(const TomlTable& tools, ToolList base = {});
// A tool library (TOML with [tool.N] tables) or, by its suffix .tbl, a LinuxCNC tool table.
[[nodiscard]] Result<ToolList> load_tool_library(const std::filesystem::path& file);
// What read_cutter reads back as the same spec: an inline table.
[[nodiscard]] std::string cutter_text(const CutterSpec& spec);

}  // namespace frustum::cutter
