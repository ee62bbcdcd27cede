// Files of a folder by the program number that they begin with, as O1002 of a control that keeps
// programs by their numbers alone.
//
// Units : none
// Errors: none; what cannot be read is passed over
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace frustum::parser {

// Those whose first block is O and that number; folders within the folder are left out.
[[nodiscard]] std::vector<std::filesystem::path> files_of_program(
    const std::filesystem::path& folder, std::uint32_t number);

}  // namespace frustum::parser
