#include "app/motion/turn_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "instruments/turn_harmonics.hpp"

namespace frustum::app {

void add_turn_evaluation(MotionAnswer& answer, const std::string& angle_name,
                         const std::vector<double>& angles, const std::vector<double>& readings) {
  answer.document["evaluation"] = {};
  const auto [least, most] = std::ranges::minmax(readings);
  const report::Wording& words = answer.words;
  const std::string um(words.unit("um"));
  answer.text += (readings.size() == 1 ? words("1 reading, {0} .. {1} {2}", shown_um(least, words),
                                               shown_um(most, words), um)
                                       : words("{0} readings, {1} .. {2} {3}", readings.size(),
                                               shown_um(least, words), shown_um(most, words), um)) +
                 "\n";
  answer.page.charts.push_back({.title = words("Reading of the bar"),
                                .along_title = angle_name + ", °",
                                .value_title = words("reading, {0}", words.symbol("um")),
                                .lines = {{.name = words("reading"),
                                           .along = in_degrees(angles),
                                           .value = drawn_um(readings, words)}}});
  std::string csv = "angle_deg,reading_um\n";
  for (std::size_t i = 0; i < angles.size(); ++i) {
    csv += fmt::format("{},{}\n", shortest_decimal(angles[i] * kDegPerRad),
                       shortest_decimal(readings[i] * kUmPerMm));
  }
  answer.files["trace.csv"] = std::move(csv);
  const auto found = instruments::turn_harmonics({angles, readings});
  if (!found) {
    for (const Diagnostic& each : found.error()) {
      answer.warnings.push_back(warning(each.id, "no evaluation: " + each.message, each.hint));
    }
    return;
  }
  constexpr std::array<const char*, 5> kNames{"mean", "cos", "sin", "cos2", "sin2"};
  Document harmonics;
  TextTable table({words("harmonic over {0}", angle_name), um});
  report::MotionTable shown{.heading = words("Harmonics over {0}", angle_name),
                            .columns = {words("harmonic"), ">" + um}};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    harmonics[kNames[k]] = found->value[k] * kUmPerMm;
    const std::vector<std::string> cells{words.word(kNames[k]), shown_um(found->value[k], words)};
    table.row(cells);
    shown.rows.push_back(cells);
  }
  answer.document["evaluation"] = Document{{"harmonics_um", harmonics},
                                           {"form_um", found->form * kUmPerMm},
                                           {"residual_rms", found->residual_rms * kUmPerMm}};
  shown.note =
      words("Peak to valley without mean, cos and sin: {0} {1}.", shown_um(found->form, words), um);
  answer.page.tables.push_back(std::move(shown));
  answer.text += table.text();
  answer.text +=
      words("peak to valley without mean, cos and sin {0} {2}, beyond two harmonics {1} {2} rms",
            shown_um(found->form, words), shown_um(found->residual_rms, words), um) +
      "\n";
}

}  // namespace frustum::app
