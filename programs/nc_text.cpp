#include "programs/nc_text.hpp"

#include <fmt/format.h>

#include "core/units.hpp"
#include "post/nc_number.hpp"

namespace frustum::programs {

using post::fixed;

void NcText::line(std::string_view text) {
  text_ += text;
  text_ += '\n';
  ++next_line_;
}

void NcText::comment(std::string_view text) { line(fmt::format("({})", text)); }

std::string length_word(char letter, double mm) { return letter + fixed(mm, 6); }
std::string angle_word(char letter, double rad) { return letter + fixed(rad * kDegPerRad, 7); }
std::string vector_words(const Vec3& axis) {
  return fmt::format("I{} J{} K{}", fixed(axis.x(), 9), fixed(axis.y(), 9), fixed(axis.z(), 9));
}

}  // namespace frustum::programs
