// What holds for every file that people write, whatever is in it.
//
// Units : none
// Errors: std::runtime_error that says which promise was broken
#pragma once

#include <string_view>

#include "core/diagnostic.hpp"
#include "core/pose.hpp"

namespace frustum::fuzz {

// The name of the file that is tried; what is relative in it starts from the folder tests/fuzz.
inline constexpr std::string_view kTriedFile = FRUSTUM_SOURCE_DIR "/tests/fuzz/tried.toml";

// Where failures are: each has a line and a column (TOML); or those of one line have both (points
// in text); or no column (PLY, whose columns nobody sees).
enum class Placed { always, by_line, without_column };
void check_failures(const Diagnostics& failures, std::string_view file, Placed placed);

void check_finite(double value, std::string_view what);
void check_finite(const Vec3& value, std::string_view what);

}  // namespace frustum::fuzz
