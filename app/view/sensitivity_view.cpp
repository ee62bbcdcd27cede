#include "app/view/sensitivity_view.hpp"

#include "app/view/shown_unit.hpp"

namespace frustum::app {

report::SensitivityTable sensitivity_table(const trials::Sensitivity& derivatives,
                                           const std::string& title, const std::string& machine,
                                           const std::string& method) {
  report::SensitivityTable table{title, machine, method, {}, {}, derivatives.odd, derivatives.even};
  const auto& characteristics = derivatives.measurement.characteristics;
  for (std::size_t i = 0; i < characteristics.size(); ++i) {
    const ShownUnit unit = shown_unit(metrology::is_angle(characteristics[i]));
    table.characteristics.push_back({characteristics[i].name, unit.name});
    table.odd.row(static_cast<Eigen::Index>(i)) *= unit.per_internal;
    table.even.row(static_cast<Eigen::Index>(i)) *= unit.per_internal;
  }
  for (std::size_t k = 0; k < derivatives.parameters.size(); ++k) {
    const ShownUnit unit = shown_unit(derivatives.parameters[k].angular);
    table.parameters.push_back({derivatives.parameters[k].name, unit.name});
    table.odd.col(static_cast<Eigen::Index>(k)) /= unit.per_internal;
    table.even.col(static_cast<Eigen::Index>(k)) /= unit.per_internal;
  }
  return table;
}

}  // namespace frustum::app
