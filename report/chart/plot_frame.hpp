// The frame of a plot over x: scales, grid, ticks and titles; a second scale may be on the right.
//
// Units: pixels of the drawing; the values' own. Errors: none; an empty range is widened.
#pragma once

#include <string>

#include "report/chart/svg.hpp"

namespace frustum::report {

struct PlotRange {
  double low = 0.0;
  double high = 1.0;
  // Holds a value that is finite.
  void include(double value);
  // Wider by a share of itself on both sides, at least `least` wide.
  [[nodiscard]] PlotRange widened(double share, double least) const;
  static PlotRange empty();
};

struct PlotScale {
  PlotRange range{};
  std::string title{};
  int count = 6;      // ticks, about
  double step = 0.0;  // between ticks, where it is not found by their count
  char decimal_sign = '.';
};

struct PlotFrame {
  double width = 0.0, height = 0.0;                         // of the drawing
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;  // of the plot

  [[nodiscard]] SvgPoint at(double x, double y, const PlotScale& on_x, const PlotScale& on_y) const;
};

enum class PlotSide { left, right };
void draw_x_scale(SvgDrawing& drawing, const PlotFrame& frame, const PlotScale& scale);
// The right scale has no grid.
void draw_y_scale(SvgDrawing& drawing, const PlotFrame& frame, const PlotScale& scale,
                  PlotSide side = PlotSide::left);

}  // namespace frustum::report
