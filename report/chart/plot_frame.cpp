#include "report/chart/plot_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::report {
namespace {

Ticks ticks_of(const PlotScale& scale) {
  if (scale.step <= 0.0) return ticks(scale.range.low, scale.range.high, scale.count);
  Ticks own{scale.step, {}};
  const double first = std::ceil(scale.range.low / scale.step - 1e-9);
  for (double k = first; k * scale.step <= scale.range.high + 1e-9 * scale.step; k += 1.0) {
    own.values.push_back(k * scale.step);
  }
  return own;
}

// With the decimal sign of the scale.
std::string mark_text(double value, double step, const PlotScale& scale) {
  std::string text = tick_text(value, step);
  std::ranges::replace(text, '.', scale.decimal_sign);
  return text;
}

}  // namespace

void PlotRange::include(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

PlotRange PlotRange::widened(double share, double least) const {
  if (!(high >= low)) return {0.0, least};
  const double room = std::max(share * (high - low), 0.5 * (least - (high - low)));
  return {low - room, high + room};
}

PlotRange PlotRange::empty() {
  return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
}

SvgPoint PlotFrame::at(double x, double y, const PlotScale& on_x, const PlotScale& on_y) const {
  const auto share = [](double value, const PlotRange& range) {
    return (value - range.low) / (range.high - range.low);
  };
  return {left + (right - left) * share(x, on_x.range),
          bottom - (bottom - top) * share(y, on_y.range)};
}

void draw_x_scale(SvgDrawing& drawing, const PlotFrame& frame, const PlotScale& scale) {
  const Ticks marks = ticks_of(scale);
  const PlotScale any{};
  for (const double value : marks.values) {
    const double x = frame.at(value, 0.0, scale, any).x;
    drawing.line({x, frame.top}, {x, frame.bottom}, "grid");
    drawing.text({x, frame.bottom + 16.0}, mark_text(value, marks.step, scale));
  }
  drawing.line({frame.left, frame.bottom}, {frame.right, frame.bottom}, "axis");
  drawing.text({0.5 * (frame.left + frame.right), frame.bottom + 34.0}, scale.title);
}

void draw_y_scale(SvgDrawing& drawing, const PlotFrame& frame, const PlotScale& scale,
                  PlotSide side) {
  const Ticks marks = ticks_of(scale);
  const PlotScale any{};
  const bool is_left = side == PlotSide::left;
  const double x = is_left ? frame.left : frame.right;
  for (const double value : marks.values) {
    const double y = frame.at(0.0, value, any, scale).y;
    const bool is_zero = std::abs(value) < 1e-9 * marks.step;
    if (is_left) drawing.line({frame.left, y}, {frame.right, y}, is_zero ? "zero" : "grid");
    drawing.text({is_left ? x - 7.0 : x + 7.0, y + 4.0}, mark_text(value, marks.step, scale),
                 is_left ? SvgAnchor::end : SvgAnchor::start);
  }
  drawing.line({x, frame.top}, {x, frame.bottom}, "axis");
  drawing.text_upward({is_left ? 12.0 : frame.width - 6.0, 0.5 * (frame.top + frame.bottom)},
                      scale.title);
}

}  // namespace frustum::report
