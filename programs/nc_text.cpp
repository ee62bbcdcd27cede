#include "programs/nc_text.hpp"

#include <fmt/format.h>

#include "core/units.hpp"

namespace frustum::programs {
namespace {

// "12." keeps its point: controllers read "12" in their least increment.
std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  return text == "-0." ? "0." : text;
}

}  // namespace

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
