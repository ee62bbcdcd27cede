#include "metrology/cmm.hpp"

#include <gtest/gtest.h>

#include "metrology/probing/ball_contact.hpp"
#include "synthetic.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

using test_part::Flaws;
using test_part::part;
using test_part::plan;

// Bisection leaves 1e-14 mm; a ball centre on a smooth surface is promised to 1e-9 mm.
constexpr double kExact = 1e-9;  // mm
constexpr double kExactUm = 1e3 * kExact;

const CharacteristicResult& named(const Measurement& m, std::string_view name) {
  for (const CharacteristicResult& c : m.characteristics) {
    if (c.name == name) return c;
  }
  throw std::out_of_range(std::string(name));
}

Measurement measured(const Flaws& flaws, const Pose& pose = {}, const CmmModel& cmm = {}) {
  auto result = measure(plan(), part(flaws, pose), cmm);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error().front()));
  return result ? *result : Measurement{};
}

void expect_perfect(const Measurement& m) {
  ASSERT_EQ(m.characteristics.size(), plan().characteristics.size());
  EXPECT_TRUE(m.passes());
  for (const CharacteristicResult& c : m.characteristics) {
    EXPECT_EQ(c.expanded_uncertainty, 0.0) << c.name;
    const double limit = c.unit == "um" ? kExactUm : kExact;
    EXPECT_NEAR(c.value, c.nominal.value_or(0.0), limit) << c.name;
  }
  for (const MeasuredFeature& f : m.features) EXPECT_LT(f.form, kExact) << f.name;
}

TEST(VirtualCmm, FindsNothingWrongWithAPerfectPart) {
  const Measurement m = measured({});
  expect_perfect(m);
  EXPECT_LT(m.workpiece_from_datum.translation.norm(), kExact);
  EXPECT_LT((m.workpiece_from_datum.rotation - Mat3::Identity()).norm(), 1e-10);
}

TEST(VirtualCmm, GivesTheSameFormsWhereverThePartLies) {
  synthetic::Draws draws(21);
  const Flaws flaws{.lobe = 0.004, .cone_shift = 0.01};
  const Measurement straight = measured(flaws);
  for (int i = 0; i < 4; ++i) {
    const UnitVec3 axis = draws.direction();
    const Pose lie{rotation_about(axis, draws.between(-0.01, 0.01)), draws.place(0.3)};
    const Measurement perfect = measured({}, lie);
    expect_perfect(perfect);
    // The alignment is where the part lies.
    EXPECT_LT((perfect.workpiece_from_datum.translation - lie.translation).norm(), 10 * kExact);
    EXPECT_LT((perfect.workpiece_from_datum.rotation - lie.rotation).norm(), 1e-9);
    const Measurement lobed = measured(flaws, lie);
    for (const CharacteristicResult& c : straight.characteristics) {
      // The datum features are touched at other places, nothing else changes.
      EXPECT_NEAR(named(lobed, c.name).value, c.value, 10 * kExactUm) << c.name;
    }
  }
}

TEST(VirtualCmm, MeasuresWithoutDatumSystemInTheFrameOfThePlan) {
  InspectionPlan p = plan();
  p.alignment = Alignment::plan;
  const Pose lie{rotation_z(0.005), Vec3(0.2, -0.1, 0.05)};
  const auto m = measure(p, part({}, lie));
  ASSERT_TRUE(m) << to_string(m.error().front());
  EXPECT_EQ(m->workpiece_from_datum.translation, Vec3(0, 0, 0));
  EXPECT_NEAR(m->features[1].parameters.at("point")[0], 0.2, kExact);
  p = plan();
  p.datum->tertiary.clear();
  const auto clocked = measure(p, part({}, lie));
  ASSERT_TRUE(clocked);
  // Without a groove the plan's own clocking stays, the origin follows the part.
  EXPECT_LT((clocked->workpiece_from_datum.rotation - Mat3::Identity()).norm(), 1e-10);
  EXPECT_LT((clocked->workpiece_from_datum.translation - lie.translation).norm(), kExact);
}

TEST(VirtualCmm, SeesLobesAsTheFirstOrderFormulaSays) {
  const double lobe = 0.005;
  const Measurement m = measured({.lobe = lobe});
  // First order: peak to valley of the normal deviation without mean, cosine and sine, here 2 x
  // lobe. The ball bridges the lobes by r (3 lobe / 17 mm)^2 / 2 = 6e-7 mm; the circle in the plane
  // of the section shares 1e-3 of the rest.
  EXPECT_NEAR(named(m, "cone.equivalent_form").value, 2e3 * lobe, 5e-3);
  EXPECT_NEAR(named(m, "cone.form").value, 2e3 * lobe, 5e-3);
  // At one height the radius changes by the lobe over the cosine of the half angle.
  EXPECT_NEAR(named(m, "cone.roundness").value, 2e3 * lobe / std::cos(test_part::kHalfAngle), 5e-3);
  const CharacteristicResult& c = named(m, "cone.equivalent_form");
  ASSERT_EQ(c.plot_angle.size(), 72U);
  EXPECT_FALSE(c.pass);
  EXPECT_EQ(c.unit, "um");
  for (std::size_t i = 0; i < c.plot_angle.size(); ++i) {
    // The axis of the cone points down, so its angles run against the lobes; the cosine is even.
    EXPECT_NEAR(c.plot_deviation[i], lobe * std::cos(3.0 * c.plot_angle[i]), 5e-6);
  }
}

TEST(VirtualCmm, MeasuresAngleShiftAndTilt) {
  const Measurement m = measured({.cone_shift = 0.004, .half_angle_error = 400e-6});
  EXPECT_NEAR(named(m, "cone.half_angle").value, 30.0 + 400e-6 * kDegPerRad, 1e-9);
  EXPECT_TRUE(named(m, "cone.half_angle").pass);
  EXPECT_NEAR(named(m, "cone.to_cylinder").value, 8.0, 1e-3);
  EXPECT_NEAR(named(m, "cone.concentricity").value, 0.0, kExactUm);
  EXPECT_FALSE(named(measured({.half_angle_error = 700e-6}), "cone.half_angle").pass);

  const Measurement tilted = measured({.cone_tilt = 300e-6});
  // Sections 8 mm apart; a section of constant height through a tilted cone is an ellipse whose
  // centre is farther off the axis by tilt tan(a) times its radius: d/dz [z - tan(a) (22 - z
  // tan(a))] is 1 + tan^2(a).
  EXPECT_NEAR(named(tilted, "cone.concentricity").value,
              2e3 * 8.0 * 300e-6 * (1.0 + std::pow(std::tan(test_part::kHalfAngle), 2)), 0.01);

  InspectionPlan p = plan();
  p.alignment = Alignment::plan;  // the datum system would follow the cylinder
  const auto leaning = measure(p, part({.cylinder_tilt = 500e-6}));
  ASSERT_TRUE(leaning);
  EXPECT_NEAR(named(*leaning, "cylinder.squareness").value, 1e3 * 15.0 * std::sin(500e-6), 1e-6);
}

TEST(VirtualCmm, RepeatsItselfForASeedAndOnlyForIt) {
  const CmmModel cmm{.e0_mm = 0.002, .length_per_error = 300.0, .seed = 5};
  const Measurement first = measured({}, {}, cmm);
  const Measurement again = measured({}, {}, cmm);
  const Measurement other =
      measured({}, {}, {.e0_mm = 0.002, .length_per_error = 300.0, .seed = 6});
  const Measurement redrawn =
      measured({}, {}, {.e0_mm = 0.002, .length_per_error = 300.0, .seed = 5, .draw = 1});
  for (std::size_t i = 0; i < first.characteristics.size(); ++i) {
    EXPECT_EQ(first.characteristics[i].value, again.characteristics[i].value);
    EXPECT_NE(first.characteristics[i].value, other.characteristics[i].value);
    EXPECT_NE(first.characteristics[i].value, redrawn.characteristics[i].value);
  }
}

TEST(VirtualCmm, ScattersByItsStatementAndOwnsUpToIt) {
  const CmmModel model{.e0_mm = 0.002, .length_per_error = 300.0};
  std::map<std::string, double> squares;
  std::map<std::string, double> uncertainty;
  constexpr int kDraws = 60;
  double noise = 0.0;
  for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
    CmmModel cmm = model;
    cmm.seed = seed;
    const Measurement m = measured({}, {}, cmm);
    for (const char* name : {"cone.half_angle", "cylinder.diameter", "cone.radius"}) {
      const CharacteristicResult& c = named(m, name);
      squares[name] += (c.value - *c.nominal) * (c.value - *c.nominal) / kDraws;
      uncertainty[name] = c.expanded_uncertainty;
    }
    noise += m.features[1].rms / kDraws;
    const double form = named(m, "cylinder.cylindricity").value;
    // 108 points of standard deviation 1 um spread over 4 to 8 um.
    EXPECT_GT(form, 3.0);
    EXPECT_LT(form, 9.0);
  }
  EXPECT_NEAR(noise, 0.001, 1e-4);  // half of e0
  for (const auto& [name, square] : squares) {
    // k = 2; the standard deviation of 60 draws has a standard error of 9 %, here three times that.
    EXPECT_NEAR(2.0 * std::sqrt(square) / uncertainty[name], 1.0, 0.3) << name;
  }
}

TEST(VirtualCmm, ExplainsAPlanThatMissesThePart) {
  InspectionPlan p = plan();
  p.features[3].radius = 40.0;
  const auto high = measure(p, part());
  ASSERT_FALSE(high);
  EXPECT_EQ(
      to_string(high.error().front()),
      "error: feature 'cone', point 1 at [33.649, 0.000, 26.000]: the plan misses the part: no "
      "surface within 2 mm past the nominal one, it is 15.588 mm past it (hint: check the nominal "
      "geometry, the setup and the blank or mesh, or enlarge probe.reach)");
  p.features[3].radius = 12.0;
  const auto deep = measure(p, part());
  ASSERT_FALSE(deep);
  EXPECT_EQ(
      to_string(deep.error().front()),
      "error: feature 'cone', point 1 at [5.649, 0.000, 26.000]: the approach starts inside the "
      "material, 2 mm off the nominal surface (hint: check the nominal geometry, the setup, the "
      "tool and the cut, or "
      "enlarge probe.clearance)");
  p.features[3].half_angle = 2.0;
  EXPECT_EQ(measure(p, part()).error().front().key, "feature[4].half_angle");
}

TEST(BallContact, Fault2_28_AnOversizeBoreIsOutOfReachNotMaterial) {
  // A bore of 13 mm in a block, planned with 10 mm: from far away the block is met from outside.
  const test_part::ImplicitBody block{[](const Vec3& x) {
                                        const double away = std::hypot(x.x(), x.y());
                                        return std::max(13.0 - away, away - 50.0);
                                      },
                                      {}};
  const BallApproach approach{Vec3(10.0, 0.0, 0.0), UnitVec3::of(Vec3(-1, 0, 0)).value(), 1.5, 2.0,
                              2.0};
  const BallContact missed = touch_with_ball(block, approach);
  EXPECT_EQ(missed.state, ContactState::no_surface);
  ASSERT_TRUE(missed.surface_past);
  EXPECT_NEAR(*missed.surface_past, 3.0, 1e-9);
  // One of 5 mm, in whose wall the approach starts.
  const test_part::ImplicitBody narrow{[](const Vec3& x) {
                                         const double away = std::hypot(x.x(), x.y());
                                         return std::max(5.0 - away, away - 50.0);
                                       },
                                       {}};
  EXPECT_EQ(touch_with_ball(narrow, approach).state, ContactState::starts_inside);
}

TEST(BallContact, IsExactOnHolesAndTiltedSurfaces) {
  // A hole of radius 2 that a ball of radius 1.5 just enters, approached off its radius.
  const test_part::ImplicitBody hole{
      [](const Vec3& x) { return std::min(2.0 - std::hypot(x.x(), x.y()), 8.0 - x.norm()) * 1.0; },
      {}};
  const BallApproach approach{Vec3(2.0, 0.1, 0.0), UnitVec3::of(Vec3(-1, 0.05, 0)).value(), 1.5,
                              0.3, 0.5};
  const BallContact contact = touch_with_ball(hole, approach);
  ASSERT_EQ(contact.state, ContactState::contact);
  EXPECT_NEAR(std::hypot(contact.centre.x(), contact.centre.y()), 0.5, kExact);
}

TEST(BallContact, RestsOnAnEdge) {
  // A roof with its ridge along y: the ball touches the ridge itself.
  const test_part::ImplicitBody roof{
      [](const Vec3& x) { return (x.z() + 0.5 * std::abs(x.x())) / std::sqrt(1.25); }, {}};
  const BallContact contact =
      touch_with_ball(roof, {Vec3(0.01, 0, 0), UnitVec3::z(), 1.5, 2.0, 2.0});
  ASSERT_EQ(contact.state, ContactState::contact);
  EXPECT_NEAR(contact.centre.z(), std::sqrt(1.5 * 1.5 - 0.01 * 0.01), 1e-7);
}

TEST(BallContact, SaysWhatItRestsOn) {
  const test_part::ImplicitBody ball{[](const Vec3& x) { return x.norm() - 10.0; }, {}};
  const BallContact contact =
      touch_with_ball(ball, {Vec3(10, 0.5, 0), UnitVec3::x(), 1.5, 2.0, 2.0});
  ASSERT_EQ(contact.state, ContactState::contact);
  EXPECT_NEAR((contact.centre - contact.touch.point).norm(), 1.5, 1e-9);
  EXPECT_NEAR((contact.centre - 1.5 * contact.touch.normal - contact.touch.point).norm(), 0.0,
              1e-5);
  EXPECT_FALSE(contact.touch.provenance);
  // What a measurement keeps: one touch for each point, with what the probe knows of it.
  const Measurement measurement = measured({});
  for (const MeasuredFeature& f : measurement.features) {
    ASSERT_EQ(f.touches.size(), f.points.size()) << f.name;
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      const Vec3 point = measurement.workpiece_from_datum.point(f.points[i].point);
      EXPECT_LT((f.touches[i].point - point).norm(), 0.01) << f.name << " " << i;
    }
  }
}

TEST(RealPoints, EvaluateLikeTheVirtualOnes) {
  const Measurement virtual_one = measured({.lobe = 0.003});
  std::vector<FeaturePoints> points;
  for (const MeasuredFeature& f : virtual_one.features) {
    FeaturePoints p{f.name, {}, {}};
    for (const MeasuredPoint& m : f.points) p.points.push_back(m.point);
    points.push_back(std::move(p));  // sections are left to be found
  }
  const auto real = evaluate(plan(), points);
  ASSERT_TRUE(real) << to_string(real.error().front());
  for (const CharacteristicResult& c : virtual_one.characteristics) {
    EXPECT_NEAR(named(*real, c.name).value, c.value, 1e-4) << c.name;
  }
  points.pop_back();
  EXPECT_EQ(evaluate(plan(), points).error().front().message,
            "characteristic 'cone.equivalent_form': feature 'cone' has no points");
  points.front().feature = "a";
  points.front().file = "p.csv";
  points.front().line = 12;
  EXPECT_EQ(to_string(evaluate(plan(), points).error().front()),
            "p.csv:12: error: the plan has no feature 'a' (hint: did you mean A? the plan has A, "
            "C, groove, cone)");
  points.front().feature = "A";
  points.front().points.resize(2);
  const auto few = evaluate(plan(), points);
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().front().file, "p.csv");
}

TEST(RealPoints, SayWhereAnUncertaintyOfZeroDecides) {
  InspectionPlan p = plan();
  const auto remarks = [&](const CmmModel& cmm) {
    const auto m = measure(p, part(), cmm);
    std::string text;
    for (const Diagnostic& d : m->diagnostics) text += to_string(d) + "\n";
    return text;
  };
  EXPECT_EQ(remarks({}), "");
  p.decision = DecisionRule::iso14253;
  EXPECT_NE(remarks({}).find("warning: decision = \"iso14253\" goes by an uncertainty of 0 for all "
                             "characteristics (hint: state its accuracy"),
            std::string::npos)
      << remarks({});
  EXPECT_EQ(remarks({.e0_mm = 0.001}), "");
  p.decision = DecisionRule::simple;
  p.monte_carlo = MonteCarloSettings{.draws = 2000};
  EXPECT_NE(remarks({}).find("warning: uncertainty: nothing was simulated"), std::string::npos)
      << remarks({});
}

TEST(CmmModel, ReadsTheKeysOfAJob) {
  const auto document =
      TomlDocument::parse("e0 = \"0.5 um\"\nl_per_um = 600\nseed = 1\n", "job.toml");
  ASSERT_TRUE(document);
  const CmmModel cmm = read_cmm_model(document->root());
  EXPECT_TRUE(document->finish().empty());
  EXPECT_DOUBLE_EQ(cmm.e0_mm, 0.0005);
  EXPECT_EQ(cmm.length_per_error, 600.0);
  EXPECT_EQ(cmm.seed, 1U);
}

}  // namespace
}  // namespace frustum::metrology
