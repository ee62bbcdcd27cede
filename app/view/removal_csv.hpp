// What each block removes, as a table: one row a block.
// Units: as the column names say: mm, mm3, mm3/min, s.
// Errors: none; what is unknown or does not exist is left empty.
#pragma once

#include <span>
#include <string>

#include "kinematics/path/tool_path.hpp"
#include "stock/solid/removal.hpp"

namespace frustum::app {

[[nodiscard]] std::string removal_csv(const kinematics::ToolPath& path,
                                      std::span<const stock::BlockRemoval> removal);

}  // namespace frustum::app
