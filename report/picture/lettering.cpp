#include "report/picture/lettering.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace frustum::report {
namespace {

// Glyphs are on the baseline y = 0 and digits are one unit high.
struct Place {
  double x = 0.0;
  double y = 0.0;
};
using Line = std::vector<Place>;
struct Glyph {
  double advance = 0.78;
  std::vector<Line> lines{};
};

// Part of an ellipse, from angle `from` to `to` in degrees.
Line arc(Place centre, double rx, double ry, double from, double to) {
  constexpr int kSteps = 24;
  Line line;
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = (from + (to - from) * k / kSteps) * std::numbers::pi / 180.0;
    line.push_back({centre.x + rx * std::cos(angle), centre.y + ry * std::sin(angle)});
  }
  return line;
}

Line joined(Line first, const Line& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Glyph arches(int count) {
  Glyph glyph{0.62 + 0.36 * (count - 1), {{{0.06, 0.0}, {0.06, 0.68}}}};
  for (int k = 0; k < count; ++k) {
    const double middle = 0.24 + 0.36 * k;
    glyph.lines.push_back(joined(arc({middle, 0.48}, 0.18, 0.20, 180, 0), {{middle + 0.18, 0.0}}));
  }
  return glyph;
}

Glyph digit(char c) {
  switch (c) {
    case '0':
      return {0.78, {arc({0.30, 0.50}, 0.27, 0.50, 0, 360)}};
    case '1':
      return {0.78, {{{0.10, 0.76}, {0.35, 1.0}, {0.35, 0.0}}}};
    case '2':
      return {0.78, {joined(arc({0.29, 0.71}, 0.26, 0.29, 165, -38), {{0.03, 0.0}, {0.57, 0.0}})}};
    case '3':
      return {0.78,
              {joined(arc({0.28, 0.75}, 0.24, 0.25, 150, -90),
                      arc({0.28, 0.25}, 0.28, 0.25, 90, -150))}};
    case '4':
      return {0.78, {{{0.44, 0.0}, {0.44, 1.0}, {0.01, 0.29}, {0.60, 0.29}}}};
    case '5':
      return {0.78, {joined({{0.53, 1.0}, {0.13, 1.0}}, arc({0.28, 0.33}, 0.29, 0.33, 130, -150))}};
    case '6':
      return {0.78,
              {arc({0.31, 0.31}, 0.27, 0.31, 0, 360), arc({0.52, 0.31}, 0.48, 0.69, 95, 180)}};
    case '7':
      return {0.78, {{{0.03, 1.0}, {0.57, 1.0}, {0.21, 0.0}}}};
    case '8':
      return {0.78,
              {arc({0.30, 0.755}, 0.23, 0.245, 0, 360), arc({0.30, 0.255}, 0.28, 0.255, 0, 360)}};
    default:  // 9
      return {0.78, {arc({0.29, 0.69}, 0.27, 0.31, 0, 360), arc({0.08, 0.69}, 0.48, 0.69, 0, -85)}};
  }
}

Glyph glyph_of(char c) {
  if (c >= '0' && c <= '9') return digit(c);
  switch (c) {
    case '-':
      return {0.78, {{{0.08, 0.44}, {0.54, 0.44}}}};
    case '+':
      return {0.78, {{{0.08, 0.44}, {0.54, 0.44}}, {{0.31, 0.21}, {0.31, 0.67}}}};
    case '.':
      return {0.30, {{{0.08, 0.02}, {0.08, 0.03}}}};
    case 'u':
      return {0.68,
              {{{0.06, 0.68}, {0.06, -0.28}},
               joined(arc({0.26, 0.22}, 0.20, 0.22, 180, 360), {{0.46, 0.68}}),
               {{0.46, 0.22}, {0.48, 0.03}, {0.54, 0.0}}}};
    case 'm':
      return arches(2);
    case 'n':
      return arches(1);
    default:
      return {0.40, {}};
  }
}

double distance_to_segment(Place p, Place a, Place b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double along = (p.x - a.x) * dx + (p.y - a.y) * dy;
  const double t = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

// Inks a chain of strokes at once, so that joints are not darker.
void ink(Image& image, const Line& line, double stroke, const LinearColour& colour) {
  Place low = line.front();
  Place high = line.front();
  for (const Place& p : line) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double reach = stroke / 2.0 + 1.0;
  for (int y = static_cast<int>(low.y - reach); y <= static_cast<int>(high.y + reach); ++y) {
    for (int x = static_cast<int>(low.x - reach); x <= static_cast<int>(high.x + reach); ++x) {
      const Place centre{x + 0.5, y + 0.5};
      double distance = distance_to_segment(centre, line.front(), line.front());
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        distance = std::min(distance, distance_to_segment(centre, line[k], line[k + 1]));
      }
      const double share = std::clamp(0.5 + stroke / 2.0 - distance, 0.0, 1.0);
      image.blend(x, y, colour, static_cast<float>(share));
    }
  }
}

}  // namespace

double text_width(std::string_view text, const LetterStyle& style) {
  double width = 0.0;
  for (const char c : text) width += glyph_of(c).advance * style.height;
  return width;
}

void draw_text(Image& image, double x, double y, std::string_view text, const LetterStyle& style) {
  for (const char c : text) {
    const Glyph glyph = glyph_of(c);
    for (const Line& line : glyph.lines) {
      Line placed;
      for (const Place& p : line)
        placed.push_back({x + p.x * style.height, y - p.y * style.height});
      ink(image, placed, style.stroke, style.colour);
    }
    x += glyph.advance * style.height;
  }
}

void draw_stroke(Image& image, double x0, double y0, double x1, double y1, double stroke,
                 const LinearColour& colour) {
  ink(image, {{x0, y0}, {x1, y1}}, stroke, colour);
}

}  // namespace frustum::report
