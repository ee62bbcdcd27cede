// The folder that results are written to.
//
// Units: none. Errors: a place where no folder can be made.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace frustum::app {

// The folder, made if need be.
[[nodiscard]] Result<std::filesystem::path> output_folder(const std::filesystem::path& folder);

}  // namespace frustum::app
