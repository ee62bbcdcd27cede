#include "report/chart/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

// From light to dark of one colour, which grey prints in the same order.
std::string shade(double share) {
  constexpr std::array<std::array<double, 3>, 2> kEnds{
      {{232.0, 240.0, 247.0}, {16.0, 62.0, 112.0}}};
  const auto channel = [&](std::size_t i) {
    return std::lround(kEnds[0].at(i) + share * (kEnds[1].at(i) - kEnds[0].at(i)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2));
}

}  // namespace

std::optional<std::array<double, 2>> range_of(const HeatMap& map) {
  std::optional<std::array<double, 2>> range;
  for (const auto& value : map.values) {
    if (!value) continue;
    if (!range) range = {*value, *value};
    range = {std::min((*range)[0], *value), std::max((*range)[1], *value)};
  }
  return range;
}

std::string heat_map_figure(const HeatMap& map, const Wording& words) {
  const auto [low, high] =
      map.shades ? *map.shades : range_of(map).value_or(std::array<double, 2>{0.0, 0.0});
  // More columns than these leave no room for their values: the shades and their ends say them.
  constexpr std::size_t kWrittenColumns = 14;
  const bool written = map.columns.size() <= kWrittenColumns;
  constexpr double kLeft = 150.0, kTop = 46.0;
  const double row_height = written ? 44.0 : 24.0;
  const double width = 900.0;
  const std::size_t every =
      written ? 1 : (map.columns.size() + kWrittenColumns - 1) / kWrittenColumns;
  const double cell =
      (width - kLeft - 16.0) / static_cast<double>(std::max<std::size_t>(map.columns.size(), 1));
  const double height = kTop + row_height * static_cast<double>(map.rows.size()) + 8.0;
  SvgDrawing drawing(width, height, map.title);
  drawing.text({kLeft + 0.5 * (width - kLeft), 14.0}, map.column_title);
  drawing.text({kLeft - 10.0, 14.0}, map.row_title, SvgAnchor::end);
  for (std::size_t k = 0; k < map.columns.size(); k += every) {
    drawing.text({kLeft + (static_cast<double>(k) + 0.5) * cell, 36.0}, map.columns[k]);
  }
  for (std::size_t i = 0; i < map.rows.size(); ++i) {
    const double y = kTop + row_height * static_cast<double>(i);
    drawing.text({kLeft - 10.0, y + 0.5 * row_height + 4.0}, map.rows[i], SvgAnchor::end);
    for (std::size_t k = 0; k < map.columns.size(); ++k) {
      const auto& value = map.values[i * map.columns.size() + k];
      if (!value) continue;
      const double share = high > low ? (*value - low) / (high - low) : 0.0;
      const double x = kLeft + static_cast<double>(k) * cell;
      drawing.rectangle({x, y}, {x + cell, y + row_height}, "cell", shade(share));
      if (!written) continue;
      drawing.text({x + 0.5 * cell, y + 0.5 * row_height + 4.0},
                   words.number(fmt::format("{:.4g}", *value)), SvgAnchor::middle,
                   share > 0.45 ? "on-dark" : "on-light");
    }
  }
  const std::string ends =
      written ? ""
              : fmt::format(
                    "<span class=\"shades\">{} <i style=\"background:linear-gradient("
                    "90deg,{},{})\"></i> {}</span>",
                    words.number(fmt::format("{:.4g}", low)), shade(0.0), shade(1.0),
                    words.number(fmt::format("{:.4g}", high)));
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(map.title), ends, drawing.html());
}

}  // namespace frustum::report
