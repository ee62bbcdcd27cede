#include "report/chart/profile_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "report/chart/plot_frame.hpp"
#include "report/chart/series_key.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

using metrology::LineProfile;

bool same_lines(const metrology::CharacteristicResult& a,
                const metrology::CharacteristicResult& b) {
  return std::equal(a.profiles.begin(), a.profiles.end(), b.profiles.begin(), b.profiles.end(),
                    [](const auto& p, const auto& q) { return p.feature == q.feature; });
}

// In the shown unit; the position in mm.
double fitted(const LineProfile& line, double position, const Wording& words) {
  return words.shown(kUmPerMm * (line.fit_offset + line.fit_slope * position), "um");
}

PlotRange positions_of(const LineProfile& line) {
  PlotRange range = PlotRange::empty();
  for (const double position : line.position) range.include(position);
  return range;
}

}  // namespace

bool has_profile_chart(const RunReport& report,
                       const metrology::CharacteristicResult& characteristic) {
  const auto& profiles = characteristic.profiles;
  if (profiles.empty() || std::any_of(profiles.begin(), profiles.end(), [](const auto& line) {
        return line.position.empty() || line.position.size() != line.deviation.size();
      })) {
    return false;
  }
  if (characteristic.kind == "line_distance") return true;
  const auto& all = report.measurement.characteristics;
  return std::none_of(all.begin(), all.end(), [&](const auto& other) {
    return other.kind == "line_distance" && same_lines(other, characteristic);
  });
}

std::string profile_figure(const metrology::CharacteristicResult& characteristic,
                           const Wording& words) {
  const auto um = [&](double mm) { return words.shown(mm * kUmPerMm, "um"); };
  PlotRange along = PlotRange::empty(), across = PlotRange::empty();
  across.include(0.0);
  for (const LineProfile& line : characteristic.profiles) {
    const PlotRange own = positions_of(line);
    along.include(own.low);
    along.include(own.high);
    for (const double d : line.deviation) across.include(um(d));
    for (const double end : {own.low, own.high}) across.include(fitted(line, end, words));
  }
  constexpr double kLeastAcross = 0.1;  // um: errors of a few nanometres do not look like errors
  PlotScale on_x{along.widened(0.06, 1e-6), words("position along, {0}", words.symbol("mm")), 5};
  PlotScale on_y{across.widened(0.06, words.shown(kLeastAcross, "um")),
                 words("error across, {0}", words.symbol("um")), 5};
  const PlotFrame frame{330.0, 216.0, 54.0, 324.0, 8.0, 176.0};
  // Positions stay in mm until they are drawn.
  on_x.range = {words.shown(on_x.range.low, "mm"), words.shown(on_x.range.high, "mm")};
  on_x.decimal_sign = on_y.decimal_sign = words.decimal_sign();
  const auto place = [&](double position, double value) -> SvgPoint {
    return frame.at(words.shown(position, "mm"), value, on_x, on_y);
  };
  SvgDrawing drawing(frame.width, frame.height,
                     words("Profiles of the two lines of {0}", characteristic.name));
  draw_x_scale(drawing, frame, on_x);
  draw_y_scale(drawing, frame, on_y);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < characteristic.profiles.size(); ++k) {
    const LineProfile& line = characteristic.profiles[k];
    names.push_back(line.feature);
    const PlotRange ends = positions_of(line).widened(0.04, 0.0);
    drawing.polyline({place(ends.low, fitted(line, ends.low, words)),
                      place(ends.high, fitted(line, ends.high, words))},
                     series_class("fit", k));
    for (std::size_t i = 0; i < line.position.size(); ++i) {
      const SvgPoint at = place(line.position[i], um(line.deviation[i]));
      if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
      drawing.circle(at, 2.8, series_class(k % 2 == 0 ? "dot" : "ring", k));
    }
  }
  return fmt::format(
      "<figure class=\"profile\"><figcaption><b>{}</b> <span class=\"scale\">{} {}</span>{}"
      "</figcaption>\n{}</figure>\n",
      html_text(characteristic.name), words.result(characteristic),
      html_text(words.symbol(characteristic.unit)), series_key(names, {"dot", "ring"}),
      drawing.html());
}

}  // namespace frustum::report
