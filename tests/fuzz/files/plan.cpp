#include <stdexcept>
#include <string>

#include "metrology/plan/inspection_plan.hpp"
#include "tests/fuzz/files/file_checks.hpp"
#include "tests/fuzz/files/one_file.hpp"

namespace frustum::fuzz {

void run_one_plan(std::string_view text) {
  const auto plan = metrology::parse_plan(text, kTriedFile);
  if (!plan) return check_failures(plan.error(), kTriedFile, Placed::always);
  // TOML has infinities and NaN, which no plan may hold: they would not be read back.
  const std::string written = metrology::to_toml(*plan);
  const auto again = metrology::parse_plan(written, kTriedFile);
  if (!again) {
    throw std::runtime_error("what was written is refused: " + to_string(again.error().front()) +
                             "\n" + written);
  }
  if (!(*again == *plan)) throw std::runtime_error("what was written differs:\n" + written);
}

}  // namespace frustum::fuzz
