// Probes, temperatures and machines that are stated: what they add to uncertainties, linear and
// simulated.
#include "metrology/uncertainty/point_uncertainty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "metrology/cmm.hpp"
#include "metrology/probing/cmm_errors.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"
#include "tests/metrology/test_part.hpp"

namespace frustum::metrology {
namespace {

const CmmModel kStated{.e0_mm = 0.002, .length_per_error = 300.0, .seed = 7};

TEST(PointUncertainty, AddsTheMeanSquaresOfAStatedProbe) {
  const PointUncertainty plain = point_uncertainty(kStated);
  EXPECT_EQ(plain.probing, 0.001);
  EXPECT_EQ(plain.scale, 0.5e-3 / 300.0);
  const auto added = [](const ProbeErrors& probe) {
    CmmModel cmm = kStated;
    cmm.probe = probe;
    cmm.stylus = Stylus{.length = 40.0, .diameter = 1.5};
    const PointUncertainty u = point_uncertainty(cmm);
    EXPECT_EQ(u.scale, 0.5e-3 / 300.0);
    return u.probing * u.probing - 1e-6;
  };
  constexpr double kExact = 1e-18;  // mm^2
  EXPECT_NEAR(added({.lobe = 0.002}), 2e-6, kExact);
  EXPECT_NEAR(added({.ball_form = 0.003}), 3e-6, kExact);
  EXPECT_NEAR(added({.repeatability = 0.0005}), 0.25e-6, kExact);
  EXPECT_NEAR(added({.scan_noise = 0.0004}), 0.16e-6, kExact);
  EXPECT_NEAR(added({.pre_travel = 0.01}), 0.0, kExact);  // qualification takes it out
  const double bend = 0.1 * 64000.0 / (3.0 * 600e3 * std::numbers::pi * 5.0625 / 64.0);
  EXPECT_NEAR(added({.force = 0.1}), bend * bend / 3.0, kExact);
  // The statement of a machine with a field contains its probe.
  CmmModel field = kStated;
  field.kind = CmmKind::field;
  field.probe = ProbeErrors{.lobe = 0.002};
  EXPECT_EQ(point_uncertainty(field).probing, 0.001);
}

TEST(PointUncertainty, AddsTheGrowthThatTemperaturesLeave) {
  const auto added = [](const ThermalState& temperature) {
    CmmModel cmm = kStated;
    cmm.temperature = temperature;
    const PointUncertainty u = point_uncertainty(cmm);
    EXPECT_EQ(u.probing, 0.001);
    return u.scale * u.scale - std::pow(0.5e-3 / 300.0, 2);
  };
  constexpr double kExact = 1e-20;
  // Not compensated: all of it, and twice.
  const double growth = 11.5e-6 * 3.0 - 8e-6 * 1.0;
  EXPECT_NEAR(added({.part = 23.0, .scales = 21.0}), 2.0 * growth * growth, kExact);
  EXPECT_NEAR(added({.part = 23.0, .scales = 21.0, .compensated = true}), 0.0, kExact);
  EXPECT_NEAR(added({.compensated = true, .sensor_error = 0.3}),
              2.0 * 0.09 * (11.5 * 11.5 + 8.0 * 8.0) * 1e-12 / 3.0, kExact);
  EXPECT_NEAR(added({.part = 23.0, .scales = 21.0, .compensated = true, .expansion_error = 0.5e-6}),
              2.0 * 0.25e-12 * (9.0 + 1.0) / 3.0, kExact);
}

TEST(ErrorDraws, AreMachinesWithTheProbeThatIsStated) {
  CmmModel cmm;
  cmm.probe = ProbeErrors{.lobe = 0.002};
  const CmmErrors machine(cmm);
  const ErrorDraws draws = error_draws(cmm, 1);
  for (std::uint32_t draw = 0; draw < 3; ++draw) {
    const MeasuringErrors errors = draws(draw);
    for (int i = 0; i < 12; ++i) {
      const double turn = std::numbers::pi * i / 6.0;
      const Vec3 outward(std::cos(turn), std::sin(turn), 0.0);
      const Vec3 centre = 25.0 * outward;
      const Vec3 expected =
          machine.measured({centre, outward, 0}) - machine.ball_radius(0.0) * outward;
      EXPECT_NEAR((errors(centre, outward, 0, 0) - expected).norm(), 0.0, 1e-12);
      EXPECT_NEAR((expected - centre).norm(), 0.002 * std::abs(std::sin(3.0 * turn)), 1e-8);
    }
  }
}

TEST(ErrorDraws, AreMachinesInTheTemperatureThatIsStated) {
  CmmModel cmm;
  cmm.temperature = ThermalState{.part = 30.0};
  const MeasuringErrors errors = error_draws(cmm, 1)(0);
  const Vec3 centre(100.0, -50.0, 20.0);
  EXPECT_LT((errors(centre, Vec3::UnitX(), 0, 0) - (1.0 + 115e-6) * centre).norm(), 1e-12);
}

// Noise of e0/2 and normal scales pass the limit again and again.
TEST(ErrorDraws, OfAFieldKeepItsStatement) {
  const auto worst_of = [](CmmKind kind) {
    CmmModel cmm = kStated;
    cmm.kind = kind;
    const ErrorDraws draws = error_draws(cmm, 1);
    double worst = 0.0;
    for (std::uint32_t draw = 0; draw < 100; ++draw) {
      const MeasuringErrors errors = draws(draw);
      for (int i = 0; i < 4; ++i) {
        const Vec3 along = Vec3(1, i, -i).normalized();
        const double length = 60.0 * (i + 1);
        const auto point = static_cast<std::size_t>(2 * i);
        const Vec3 first = errors(Vec3::Zero(), -along, 0, point);
        const Vec3 second = errors(length * along, along, 0, point + 1);
        const double error = (second - first).dot(along) - length;
        worst = std::max(worst, std::abs(error) / length_limit(cmm, length));
      }
    }
    return worst;
  };
  EXPECT_LT(worst_of(CmmKind::field), 1.0);
  EXPECT_GT(worst_of(CmmKind::field), 0.2);
  EXPECT_GT(worst_of(CmmKind::linear), 1.0);
}

// One feature of the part, with what is asked of it.
InspectionPlan plan_of_feature(std::size_t feature,
                               const std::vector<std::string>& characteristics) {
  InspectionPlan plan = test_part::plan();
  plan.alignment = Alignment::plan;
  plan.datum.reset();
  plan.features = {plan.features[feature]};
  std::erase_if(plan.characteristics, [&](const PlannedCharacteristic& c) {
    return std::find(characteristics.begin(), characteristics.end(), c.name) ==
           characteristics.end();
  });
  return plan;
}
InspectionPlan cylinder_plan() {
  return plan_of_feature(1, {"cylinder.diameter", "cylinder.roundness"});
}

TEST(MonteCarlo, ErrorsThatAlwaysPointOneWayAreTakenOffTheValue) {
  const InspectionPlan plan = cylinder_plan();
  const auto measured = measure(plan, test_part::part());
  ASSERT_TRUE(measured) << to_string(measured.error().front());
  std::vector<Vec3> points;
  std::vector<std::size_t> sections;
  for (const MeasuredPoint& p : measured->features[0].points) {
    points.push_back(p.point);
    sections.push_back(p.section);
  }
  const auto feature = fit_feature(plan.features[0], points, sections, 0.0);
  ASSERT_TRUE(feature);
  // Every measurement sees the surface 3 um too far out.
  const ErrorDraws outwards = [](std::uint32_t draw) -> MeasuringErrors {
    return
        [draw](const Vec3& centre, const Vec3& approach, std::size_t, std::size_t point) -> Vec3 {
          return centre + (0.003 + 0.0005 * normal({.seed = 5, .draw = draw}, point)) * approach;
        };
  };
  const auto simulated =
      simulated_uncertainties(plan, std::span(&*feature, 1), outwards, {.draws = 2000});
  ASSERT_TRUE(simulated) << to_string(simulated.error().front());
  for (std::size_t i = 0; i < plan.characteristics.size(); ++i) {
    const SimulatedUncertainty& u = (*simulated)[i];
    if (plan.characteristics[i].name != "cylinder.diameter") continue;
    EXPECT_NEAR(0.5 * (u.low + u.high), 50.0 - 0.006, 2e-5);
    EXPECT_LT(u.high, 50.0 - 0.0055);
    EXPECT_GT(u.low, 50.0 - 0.0065);
  }
}

const CharacteristicResult& named_result(const Measurement& m, std::string_view name) {
  return m.characteristics.at(m.find(name).value());
}

TEST(MonteCarlo, ALobedProbeIsNotTakenForTheFormOfThePart) {
  InspectionPlan plan = cylinder_plan();
  plan.monte_carlo = MonteCarloSettings{.draws = 2000};
  CmmModel cmm{.e0_mm = 0.0002, .seed = 3};
  cmm.probe = ProbeErrors{.lobe = 0.002};
  const auto round = measure(plan, test_part::part(), cmm);
  ASSERT_TRUE(round) << to_string(round.error().front());
  const CharacteristicResult& form = named_result(*round, "cylinder.roundness");
  EXPECT_GT(form.value, 3.8);  // um: two lobes and little noise, on a part that is round
  ASSERT_TRUE(form.simulated);
  EXPECT_LT(form.simulated->low, 0.2);
  EXPECT_LT(form.simulated->high, 1.0);
}

// Lobes of the probe in the valleys of the part's: it looks round, and is known not to be.
TEST(MonteCarlo, AFormThatTheProbeHidesIsFoundAgain) {
  InspectionPlan plan = plan_of_feature(3, {"cone.form"});
  const auto part = test_part::part({.lobe = 0.0013});
  const auto truth = measure(plan, part);
  ASSERT_TRUE(truth) << to_string(truth.error().front());
  const double real = named_result(*truth, "cone.form").value;
  EXPECT_NEAR(real, 2.6, 0.01);
  plan.monte_carlo = MonteCarloSettings{.draws = 2000};
  CmmModel cmm{.e0_mm = 0.0002, .seed = 3};
  // On the cone the touch leans by 30 deg, which leaves 0.65 of the lobes.
  cmm.probe = ProbeErrors{.lobe = 0.002, .lobe_phase = 30.0 * kRadPerDeg};
  const auto seen = measure(plan, part, cmm);
  ASSERT_TRUE(seen) << to_string(seen.error().front());
  const CharacteristicResult& form = named_result(*seen, "cone.form");
  EXPECT_LT(form.value, 1.0);
  ASSERT_TRUE(form.simulated);
  EXPECT_LT(form.simulated->low, real);
  EXPECT_GT(form.simulated->high, real);
  EXPECT_GT(form.simulated->low, real - 0.5);
  EXPECT_LT(form.simulated->high, real + 0.5);
}

TEST(MonteCarlo, AWarmPartIsTakenForWhatItIsAt20Degrees) {
  InspectionPlan plan = cylinder_plan();
  plan.monte_carlo = MonteCarloSettings{.draws = 2000};
  CmmModel cmm{.e0_mm = 0.0002, .seed = 3};
  cmm.temperature = ThermalState{.part = 30.0};
  const auto warm = measure(plan, test_part::part(), cmm);
  ASSERT_TRUE(warm) << to_string(warm.error().front());
  const CharacteristicResult& diameter = named_result(*warm, "cylinder.diameter");
  EXPECT_NEAR(diameter.value, 50.0 + 53.0 * 115e-6, 1e-4);
  ASSERT_TRUE(diameter.simulated);
  EXPECT_LT(diameter.simulated->low, 50.0);
  EXPECT_GT(diameter.simulated->high, 50.0);
  EXPECT_LT(diameter.simulated->high - diameter.simulated->low, 5e-4);
}

}  // namespace
}  // namespace frustum::metrology
