#include "report/chart/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

// Hundredths of a pixel are more than anyone sees.
std::string pixels(double value) { return fmt::format("{:g}", std::round(value * 100.0) / 100.0); }

std::string class_attribute(std::string_view classes) {
  return classes.empty() ? "" : fmt::format(" class=\"{}\"", classes);
}

}  // namespace

SvgDrawing::SvgDrawing(double width, double height, std::string_view label)
    : html_(fmt::format("<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" "
                        "aria-label=\"{}\">\n",
                        pixels(width), pixels(height), html_text(label))) {}

void SvgDrawing::line(SvgPoint from, SvgPoint to, std::string_view classes) {
  html_ += fmt::format("<path{} d=\"M{} {}L{} {}\"/>\n", class_attribute(classes), pixels(from.x),
                       pixels(from.y), pixels(to.x), pixels(to.y));
}

void SvgDrawing::circle(SvgPoint centre, double radius, std::string_view classes) {
  html_ += fmt::format("<circle{} cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", class_attribute(classes),
                       pixels(centre.x), pixels(centre.y), pixels(radius));
}

void SvgDrawing::polyline(const std::vector<SvgPoint>& points, std::string_view classes) {
  std::string path;
  bool is_down = false;
  for (const SvgPoint& p : points) {
    const bool is_point = std::isfinite(p.x) && std::isfinite(p.y);
    if (is_point) path += fmt::format("{}{} {}", is_down ? 'L' : 'M', pixels(p.x), pixels(p.y));
    is_down = is_point;
  }
  if (!path.empty()) html_ += fmt::format("<path{} d=\"{}\"/>\n", class_attribute(classes), path);
}

void SvgDrawing::swinging(const std::vector<SvgStroke>& one_end,
                          const std::vector<SvgStroke>& other_end, std::string_view classes) {
  const auto path = [](const std::vector<SvgStroke>& strokes) {
    std::string text;
    for (const auto& [from, to] : strokes) {
      text +=
          fmt::format("M{} {}L{} {}", pixels(from.x), pixels(from.y), pixels(to.x), pixels(to.y));
    }
    return text;
  };
  const std::string one = path(one_end), other = path(other_end);
  // Nearly a sine: slow at both ends.
  html_ += fmt::format(
      "<path{0} d=\"{1}\"><animate attributeName=\"d\" values=\"{1};{2};{1}\" dur=\"1.4s\" "
      "calcMode=\"spline\" keyTimes=\"0;0.5;1\" keySplines=\"0.37 0 0.63 1;0.37 0 0.63 1\" "
      "repeatCount=\"indefinite\"/></path>\n",
      class_attribute(classes), one, other);
}

void SvgDrawing::rectangle(SvgPoint corner, SvgPoint opposite, std::string_view classes,
                           std::string_view fill) {
  const std::string own = fill.empty() ? "" : fmt::format(" style=\"fill:{}\"", fill);
  html_ += fmt::format(
      "<rect{}{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", class_attribute(classes), own,
      pixels(std::min(corner.x, opposite.x)), pixels(std::min(corner.y, opposite.y)),
      pixels(std::abs(opposite.x - corner.x)), pixels(std::abs(opposite.y - corner.y)));
}

void SvgDrawing::area(const std::vector<SvgPoint>& points, std::string_view classes) {
  std::string path;
  for (const SvgPoint& p : points) {
    path += fmt::format("{}{} {}", path.empty() ? 'M' : 'L', pixels(p.x), pixels(p.y));
  }
  if (!path.empty()) html_ += fmt::format("<path{} d=\"{}Z\"/>\n", class_attribute(classes), path);
}

void SvgDrawing::text(SvgPoint at, std::string_view content, SvgAnchor anchor,
                      std::string_view classes) {
  constexpr std::array<std::string_view, 3> kAnchors{"start", "middle", "end"};
  html_ += fmt::format("<text{} x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n",
                       class_attribute(classes), pixels(at.x), pixels(at.y),
                       kAnchors.at(static_cast<std::size_t>(anchor)), html_text(content));
}

void SvgDrawing::text_upward(SvgPoint at, std::string_view content) {
  html_ += fmt::format(
      "<text text-anchor=\"middle\" transform=\"translate({} {}) rotate(-90)\">{}</text>\n",
      pixels(at.x), pixels(at.y), html_text(content));
}

Ticks ticks(double low, double high, int count) {
  Ticks result;
  if (!(high > low)) return {1.0, {low}};
  result.step = round_up_125((high - low) / count);
  const double first = std::ceil(low / result.step - 1e-9);
  for (double k = first; k * result.step <= high + 1e-9 * result.step; k += 1.0) {
    result.values.push_back(k * result.step);
  }
  return result;
}

std::string tick_text(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const std::string text = fixed_text(value, decimals);
  return text.front() == '-' ? "\u2212" + text.substr(1) : text;
}

}  // namespace frustum::report
