// SVG drawings inside a page: lines, texts and scales. Colours and type come from the page's style
// sheet by class, so that light, dark and paper agree, and nothing needs a script.
//
// Units: pixels of the drawing, x right, y down. Errors: none; points that are not finite break a
// line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frustum::report {

struct SvgPoint {
  double x = 0.0;
  double y = 0.0;
};

struct SvgStroke {
  SvgPoint from{}, to{};
};

enum class SvgAnchor { start, middle, end };

class SvgDrawing {
 public:
  // `label` is read out instead of the picture.
  SvgDrawing(double width, double height, std::string_view label);

  void line(SvgPoint from, SvgPoint to, std::string_view classes);
  void circle(SvgPoint centre, double radius, std::string_view classes);
  void polyline(const std::vector<SvgPoint>& points, std::string_view classes);
  // Strokes that swing to and fro between two places, without a script.
  void swinging(const std::vector<SvgStroke>& one_end, const std::vector<SvgStroke>& other_end,
                std::string_view classes);
  // `fill`: a colour of its own, "#rrggbb"; empty: that of its classes.
  void rectangle(SvgPoint corner, SvgPoint opposite, std::string_view classes,
                 std::string_view fill = {});
  // The area within the points.
  void area(const std::vector<SvgPoint>& points, std::string_view classes);
  void text(SvgPoint at, std::string_view content, SvgAnchor anchor = SvgAnchor::middle,
            std::string_view classes = {});
  // Upward along the y axis.
  void text_upward(SvgPoint at, std::string_view content);
  [[nodiscard]] std::string html() const { return html_ + "</svg>\n"; }

 private:
  std::string html_;
};

// Ticks at 1, 2 or 5 times a power of ten, about `count` of them, within low .. high.
struct Ticks {
  double step = 1.0;
  std::vector<double> values{};
};
[[nodiscard]] Ticks ticks(double low, double high, int count);
// As many decimals as the step asks for, with a minus sign: "−0.5".
[[nodiscard]] std::string tick_text(double value, double step);

}  // namespace frustum::report
