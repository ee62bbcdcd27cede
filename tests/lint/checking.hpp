// Checks NC text in tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "kinematics/model/machine.hpp"
#include "lint/program_check.hpp"

namespace frustum::lint {

[[nodiscard]] inline CheckReport checked(std::string_view text, const CheckOptions& options = {},
                                         parser::Dialect dialect = parser::Dialect::fanuc,
                                         bool ask_for_points = false) {
  CheckOptions quick = options;
  quick.most_turns = 1000;
  if (!quick.run.control.unit) quick.run.control.unit = parser::LengthUnit::millimetre;
  quick.decimal_point_is_known = !ask_for_points;
  return check_program({"part.nc", dialect, parser::ProgramText(std::string(text))}, quick);
}

[[nodiscard]] inline std::vector<Finding> of(const CheckReport& report, std::string_view id) {
  std::vector<Finding> found;
  for (const Finding& finding : report.findings) {
    if (info_of(finding.check).id == id) found.push_back(finding);
  }
  return found;
}

[[nodiscard]] inline std::string ids(const CheckReport& report) {
  std::string text;
  for (const Finding& finding : report.findings) {
    if (finding.suppressed != Suppressed::no) continue;
    text += std::to_string(finding.line) + ":" + std::string(info_of(finding.check).id) + " ";
  }
  return text;
}

[[nodiscard]] inline kinematics::Machine shipped(const std::string& name) {
  const std::string folder = std::string(FRUSTUM_SOURCE_DIR) + "/machines/";
  auto machine = kinematics::Machine::load(folder + name + ".toml");
  if (!machine) throw std::runtime_error(to_string(machine.error().front()));
  return *std::move(machine);
}

}  // namespace frustum::lint
