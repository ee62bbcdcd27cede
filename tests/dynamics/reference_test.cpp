// Numbers of tests/data/dynamics.json: relative coordinates, particles and complex-step
// derivatives, computed apart from this code. The tolerance is a share of the largest entry; the
// numbers have ten digits.
#include "core/linear_algebra.hpp"
#include "dynamics/inertial_load.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/response.hpp"
#include "dynamics/workspace_map.hpp"
#include "tests/dynamics/machines.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double kPoleShare = 1e-7;

struct Case {
  std::string machine;
  std::string name;
  json numbers;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& [name, numbers] : expected()["iwf-bc"].items()) {
    cases.push_back({"iwf-bc", name, numbers});
  }
  for (const auto& [name, numbers] : expected()["cantilever"].items()) {
    cases.push_back({name, name, numbers});
  }
  return cases;
}

class DynamicsReference : public testing::TestWithParam<Case> {
 protected:
  const json& wanted_ = GetParam().numbers;
  DynamicModel model_ = model_named(GetParam().machine);
  Structure structure_ =
      structure_at(model_, positions_of(wanted_["axes"]), wanted_["tool_length_mm"].get<double>());
};

INSTANTIATE_TEST_SUITE_P(, DynamicsReference, testing::ValuesIn(all_cases()), [](const auto& c) {
  std::string name = c.param.name;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST_P(DynamicsReference, HasTheTipAndTheModes) {
  expect_near(as_json(Vec3(structure_.tip_in_machine * 1e3)), wanted_["tip_in_machine_mm"], kShare,
              "tip");
  EXPECT_EQ(structure_.coordinates(), wanted_["coordinates"].get<int>());
  const UndampedModes modes = undamped_modes(structure_);
  const std::size_t count = wanted_["undamped_hz"].size();
  expect_near(first(modes.frequencies, count), wanted_["undamped_hz"], kShare, "frequencies");
  EXPECT_NEAR(modes.frequencies[modes.frequencies.size() - 1], wanted_["highest_hz"].get<double>(),
              1e-6);
  const MatrixXd weights = modes.tip.leftCols(static_cast<Eigen::Index>(count)).cwiseAbs2();
  expect_near(as_json(MatrixXd(weights.transpose())), wanted_["tip_shape_squared"], kShare,
              "tip weights");
}

TEST_P(DynamicsReference, HasTheDampedModes) {
  const Poles poles = damped_modes(structure_);
  const json& wanted = wanted_["damped"];
  const std::size_t count = wanted["frequency_hz"].size();
  expect_near(first(poles.frequencies, count), wanted["frequency_hz"], kPoleShare, "frequencies");
  expect_near(first(poles.ratios, count), wanted["damping_ratio"], kPoleShare, "ratios");
  EXPECT_EQ(poles.real.size(), wanted["real_poles_1_s"].size());
}

TEST_P(DynamicsReference, HasTheResponseAtRest) {
  const StaticResponse rest = static_response(model_, structure_);
  expect_near(as_json(MatrixXd(rest.compliance * kUm)), wanted_["static_compliance_um_per_n"],
              kShare, "compliance");
  expect_near(as_json(Vec3(rest.stiffness() / kUm)), wanted_["static_stiffness_n_per_um"], kShare,
              "stiffness");
  expect_near(as_json(Vec3(rest.sag * kUm)), wanted_["gravity_sag_um"], kShare, "sag");
  MatrixXd inertial = rest.inertial;
  json order = json::array();
  for (Eigen::Index k = 0; k < inertial.cols(); ++k) {
    const kinematics::Joint& joint = model_.axes[static_cast<std::size_t>(k)].joint;
    inertial.col(k) *= inertial_scale(joint);
    order.push_back(std::string(1, to_char(joint.letter)));
  }
  EXPECT_EQ(order, wanted_["axis_order"]);
  expect_near(as_json(inertial), wanted_["inertial_compliance"], kShare, "inertial compliance");
}

TEST_P(DynamicsReference, HasTheFrequencyResponses) {
  for (const auto& [frequency, wanted] : wanted_["frf_um_per_n"].items()) {
    const HarmonicSystem system = harmonic_system(structure_, std::stod(frequency));
    expect_near(as_json(MatrixXcd(tip_compliance(system) * kUm)), wanted, kShare,
                frequency + " Hz");
  }
  for (const auto& [frequency, wanted] : wanted_["inertial_frf"].items()) {
    const HarmonicSystem system = harmonic_system(structure_, std::stod(frequency));
    const MatrixXd loads = unit_acceleration_loads(model_, structure_);
    MatrixXcd found = tip_response(system, loads.cast<std::complex<double>>());
    for (Eigen::Index k = 0; k < found.cols(); ++k) {
      found.col(k) *= inertial_scale(model_.axes[static_cast<std::size_t>(k)].joint);
    }
    expect_near(as_json(found), wanted, kShare, "inertial at " + frequency + " Hz");
  }
}

TEST(RatesReference, HasTheDeviationsInMotion) {
  const DynamicModel model = model_named("iwf-bc");
  for (const json& c : expected()["rates"]) {
    const Structure s =
        structure_at(model, positions_of(c["axes"]), c["tool_length_mm"].get<double>());
    kinematics::AxisPositions velocity, acceleration;
    for (const auto& [letter, rates] : c["rates_si"].items()) {
      const auto axis = *kinematics::axis_named(letter);
      const double unit = is_rotary(axis) ? 1.0 : 1e3;
      velocity[axis] = rates[0].get<double>() * unit;
      acceleration[axis] = rates[1].get<double>() * unit;
    }
    const Eigen::VectorXd tip =
        s.tip *
        SymmetricFactors(s.stiffness).solve(inertial_load(model, s, velocity, acceleration));
    const Vec3 d = tip.head<3>() * kUm, r = tip.tail<3>() * kUm;
    expect_near(as_json(d), c["tip_in_machine_um"], kShare, "machine");
    expect_near(as_json(Vec3(s.machine_from_table.transpose() * d)), c["tip_in_table_um"], kShare,
                "table");
    expect_near(as_json(Vec3(s.machine_from_table.transpose() * r)), c["turn_in_table_urad"],
                kShare, "turn");
  }
}

void expect_map(const std::string& machine, const json& wanted) {
  const auto axis_of = [](const json& axis) {
    return MapAxis{*kinematics::axis_named(axis[0].get<std::string>()), axis[1], axis[2], axis[3]};
  };
  const auto map =
      map_workspace(model_named(machine), positions_of(wanted["fixed"]), wanted["tool_length_mm"],
                    axis_of(wanted["rows"]), axis_of(wanted["columns"]), InertialQuantity{});
  ASSERT_TRUE(map);
  expect_near(as_json(map->values), wanted["values"], 5e-6, "values with six digits");
  const json& box = wanted["box"];
  expect_near({map->box.min, map->box.q1, map->box.median, map->box.q3, map->box.max},
              {box["min"], box["q1"], box["median"], box["q3"], box["max"]}, kShare, "box");
  expect_near(map->frequency_ranges, wanted["frequency_range_hz"], kShare, "ranges");
}

TEST(WorkspaceMapReference, HasTheGridsOfThreeMachines) {
  expect_map("iwf-bc", expected()["grid"]);
  for (const auto& [name, numbers] : expected()["cantilever"].items()) {
    expect_map(name, numbers["grid"]);
  }
}

}  // namespace
}  // namespace frustum::dynamics
