#include "report/chart/polar_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/units.hpp"
#include "report/chart/series_key.hpp"
#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kWidth = 440.0, kHeight = 474.0, kOuter = 176.0;  // pixels
constexpr SvgPoint kCentre{220.0, 212.0};

// Forward from one angle to the next, 0 to one turn, in the sense in which most steps are short.
double forward_step(double from, double to, bool reversed) {
  const double step = std::fmod(reversed ? from - to : to - from, kTurn);
  return step < 0.0 ? step + kTurn : step;
}

double usual_step(const PolarRound& points, bool reversed) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < points.size(); ++k) {
    steps.push_back(forward_step(points[k - 1].angle, points[k].angle, reversed));
  }
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

// Scale and rings of a chart: the reference circle at about six tenths of its radius.
struct PolarScale {
  double division = 1.0;   // um
  int rings = 1;           // on either side of the reference
  double reference = 2.0;  // um from the centre
  [[nodiscard]] double outer() const { return reference + (rings + 0.35) * division; }
  [[nodiscard]] double pixels(double deviation) const {
    return kOuter * std::max(0.0, reference + deviation) / outer();
  }
};

PolarScale scale_of(double low, double high) {
  constexpr double kSmallest = 1e-4;  // um: a perfect profile still has a scale
  const double largest = std::max({std::abs(low), std::abs(high), kSmallest});
  PolarScale scale;
  scale.division = round_up_125(largest / 3.0);
  scale.rings = std::max(1, static_cast<int>(std::ceil(largest / scale.division - 1e-9)));
  scale.reference = 2.0 * scale.rings * scale.division;
  return scale;
}

SvgPoint around(double radius, double angle) {
  return {kCentre.x + radius * std::cos(angle), kCentre.y - radius * std::sin(angle)};
}

void draw_grid(SvgDrawing& drawing, const PolarScale& scale) {
  for (int degrees = 0; degrees < 360; degrees += 30) {
    const double angle = degrees * kRadPerDeg;
    drawing.line(around(scale.pixels(-scale.rings * scale.division), angle), around(kOuter, angle),
                 "grid");
    const SvgPoint at = around(kOuter + 17.0, angle);
    drawing.text({at.x, at.y + 4.0}, fmt::format("{}°", degrees));
  }
  for (int k = -scale.rings; k <= scale.rings; ++k) {
    drawing.circle(kCentre, scale.pixels(k * scale.division), k == 0 ? "zero" : "grid");
  }
  drawing.circle(kCentre, kOuter, "grid");
}

// A ruler under the circle, whose marks are right under the rings at 0 degrees.
void draw_ruler(SvgDrawing& drawing, const PolarScale& scale, const Wording& words) {
  constexpr double kY = 434.0;
  const auto x = [&](int k) { return kCentre.x + scale.pixels(k * scale.division); };
  drawing.line({x(-scale.rings), kY}, {x(scale.rings), kY}, "axis");
  for (int k = -scale.rings; k <= scale.rings; ++k) {
    drawing.line({x(k), kY - 4.0}, {x(k), kY + 4.0}, "axis");
    if (k % scale.rings != 0) continue;  // there is no room for the numbers between
    const std::string sign = k > 0 ? "+" : "";
    drawing.text({x(k), kY + 19.0},
                 sign + words.number(tick_text(k * scale.division, scale.division)));
  }
  drawing.text({x(-scale.rings) - 10.0, kY + 4.0}, words("deviation, {0}", words.symbol("um")),
               SvgAnchor::end);
}

// A point that does not follow on the one before breaks the line.
std::vector<SvgPoint> line_of(const PolarRound& points, const PolarScale& scale) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<SvgPoint> line;
  for (const PolarPoint& p : points) {
    if (!p.follows) line.push_back({kNan, kNan});
    line.push_back(around(scale.pixels(p.deviation), p.angle));
  }
  return line;
}

}  // namespace

std::vector<PolarRound> polar_rounds(const metrology::CharacteristicResult& characteristic) {
  PolarRound all;
  for (std::size_t k = 0; k < characteristic.plot_angle.size(); ++k) {
    const PolarPoint p{characteristic.plot_angle[k], characteristic.plot_deviation[k] * kUmPerMm,
                       true};
    if (std::isfinite(p.angle) && std::isfinite(p.deviation)) all.push_back(p);
  }
  // Clockwise or not: most steps are shorter than half a turn.
  const bool reversed = usual_step(all, false) > std::numbers::pi;
  const double usual = usual_step(all, reversed);
  constexpr double kLeastGap = 0.02;  // rad
  const double gap = std::max(4.0 * usual, kLeastGap);
  std::vector<PolarRound> rounds;
  double turned = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double step = k == 0 ? 0.0 : forward_step(all[k - 1].angle, all[k].angle, reversed);
    turned += step;
    const bool is_new = k == 0 || turned > kTurn - 0.5 * usual;
    if (is_new) {
      rounds.emplace_back();
      turned = 0.0;
    }
    all[k].follows = !is_new && step <= gap;
    rounds.back().push_back(all[k]);
  }
  for (PolarRound& round : rounds) {  // a full circle is closed
    const double rest = forward_step(round.back().angle, round.front().angle, reversed);
    if (round.size() > 2 && rest <= gap) {
      round.push_back({round.front().angle, round.front().deviation, true});
    }
  }
  return rounds;
}

bool has_polar_chart(const metrology::CharacteristicResult& characteristic) {
  return characteristic.plot_angle.size() > 2 &&
         characteristic.plot_angle.size() == characteristic.plot_deviation.size();
}

std::string polar_figure(const metrology::CharacteristicResult& characteristic,
                         const Wording& words) {
  std::vector<PolarRound> rounds = polar_rounds(characteristic);
  for (PolarRound& round : rounds) {
    for (PolarPoint& p : round) p.deviation = words.shown(p.deviation, "um");
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PolarRound& round : rounds) {
    for (const PolarPoint& p : round) {
      low = std::min(low, p.deviation);
      high = std::max(high, p.deviation);
    }
  }
  if (!(high >= low)) low = high = 0.0;
  const PolarScale scale = scale_of(low, high);
  const std::string facts =
      words("highest less lowest point {0} {2}, {1} {2} per division",
            words.fixed(high - low, words.is_inch() ? 2 : 3),
            words.number(tick_text(scale.division, scale.division)), words.symbol("um"));
  SvgDrawing drawing(kWidth, kHeight, words("Polar chart of {0}: {1}", characteristic.name, facts));
  draw_grid(drawing, scale);
  drawing.circle(kCentre, scale.pixels(high), "extreme");
  drawing.circle(kCentre, scale.pixels(low), "extreme");
  for (std::size_t k = 0; k < rounds.size(); ++k) {
    drawing.polyline(line_of(rounds[k], scale), series_class("trace", k));
  }
  draw_ruler(drawing, scale, words);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < rounds.size() && rounds.size() > 1; ++k) {
    names.push_back(words("section {0}", k));
  }
  return fmt::format(
      "<figure class=\"polar\"><figcaption><b>{}</b><span class=\"scale\">{}</span>{}</figcaption>"
      "\n{}</figure>\n",
      html_text(characteristic.name), facts, series_key(names), drawing.html());
}

std::string polar_traces_figure(const std::string& title, const std::vector<PolarTrace>& traces,
                                const Wording& words) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PolarTrace& trace : traces) {
    for (const PolarPoint& p : trace.points) {
      low = std::min(low, p.deviation);
      high = std::max(high, p.deviation);
    }
  }
  if (!(high >= low)) low = high = 0.0;
  const PolarScale scale = scale_of(low, high);
  const std::string facts =
      words("from {0} to {1} {3}, {2} {3} per division", words.fixed(low, words.is_inch() ? 2 : 3),
            words.fixed(high, words.is_inch() ? 2 : 3),
            words.number(tick_text(scale.division, scale.division)), words.symbol("um"));
  SvgDrawing drawing(kWidth, kHeight, words("Polar chart of {0}: {1}", title, facts));
  draw_grid(drawing, scale);
  std::vector<std::string> names, marks;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    drawing.polyline(line_of(traces[k].points, scale),
                     series_class(traces[k].dashed ? "trace dashed" : "trace", k));
    names.push_back(traces[k].name);
    marks.emplace_back(traces[k].dashed ? "dashed" : "");
  }
  draw_ruler(drawing, scale, words);
  return fmt::format(
      "<figure class=\"polar\"><figcaption><b>{}</b><span class=\"scale\">{}</span>{}</figcaption>"
      "\n{}</figure>\n",
      html_text(title), facts, series_key(names, marks), drawing.html());
}

}  // namespace frustum::report
