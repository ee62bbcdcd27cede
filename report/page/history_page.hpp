// The page of a history: a table of what was followed, a control chart of each, what adjustments
// changed, and where each result and its date come from.
//
// Everything is HTML and SVG, and opens without a network or a script.
// Units: as the texts say. Errors: none.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "report/chart/control_chart.hpp"
#include "report/wording.hpp"

namespace frustum::report {

struct HistoryTable {
  std::string id{}, heading{}, note{};
  std::vector<std::string> columns{};  // those of numbers begin with '>'
  std::vector<std::vector<std::string>> rows{};
};

struct HistoryPage {
  ReportStyle style{};
  std::string title{};
  bool passes = true;
  std::string reason{};                             // beside the verdict
  std::vector<std::array<std::string, 2>> facts{};  // name, value
  std::vector<std::string> failures{}, remarks{};
  HistoryTable values{};
  std::vector<ControlChart> charts{};
  std::vector<HistoryTable> tables{};  // below the charts; one without rows is left out
};

[[nodiscard]] std::string history_html(const HistoryPage& page);

}  // namespace frustum::report
