#include "metrology/probing/cmm_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "metrology/cmm.hpp"
#include "metrology/probing/acceptance_test.hpp"
#include "metrology/probing/cmm_errors.hpp"
#include "metrology/probing/stylus_collision.hpp"
#include "step_part.hpp"
#include "synthetic.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

using test_part::part;
using test_part::plan;

CmmModel field_of(double e0, double length_per_error, std::uint64_t seed) {
  CmmModel cmm{.e0_mm = e0, .length_per_error = length_per_error, .seed = seed};
  cmm.kind = CmmKind::field;
  return cmm;
}

double measured_value(const Result<Measurement>& m, std::string_view name) {
  EXPECT_TRUE(m) << (m ? "" : to_string(m.error().front()));
  if (!m) return NAN;
  for (const CharacteristicResult& c : m->characteristics) {
    if (c.name == name) return c.value;
  }
  ADD_FAILURE() << name;
  return NAN;
}

TEST(AcceptanceLaws, EveryMachinePassesAndUsesItsStatement) {
  for (const auto& [e0, k] : {std::pair{0.0022, 300.0}, {0.0005, 600.0}}) {
    std::vector<double> shares;
    double form = 0.0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const AcceptanceReport report = acceptance_test(field_of(e0, k, seed));
      ASSERT_EQ(report.lengths.size(), 105U);
      EXPECT_TRUE(report.passes()) << seed << '\n' << to_text(report);
      shares.push_back(report.worst_length_share());
      form = std::max(form, report.probing_form / report.probing_limit);
    }
    std::ranges::sort(shares);
    // An error field of a tenth of the statement would pass as well, and mean nothing.
    EXPECT_GT(shares.back(), 0.6);
    EXPECT_GT(shares[100], 0.35);
    EXPECT_GT(form, 0.5);
  }
}

TEST(AcceptanceLaws, FailsAMachineThatIsWorseThanItSays) {
  CmmModel warm = field_of(0.001, 500.0, 3);
  warm.temperature = ThermalState{.part = 30.0};  // 115 um/m
  EXPECT_FALSE(acceptance_test(warm).lengths_pass());
  EXPECT_NE(to_text(acceptance_test(warm)).find("105 lengths (ISO 10360-2): failed"),
            std::string::npos);
  CmmModel lobed = field_of(0.001, 500.0, 3);
  lobed.probe = ProbeErrors{.lobe = 0.002};
  EXPECT_FALSE(acceptance_test(lobed).probing_passes());
  // An ideal machine has no errors at all.
  const AcceptanceReport ideal = acceptance_test({});
  EXPECT_TRUE(ideal.passes());
  EXPECT_LT(ideal.probing_form, 1e-11);
}

TEST(AcceptanceLaws, StatesNoShareOfALimitOfZero) {
  CmmModel warm;
  warm.temperature = ThermalState{.part = 30.0};
  const AcceptanceReport report = acceptance_test(warm);
  EXPECT_FALSE(report.lengths_pass());
  EXPECT_EQ(report.worst_length_share(), HUGE_VAL);
  const std::string text = to_text(report);
  EXPECT_NE(text.find("failed, with errors where the limit is 0"), std::string::npos) << text;
  EXPECT_EQ(text.find('%'), std::string::npos) << text;
  EXPECT_EQ(acceptance_test({}).worst_length_share(), 0.0);
  EXPECT_NE(to_text(acceptance_test({})).find("passed, without errors"), std::string::npos);
}

TEST(GeometryFieldLaws, KeepsItsLimitAnywhereAndVariesSlowly) {
  const Vec3 travel(700, 1000, 600);
  const LengthLimit limit{0.0015, 0.9e-3 / 300.0};
  double largest_step = 0.0;
  double worst = 0.0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const GeometryField field(seed, travel, limit);
    synthetic::Draws draws(seed);
    for (int i = 0; i < 200; ++i) {
      const Vec3 a = 0.5 * travel.cwiseProduct(draws.place(1.0));
      const Vec3 b = 0.5 * travel.cwiseProduct(draws.place(1.0));
      const double length = (b - a).norm();
      const double error = (field.at(b) - field.at(a)).dot(b - a) / length;
      worst = std::max(worst, std::abs(error) / limit.of(length));
      largest_step = std::max(largest_step, (field.at(a + Vec3(1, 1, 1)) - field.at(a)).norm());
    }
  }
  EXPECT_LE(worst, 1.0);
  EXPECT_GT(worst, 0.7);
  EXPECT_LT(largest_step, 0.0003);  // mm, over 1.7 mm: nearby points err alike
  EXPECT_GT(largest_step, 1e-5);
}

TEST(CmmErrors, AreAFunctionOfSeedDrawAndPoint) {
  const CmmModel model = field_of(0.002, 300.0, 8);
  const CmmErrors errors(model);
  const ProbedCentre p{.centre = Vec3(100, -50, 20), .outward = Vec3::UnitX(), .index = 5};
  EXPECT_EQ(errors.measured(p), CmmErrors(model).measured(p));
  CmmModel redrawn = model;
  redrawn.draw = 3;
  EXPECT_EQ(errors.repeated(3).measured(p), CmmErrors(redrawn).measured(p));
  EXPECT_EQ(errors.repeated(3).ball_radius(1.5), CmmErrors(redrawn).ball_radius(1.5));
  EXPECT_NE(errors.measured(p), errors.repeated(3).measured(p));
  // Another measurement keeps all but the drift: a tenth of 1/k over 112 mm of length.
  const Vec3 drift = errors.systematic(p) - errors.repeated(3).systematic(p);
  EXPECT_LE(drift.norm(), 2.0 * 0.1e-3 / 300.0 * p.centre.norm());
  CmmModel other = model;
  other.seed = 9;
  EXPECT_GT((CmmErrors(other).systematic(p) - errors.systematic(p)).norm(), 1e-5);
  ProbedCentre scanned = p;
  scanned.scanned = true;
  EXPECT_NE(errors.measured(scanned), errors.measured(p));
  EXPECT_EQ(errors.systematic(scanned), errors.systematic(p));
}

TEST(CmmErrors, KeepTheLinearModelToTheBit) {
  const CmmModel model{.e0_mm = 0.002, .length_per_error = 300.0, .seed = 5, .draw = 2};
  const Vec3 c(120.0, -30.0, 55.0);
  const Vec3 n = Vec3(1, 2, -2) / 3.0;
  const auto term = [](std::uint64_t i) {
    return 0.5e-3 / 300.0 * normal({5, 2, RandomPurpose::cmm_scale}, i);
  };
  Mat3 linear;
  linear << term(0), term(3), term(4), 0, term(1), term(5), 0, 0, term(2);
  Vec3 expected = c + linear * c;
  expected += 0.5 * 0.002 * normal({5, 2, RandomPurpose::cmm_point}, (4ULL << 32U) | 7U) * n;
  const CmmErrors errors(model);
  EXPECT_EQ(errors.measured({c, n, point_index(4, 7)}), expected);
  EXPECT_EQ(errors.ball_radius(1.5), 1.5);
}

TEST(ProbeForm, PreTravelOfOneSizeIsQualifiedAway) {
  CmmModel cmm;
  cmm.probe = ProbeErrors{.pre_travel = 0.008};
  const auto m = measure(plan(), part(), cmm);
  EXPECT_NEAR(measured_value(m, "cylinder.diameter"), 50.0, 1e-9);
  EXPECT_NEAR(measured_value(m, "cylinder.cylindricity"), 0.0, 1e-6);
  EXPECT_NEAR(measured_value(m, "cone.form"), 0.0, 1e-6);
}

TEST(ProbeForm, LobesShowOnARoundPart) {
  CmmModel cmm;
  cmm.probe = ProbeErrors{.lobe = 0.002};
  const auto m = measure(plan(), part(), cmm);
  // The touches are across the stylus: three lobes of the whole amplitude, and none in the size.
  EXPECT_NEAR(measured_value(m, "cylinder.roundness"), 4.0, 0.05);
  EXPECT_NEAR(measured_value(m, "cylinder.diameter"), 50.0, 1e-4);
  // On the cone the touch leans by the half angle, 30 deg.
  EXPECT_NEAR(measured_value(m, "cone.equivalent_form"),
              4.0 * std::pow(std::cos(kRadPerDeg * 30.0), 3), 0.05);
  cmm.probe->lobe_phase = kRadPerDeg * 60.0;
  const ProbeForm turned(*cmm.probe, {}, 0);
  const auto [u, v] = tangents(UnitVec3::z());
  EXPECT_NEAR(turned.outward_shift(u), 0.002, 1e-15);  // opposite to a lobe
  EXPECT_NEAR(turned.outward_shift(0.5 * u + std::sqrt(0.75) * v), -0.002, 1e-15);
  EXPECT_NEAR(turned.outward_shift(Vec3::UnitZ()), 0.0, 1e-15);
}

TEST(ProbeForm, AStylusBendsAcrossAndNotAlong) {
  const Stylus stylus{.length = 40.0, .diameter = 1.5};
  const ProbeForm form({.force = 0.1}, stylus, 0);
  // F l^3 / (3 E I), I = pi d^4 / 64
  const double bending = 0.1 * 64000.0 / (3.0 * 600e3 * std::numbers::pi * 5.0625 / 64.0);
  EXPECT_NEAR(form.outward_shift(Vec3::UnitY()), -bending, 1e-15);
  EXPECT_NEAR(form.outward_shift(-Vec3::UnitZ()), 0.0, 1e-15);
  EXPECT_NEAR(form.outward_shift(Vec3(0.6, 0.0, 0.8)), -0.36 * bending, 1e-15);
}

TEST(ProbeForm, TheBallDepartsByItsFormAndNoMore) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ProbeForm form({.ball_form = 0.0002}, {}, seed);
    synthetic::Draws draws(seed);
    double largest = 0.0;
    double mean = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double h = form.outward_shift(draws.direction());
      largest = std::max(largest, std::abs(h));
      mean += h / 2000.0;
    }
    EXPECT_LT(largest, 1.06 * 0.0002);
    EXPECT_GT(largest, 0.9 * 0.0002);
    EXPECT_NEAR(mean, 0.0, 1e-5);  // harmonics of degree 2 to 4 are no size
  }
}

TEST(ThermalState, LengthsGrowByPartLessScales) {
  CmmModel cmm;
  ThermalState state{.part = 23.0, .scales = 21.0};
  cmm.temperature = state;
  const double growth = 11.5e-6 * 3.0 - 8e-6 * 1.0;
  // The touched surface grows; the ball, which the machine takes for part of it, adds r * growth.
  EXPECT_NEAR(measured_value(measure(plan(), part(), cmm), "cylinder.diameter"),
              50.0 + 53.0 * growth, 1e-9);
  state.compensated = true;
  cmm.temperature = state;
  EXPECT_NEAR(measured_value(measure(plan(), part(), cmm), "cylinder.diameter"), 50.0, 1e-9);
  state.sensor_error = 0.2;
  cmm.temperature = state;
  const double sensed = measured_value(measure(plan(), part(), cmm), "cylinder.diameter") - 50.0;
  EXPECT_NE(sensed, 0.0);
  EXPECT_LE(std::abs(sensed), 53.0 * 0.2 * (11.5e-6 + 8e-6));
  cmm.draw = 1;  // the sensors are read again
  EXPECT_NE(measured_value(measure(plan(), part(), cmm), "cylinder.diameter") - 50.0, sensed);
}

TEST(Compensation, ByApproachLeavesTheCosineError) {
  InspectionPlan p = plan();
  const test_part::Flaws flaws{.half_angle_error = 0.02};
  const auto fitted = measure(p, part(flaws));
  p.probe.compensation = Compensation::approach;
  const auto approached = measure(p, part(flaws));
  const double cosine = 1.5 * (1.0 - std::cos(0.02));  // mm, toward the centre of the ball
  ASSERT_TRUE(fitted && approached);
  EXPECT_NEAR(fitted->features[3].compensation_difference, cosine, 1e-9);
  EXPECT_NEAR(approached->features[3].compensation_difference, cosine, 1e-9);
  EXPECT_NEAR(approached->features[1].compensation_difference, 0.0, 1e-12);
  const double along_normal =
      (measured_value(fitted, "cone.radius") - measured_value(approached, "cone.radius")) *
      std::cos(test_part::kHalfAngle + 0.02);
  // The section shifts by r sin(0.02) along the surface besides: second order times the cone's
  // slope.
  EXPECT_NEAR(std::abs(along_normal), cosine, 1e-6);
}

TEST(StylusCollision, NamesFeatureAndPoint) {
  CmmModel cmm;
  cmm.stylus = Stylus{.length = 60.0, .diameter = 2.0};
  const auto upright = measure(plan(), part(), cmm);
  ASSERT_TRUE(upright);
  EXPECT_TRUE(upright->diagnostics.empty()) << to_string(upright->diagnostics.front());
  cmm.stylus->direction = UnitVec3::x();
  const auto lying = measure(plan(), part(), cmm);
  ASSERT_TRUE(lying);
  ASSERT_FALSE(lying->diagnostics.empty());
  // The shank of 2 mm clears the face by 0.5 mm where it is along +X; from -X it meets cylinder C.
  const std::string first = to_string(lying->diagnostics.front());
  EXPECT_TRUE(first.starts_with("warning: feature 'A', point ")) << first;
  EXPECT_NE(first.find("the stylus shank meets the part when the ball touches"), std::string::npos)
      << first;
  // What is reported does not change what is measured.
  EXPECT_EQ(measured_value(lying, "cylinder.diameter"),
            measured_value(upright, "cylinder.diameter"));
  cmm.stylus = Stylus{.diameter = 3.0};
  const auto thick = measure(plan(), part(), cmm);
  ASSERT_FALSE(thick);
  EXPECT_EQ(thick.error().front().message,
            "a shank of 3 mm behind a ball of 3 mm touches before it");
}

TEST(StylusCollision, SeesTheBallOnItsWay) {
  // A plate with a slot under an overhang: free inside, closed above.
  const test_part::ImplicitBody overhang{
      [](const Vec3& x) {
        const double floor = x.z();
        const double roof = std::max({10.0 - x.z(), x.z() - 12.0, std::abs(x.x()) - 6.0});
        return std::min(floor, roof);
      },
      {}};
  const BallApproach approach{Vec3::Zero(), UnitVec3::z(), 1.5, 2.0, 2.0};
  const Stylus shorter{.length = 5.0, .diameter = 1.0};
  const Stylus longer{.length = 30.0, .diameter = 1.0};
  EXPECT_EQ(stylus_fault(overhang, shorter, approach, Vec3(0, 0, 1.5)), StylusFault::none);
  EXPECT_EQ(stylus_fault(overhang, longer, approach, Vec3(0, 0, 1.5)),
            StylusFault::shank_at_contact);
  // Beside the overhang: the thin shank passes, the ball does not.
  const BallApproach beside{Vec3(7.0, 0, 0), UnitVec3::z(), 1.5, 2.0, 2.0};
  EXPECT_EQ(stylus_fault(overhang, longer, beside, Vec3(7.0, 0, 1.5)),
            StylusFault::ball_on_the_way);
}

TEST(VirtualCmm, ErrorFreePartHasNoFormByAnyStrategy) {
  InspectionPlan p = plan();
  p.features[1].strategy = SpiralStrategy{2.0, 13.0, 2.5, 0, 0.3, 3.0, true};
  p.features[2].strategy = GridStrategy{{0, 30, 0}, {0, 0, 3}, 0, 2, 5.0};
  p.features[3].strategy =
      GeneratrixStrategy{6, -12.0, -2.0, 0, 0.2, 2.0 * std::numbers::pi, 2.0, true};
  std::erase_if(p.characteristics,
                [](const PlannedCharacteristic& c) { return !c.sections.empty(); });
  const auto m = measure(p, part());
  EXPECT_LT(measured_value(m, "cylinder.cylindricity"), 0.02);
  EXPECT_LT(measured_value(m, "cone.form"), 0.02);
  EXPECT_LT(measured_value(m, "A.flatness"), 0.02);
  EXPECT_NEAR(measured_value(m, "cylinder.diameter"), 50.0, 1e-9);
}

TEST(VirtualCmm, ErrorFreeStepsAndSpheresHaveNoForm) {
  const auto steps = measure(step_part::plan(), step_part::part());
  ASSERT_TRUE(steps);
  for (const MeasuredFeature& f : steps->features) EXPECT_LT(f.form, 1e-9) << f.name;
  const test_part::ImplicitBody socket{
      [](const Vec3& x) { return std::max(8.0 - (x - Vec3(1, 2, 3)).norm(), x.norm() - 20.0); },
      {}};
  InspectionPlan p;
  PlannedFeature sphere;
  sphere.name = "socket";
  sphere.kind = FeatureKind::sphere;
  sphere.side = Side::inside;
  sphere.point = Vec3(1.0, 2.0, 3.1);  // off its place: fitted all the same
  sphere.radius = 8.0;
  sphere.strategy = SphereStrategy{};
  p.features = {sphere};
  const auto m = measure(p, socket);
  ASSERT_TRUE(m) << to_string(m.error().front());
  EXPECT_LT(m->features[0].form, 1e-9);
  EXPECT_NEAR(m->features[0].parameters.at("radius")[0], 8.0, 1e-9);
  EXPECT_NEAR(m->features[0].parameters.at("point")[2], 3.0, 1e-9);
  EXPECT_GT(m->features[0].compensation_difference, 1e-4);  // mm: 0.1 mm across a radius of 8 mm
}

TEST(VirtualCmm, RefusesPointsBeyondItsTravel) {
  CmmModel cmm = field_of(0.001, 400.0, 1);
  cmm.travel = Vec3(60.0, 60.0, 60.0);
  const auto m = measure(plan(), part(), cmm);
  ASSERT_FALSE(m);
  EXPECT_EQ(to_string(m.error().front()),
            "error: feature 'A', point 1 at [32.000, 0.000, 0.000] is beyond the machine's travel "
            "(hint: enlarge the cmm's travel, or move its position)");
}

std::string cmm_complaint(const std::string& text) {
  const auto document = TomlDocument::parse(text, "job.toml");
  if (!document) return "no TOML";
  static_cast<void>(read_cmm_model(document->root()));
  const Diagnostics found = document->finish();
  return found.empty() ? "" : to_string(found.front());
}

TEST(CmmModel, ReadsEveryKey) {
  const auto document = TomlDocument::parse(
      "model = \"field\"\ne0 = \"2 um\"\nl_per_um = 300\nseed = 4\np_form = \"1.8 um\"\n"
      "travel = [500, 600, 400]\nposition = [10, 20, -30]\n"
      "[probe]\npre_travel = \"4 um\"\nlobe = \"0.3 um\"\nlobe_phase = 30\nball_form = \"0.1 um\"\n"
      "force = 0.01\nrepeatability = \"0.05 um\"\nscan_noise = \"0.2 um\"\n"
      "[stylus]\nlength = 20\ndiameter = 1.5\ndirection = [0, 0, 2]\nmodulus = 580\n"
      "[temperature]\npart = 22\nscales = 20.5\npart_expansion = 23.8\nscale_expansion = 0.1\n"
      "compensated = true\nsensor_error = 0.1\nexpansion_error = 1\n",
      "job.toml");
  ASSERT_TRUE(document);
  const CmmModel cmm = read_cmm_model(document->root());
  const Diagnostics found = document->finish();
  EXPECT_TRUE(found.empty()) << to_string(found.front());
  EXPECT_EQ(cmm.kind, CmmKind::field);
  EXPECT_DOUBLE_EQ(probing_limit(cmm), 0.0018);
  EXPECT_EQ(cmm.travel, Vec3(500, 600, 400));
  EXPECT_EQ(cmm.position, Vec3(10, 20, -30));
  EXPECT_DOUBLE_EQ(cmm.probe->pre_travel, 0.004);
  EXPECT_DOUBLE_EQ(cmm.probe->lobe, 0.0003);
  EXPECT_DOUBLE_EQ(cmm.probe->lobe_phase, 30.0 * kRadPerDeg);
  EXPECT_DOUBLE_EQ(cmm.probe->scan_noise, 0.0002);
  EXPECT_DOUBLE_EQ(cmm.stylus->modulus, 580e3);
  EXPECT_EQ(cmm.stylus->direction.vec(), Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(cmm.temperature->part_expansion, 23.8e-6);
  EXPECT_DOUBLE_EQ(cmm.temperature->expansion_error, 1e-6);
  EXPECT_DOUBLE_EQ(length_limit(cmm, 600.0), 0.004);
}

TEST(CmmModel, Fault2_31_ErrorsOfTheMachineHaveAUnit) {
  EXPECT_EQ(cmm_complaint("e0 = 0.5\n"),
            "job.toml:1:1: error: e0: 0.5 has no unit (hint: write for example \"0.5 um\")");
  EXPECT_NE(
      cmm_complaint("model = \"field\"\ne0 = \"4 um\"\np_form = 2\n").find("p_form: 2 has no"),
      std::string::npos);
  EXPECT_NE(
      cmm_complaint("model = \"field\"\ne0 = \"4 um\"\n[probe]\nlobe = 1\n").find("lobe: 1 has no"),
      std::string::npos);
  EXPECT_EQ(cmm_complaint("e0 = 0\n"), "");
}

TEST(CmmModel, NamesWhatIsImpossible) {
  EXPECT_EQ(cmm_complaint("e0 = \"1 um\"\np_form = \"1 um\"\n"),
            "job.toml:2:1: error: p_form: belongs to a machine with a field (hint: write model = "
            "\"field\")");
  EXPECT_EQ(
      cmm_complaint("[probe]\nforce = 0.1\n"),
      "job.toml:2:1: error: probe.force: bends a stylus, and none is stated (hint: write stylus "
      "= { length = 50, diameter = 2 })");
  EXPECT_EQ(cmm_complaint("[temperature]\npart = 295\n"),
            "job.toml:2:1: error: temperature.part: must be between -40 and 60 degC, is 295 (hint: "
            "temperatures are in degC)");
  EXPECT_EQ(
      cmm_complaint("[temperature]\npart_expansion = 11.5e-6\n"),
      "job.toml:2:1: error: temperature.part_expansion: is 1.15e-05 um/(m K) (hint: write 11.5 "
      "for 11.5e-6 1/K)");
  EXPECT_EQ(cmm_complaint("model = \"field\"\ntravel = [500, 0, 400]\n"),
            "job.toml:2:1: error: travel: must be three lengths greater than 0");
  EXPECT_EQ(
      cmm_complaint(
          "model = \"field\"\ne0 = \"4 um\"\np_form = \"1 um\"\n[probe]\nlobe = \"1 um\"\n"
          "ball_form = 0\nrepeatability = 0\n"),
      "job.toml:4:2: error: probe: the probe alone makes a form of 1.76 um of the 25-point "
      "sphere, p_form is 1 um (hint: state smaller probe errors, a shorter stylus, or a larger "
      "p_form)");
  // Without p_form, e0 is its limit; a machine of no error has no probe of its own.
  EXPECT_NE(cmm_complaint("model = \"field\"\ne0 = \"1 um\"\n[probe]\nlobe = \"0.9 um\"\n")
                .find("25-point sphere, e0 is 1 um"),
            std::string::npos);
  EXPECT_EQ(cmm_complaint("model = \"field\"\n"), "");
  EXPECT_NE(cmm_complaint("model = \"field\"\nl_per_um = 300\n[probe]\nrepeatability = \"1 um\"\n")
                .find("e0 is 0 um"),
            std::string::npos);
  EXPECT_EQ(
      cmm_complaint("model = \"field\"\ne0 = \"1 um\"\n[probe]\nrepeatability = \"0.5 um\"\n"),
      "job.toml:3:2: error: probe: the probe alone may cost a length 3.28 um, e0 is 1 um (hint: "
      "state smaller probe errors, a shorter stylus, or a larger e0)");
}

}  // namespace
}  // namespace frustum::metrology
