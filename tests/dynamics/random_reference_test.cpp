// Machines drawn at random, with all kinds of elements on both sides, beside another computation.
#include <fstream>

#include "dynamics/inertial_load.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/path_response.hpp"
#include "dynamics/response.hpp"
#include "dynamics/workspace_map.hpp"
#include "tests/dynamics/machines.hpp"

namespace frustum::dynamics {
namespace {

const json& random_machines() {
  static const json kMachines = [] {
    std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/dynamics_random.json");
    return json::parse(in)["machines"];
  }();
  return kMachines;
}

// Rates in m, rad, s.
kinematics::AxisPositions rates_of(const json& rates) {
  kinematics::AxisPositions found;
  for (const auto& [letter, value] : rates.items()) {
    const auto axis = *kinematics::axis_named(letter);
    found[axis] = value.get<double>() * (is_rotary(axis) ? 1.0 : 1e3);
  }
  return found;
}

TEST(RandomMachinesReference, AgreeInAllThatIsAnswered) {
  for (const json& c : random_machines()) {
    const std::string name = "machine " + c["seed"].dump();
    const auto read = model_from_text(c["text"]);
    ASSERT_TRUE(read) << name << to_string(read.error().front());
    const DynamicModel& model = **read;
    const auto q = positions_of(c["axes"]);
    const double tool = c["tool_length"];
    const Structure s = structure_at(model, q, tool);
    const auto count = static_cast<std::size_t>(s.coordinates());
    expect_near(first(undamped_modes(s).frequencies, count), c["undamped_hz"], kShare, name);
    const Poles poles = damped_modes(s);
    expect_near(first(poles.frequencies, 6), c["damped_hz"], 1e-7, name);
    expect_near(first(poles.ratios, 6), c["damping_ratio"], 1e-7, name);
    const StaticResponse rest = static_response(model, s);
    expect_near(as_json(Eigen::MatrixXd(rest.compliance * kUm)), c["static_compliance_um_per_n"],
                kShare, name);
    expect_near(as_json(Vec3(rest.sag * kUm)), c["gravity_sag_um"], kShare, name);
    Eigen::MatrixXd inertial = rest.inertial;
    for (Eigen::Index k = 0; k < inertial.cols(); ++k) {
      const auto axis = static_cast<std::size_t>(k);
      EXPECT_EQ(model.body_name(axis + 1), c["axis_order"][axis]) << name;
      inertial.col(k) *= inertial_scale(model.axes[axis].joint);
    }
    expect_near(as_json(inertial), c["inertial_compliance"], kShare, name);
    expect_near(as_json(Eigen::MatrixXcd(tip_compliance(harmonic_system(s, 63.0)) * kUm)),
                c["compliance_63_hz_um_per_n"], kShare, name);
    const MotionSample sample{q, rates_of(c["velocity"]), rates_of(c["acceleration"])};
    const auto moved = quasi_static_deviations(model, {&sample, 1}, tool);
    expect_near(as_json(Vec3(moved[0].tip * kUm)), c["tip_in_table_um"], kShare, name);
    expect_near(as_json(Vec3(moved[0].turn * kUm)), c["turn_in_table_urad"], kShare, name);
  }
}

}  // namespace
}  // namespace frustum::dynamics
