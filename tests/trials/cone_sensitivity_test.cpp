// Analytic gains of the cone's characteristics against differences of whole trials. The ball rests
// on edges between the facets of the path at every tenth point, where only the direction in
// which it touches says how far it moves.

#include "tests/trials/cone_trial.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::trials {
namespace {

TEST(ConeSensitivityReference, AnalyticGainsAgreeWithDifferencesOfWholeTrials) {
  const ConeTrial cone = ConeTrial::on("iwf-bc");
  std::vector<kinematics::ErrorEntry> entries;
  for (const char* text : {"EX0C=10um", "EA0B=20urad"}) {
    entries.push_back(*kinematics::parse_error(text));
  }
  const auto errors = errors_for(cone.machine, entries, cone.piece);
  ASSERT_TRUE(errors);
  const std::vector<std::string> names{"EX0Y", "EY0Y", "EC0B", "EZ0C", "EX0C"};
  const auto parameters = parameters_named(cone.machine, names);
  ASSERT_TRUE(parameters);
  const auto analytic = sensitivity(cone.machine, *errors, cone.piece, *parameters);
  const auto whole = sensitivity_by_differences(cone.machine, *errors, cone.piece, *parameters);
  ASSERT_TRUE(analytic && whole);
  const auto& characteristics = analytic->measurement.characteristics;
  for (std::size_t i = 0; i < characteristics.size(); ++i) {
    const double per_value = metrology::is_angle(characteristics[i]) ? 1e6 : 1e3;
    for (std::size_t k = 0; k < parameters->size(); ++k) {
      const double unit = per_value / ((*parameters)[k].angular ? 1e6 : 1e3);
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(k);
      EXPECT_NEAR(unit * analytic->odd(row, column), unit * whole->odd(row, column), 2e-4)
          << characteristics[i].name << " to " << (*parameters)[k].name;
    }
  }
}

}  // namespace
}  // namespace frustum::trials
