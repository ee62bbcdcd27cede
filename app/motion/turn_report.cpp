#include "app/motion/turn_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/view/text_table.hpp"
#include "core/counted.hpp"
#include "core/decimal.hpp"
#include "instruments/turn_harmonics.hpp"

namespace frustum::app {

void add_turn_evaluation(MotionAnswer& answer, const std::string& angle_name,
                         const std::vector<double>& angles, const std::vector<double>& readings) {
  answer.document["evaluation"] = {};
  const auto [least, most] = std::ranges::minmax(readings);
  answer.text += fmt::format("{}, {} .. {} um\n", counted(readings.size(), "reading"),
                             fixed_decimal(least * kUmPerMm, 3), fixed_decimal(most * kUmPerMm, 3));
  answer.page.charts.push_back(
      {.title = "Reading of the bar",
       .along_title = angle_name + ", °",
       .value_title = "reading, µm",
       .lines = {{.name = "reading", .along = in_degrees(angles), .value = in_um(readings)}}});
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
  TextTable table({"harmonic over " + angle_name, "um"});
  report::MotionTable shown{.heading = "Harmonics over " + angle_name,
                            .columns = {"harmonic", ">um"}};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    harmonics[kNames[k]] = found->value[k] * kUmPerMm;
    table.row({kNames[k], fixed_decimal(found->value[k] * kUmPerMm, 3)});
    shown.rows.push_back({kNames[k], fixed_decimal(found->value[k] * kUmPerMm, 3)});
  }
  answer.document["evaluation"] = Document{{"harmonics_um", harmonics},
                                           {"form_um", found->form * kUmPerMm},
                                           {"residual_rms", found->residual_rms * kUmPerMm}};
  shown.note =
      fmt::format("Peak to valley without mean, cos and sin: {:.3f} um.", found->form * kUmPerMm);
  answer.page.tables.push_back(std::move(shown));
  answer.text += table.text();
  answer.text += fmt::format(
      "peak to valley without mean, cos and sin {:.3f} um, beyond two harmonics {:.3f} um rms\n",
      found->form * kUmPerMm, found->residual_rms * kUmPerMm);
}

}  // namespace frustum::app
