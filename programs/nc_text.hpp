// Writes NC text line by line and knows where it is.
//
// Units: mm, deg, mm/min. Numbers are printed with fixed decimals (1 nm, 1e-7 deg, 1e-9 for vectors) and
// without trailing zeros; words that do not change are left out where a controller allows it.
#pragma once

#include <string>
#include <string_view>

#include "core/pose.hpp"

namespace frustum::programs {

class NcText {
 public:
  // Appends one line.
  void line(std::string_view text);
  void comment(std::string_view text);
  // The number of the line that comes next, 1-based.
  [[nodiscard]] std::uint32_t next_line() const { return next_line_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::uint32_t next_line_ = 1;
};

// "X12.5": a coordinate word in mm, a rotary word in degrees, a component of a unit vector.
[[nodiscard]] std::string length_word(char letter, double mm);
[[nodiscard]] std::string angle_word(char letter, double rad);
[[nodiscard]] std::string vector_words(const Vec3& axis);

}  // namespace frustum::programs
