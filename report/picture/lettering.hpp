// Numbers and units drawn with strokes into an image, for the scales of pictures.
//
// Letters: digits, + - . and the letters of "um", "nm", "mm"; u is drawn as the Greek mu; others
//          are left blank. Units: pixels. Errors: none.
#pragma once

#include <string_view>

#include "report/picture/image.hpp"

namespace frustum::report {

struct LetterStyle {
  double height = 16.0;  // of a digit, px
  double stroke = 1.6;   // px
  LinearColour colour = {0.0F, 0.0F, 0.0F};
};

[[nodiscard]] double text_width(std::string_view text, const LetterStyle& style);

// `x` is the left end of the text, `y` its baseline.
void draw_text(Image& image, double x, double y, std::string_view text, const LetterStyle& style);

// A straight stroke with round ends.
void draw_stroke(Image& image, double x0, double y0, double x1, double y1, double stroke,
                 const LinearColour& colour);

}  // namespace frustum::report
