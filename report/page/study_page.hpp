// The page of a study of many machines: what they make, how surely, and which errors make it.
//
// Everything is HTML and SVG; each figure's numbers are in the page as a CSV to be downloaded, in
// English, um and urad whatever the style of the page.
// Units: um, urad; texts say theirs. Errors: none.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/chart/distribution_chart.hpp"
#include "report/chart/heat_map.hpp"
#include "report/chart/risk_chart.hpp"
#include "report/chart/scatter_chart.hpp"
#include "report/chart/tornado_chart.hpp"
#include "report/wording.hpp"

namespace frustum::report {

struct StudyPageCharacteristic {
  std::string name{}, unit{};
  BoxRow box{};
  DistributionLine distribution{};
  std::vector<std::string> row{};  // of the table: 5 %, median with interval, 95 %, limit, conforms
  std::optional<RiskCurve> risk{};
};

struct StudyPage {
  ReportStyle style{};
  std::string title{};
  std::vector<std::array<std::string, 2>> facts{};
  std::vector<std::string> remarks{};  // what was not reached, failed draws
  std::string all_conform{};           // P(all limits); empty: none
  std::vector<StudyPageCharacteristic> characteristics{};
  // As in their files, and as they are shown; those without are shown as in the files.
  std::optional<std::array<ScatterSeries, 2>> scatter{}, shown_scatter{};
  std::string share_characteristic{};
  std::vector<TornadoRow> shares{};
  std::vector<std::array<std::string, 2>> allocation{};  // group, factor
  std::string allocation_text{};
  std::vector<HeatMap> maps{}, shown_maps{};  // as the scatter
};

[[nodiscard]] std::string study_html(const StudyPage& page);

}  // namespace frustum::report
