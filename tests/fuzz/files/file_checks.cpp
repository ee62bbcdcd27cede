#include "tests/fuzz/files/file_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace frustum::fuzz {
namespace {

bool is_placed(const Diagnostic& failure, Placed placed) {
  if (placed == Placed::without_column) return failure.line >= 0;
  const bool is_one_line = failure.line > 0 && failure.column > 0;
  const bool is_whole_file = failure.line == 0 && failure.column == 0;
  return is_one_line || (is_whole_file && placed == Placed::by_line);
}

}  // namespace

void check_failures(const Diagnostics& failures, std::string_view file, Placed placed) {
  if (!has_error(failures)) throw std::runtime_error("a failure without an error");
  for (const Diagnostic& failure : failures) {
    const bool whole =
        failure.file == file && !failure.id.text().empty() && !failure.message.empty();
    if (whole && is_placed(failure, placed)) continue;
    throw std::runtime_error("a failure without file, place or message: " + to_string(failure));
  }
}

void check_finite(double value, std::string_view what) {
  if (std::isfinite(value)) return;
  throw std::runtime_error(fmt::format("accepted, and not finite: {} = {}", what, value));
}

void check_finite(const Vec3& value, std::string_view what) {
  for (const double part : value) check_finite(part, what);
}

}  // namespace frustum::fuzz
