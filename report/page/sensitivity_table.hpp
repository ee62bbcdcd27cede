// A matrix of derivatives as people and programs read it: characteristics by errors.
//
// Units: as named: um per um, um per urad, urad per um, urad per urad.
// Errors: none; numbers that are not finite print as "-" and are null in JSON.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace frustum::report {

struct NamedUnit {
  std::string name{};
  std::string unit{};  // "um" or "urad"
};

struct SensitivityTable {
  std::string title{};
  std::string machine{};
  std::string method{};
  std::vector<NamedUnit> characteristics{};
  std::vector<NamedUnit> parameters{};
  Eigen::MatrixXd odd{};   // characteristic unit per parameter unit
  Eigen::MatrixXd even{};  // what the characteristic gains with either sign of the parameter
};

// {"characteristics":[..],"errors":[..],"units":[..],"matrix":[[..]],...}: interfaces of the
// command.
[[nodiscard]] std::string sensitivity_json(const SensitivityTable& table);
// One row a characteristic, one column a parameter, units in the headings.
[[nodiscard]] std::string sensitivity_csv(const SensitivityTable& table);
// For a terminal; parameters that no characteristic answers are named below instead of taking
// columns.
[[nodiscard]] std::string sensitivity_text(const SensitivityTable& table, int width);
// A page with the matrix as a heat map; complete in itself.
[[nodiscard]] std::string sensitivity_html(const SensitivityTable& table);

}  // namespace frustum::report
