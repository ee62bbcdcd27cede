#include "metrology/fit/element_model.hpp"

#include <gtest/gtest.h>

#include "metrology/fit/constraint_steps.hpp"
#include "tests/metrology/synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;

Element some(ElementKind kind, Draws& draws) {
  const Vec3 p = draws.place(20.0);
  const UnitVec3 a = draws.direction();
  const double r = draws.between(5.0, 20.0);
  switch (kind) {
    case ElementKind::line:
      return Line{p, a};
    case ElementKind::plane:
      return Plane{p, a};
    case ElementKind::circle:
      return Circle{p, a, r};
    case ElementKind::sphere:
      return Sphere{p, r};
    case ElementKind::cylinder:
      return Cylinder{p, a, r};
    case ElementKind::cone:
      return Cone{p, a, r, draws.between(0.1, 1.4)};
    case ElementKind::torus:
      break;
  }
  return Torus{p, a, r, draws.between(0.2, 0.8) * r};
}

TEST(ElementModelLaws, GradientsAreCentralDifferencesOfTheResidual) {
  Draws draws(21);
  for (std::size_t k = 0; k < kElementNames.size(); ++k) {
    const auto kind = static_cast<ElementKind>(k);
    const auto n = static_cast<Eigen::Index>(parameters_of(kind).size());
    for (int set = 0; set < 50; ++set) {
      const Element e = some(kind, draws);
      const Vec3 x = draws.place(40.0);
      const LinearisedPoint at = linearised(e, x);
      EXPECT_NEAR(at.residual, residual(e, x), 1e-13) << name_of(kind);
      ASSERT_EQ(at.gradient.size(), n);
      for (Eigen::Index i = 0; i < n; ++i) {
        constexpr double kStep = 1e-5;
        const ElementStep step = kStep * ElementStep::Unit(n, i);
        const double slope =
            (residual(moved(e, step), x) - residual(moved(e, -step), x)) / (2.0 * kStep);
        EXPECT_NEAR(at.gradient[i], slope, 1e-7) << name_of(kind) << ' ' << i;
      }
    }
  }
}

TEST(ElementModelLaws, SlidingChangesThePointAlone) {
  Draws draws(22);
  for (std::size_t k = 0; k < kElementNames.size(); ++k) {
    const Element e = some(static_cast<ElementKind>(k), draws);
    const Vec3 to = draws.place(30.0);
    const Element there = shifted(e, to);
    const Vec3 x = draws.place(40.0);
    EXPECT_NEAR(residual(e, x), residual(there, x), 1e-12) << kElementNames[k];
    EXPECT_LE((point_of(there) - to).norm(), (point_of(e) - to).norm());
  }
}

// Whatever the coefficients: a constrained element that moves by the basis keeps its constraints.
TEST(ConstraintStepsLaws, EveryAllowedStepKeepsTheConstraints) {
  Draws draws(23);
  for (const ElementKind kind : {ElementKind::plane, ElementKind::cylinder, ElementKind::cone,
                                 ElementKind::torus, ElementKind::circle}) {
    for (int set = 0; set < 20; ++set) {
      Constraints keep;
      const UnitVec3 d = draws.direction();
      if (set % 4 == 0) keep.parallel_to = d;
      if (set % 4 == 1) keep.perpendicular_to = d;
      if (set % 4 == 2 && kind != ElementKind::plane) keep.axis = Line{draws.place(5.0), d};
      if (set % 4 == 3 && kind == ElementKind::cone) keep.half_angle = 0.4;
      ASSERT_FALSE(refused(keep, kind, name_of(kind)));
      Element e = constrained(some(kind, draws), keep);
      for (int i = 0; i < 4; ++i) {
        const StepBasis basis = allowed_steps(e, keep);
        EXPECT_LT(
            (basis.transpose() * basis - StepBasis::Identity(basis.cols(), basis.cols())).norm(),
            1e-14);
        ElementStep step(basis.cols());
        for (double& s : step) s = draws.between(-0.1, 0.1);
        e = moved(e, basis * step);
        const Element kept = constrained(e, keep);
        EXPECT_LT((point_of(kept) - point_of(e)).norm(), 1e-13) << name_of(kind) << set;
        EXPECT_LT(synthetic::line_angle(*axis_of(kept), *axis_of(e)), 1e-14)
            << name_of(kind) << set;
        if (keep.half_angle) {
          EXPECT_EQ(std::get<Cone>(e).half_angle, 0.4);
        }
      }
    }
  }
}

TEST(ConstraintSteps, AreRefusedWhereTheKindLacksThem) {
  const auto message = [](const Constraints& c, ElementKind kind) {
    const auto problem = refused(c, kind, name_of(kind));
    return problem ? problem->message : std::string("none");
  };
  Constraints keep;
  EXPECT_EQ(message(keep, ElementKind::sphere), "none");
  keep.parallel_to = UnitVec3::z();
  EXPECT_EQ(message(keep, ElementKind::sphere), "a sphere has no direction to keep");
  keep.perpendicular_to = UnitVec3::z();
  EXPECT_EQ(message(keep, ElementKind::cone),
            "parallel_to and perpendicular_to contradict each other");
  keep = {};
  keep.axis = Line{};
  EXPECT_EQ(message(keep, ElementKind::plane), "a plane cannot keep an axis");
  keep = {};
  keep.radius = 3.0;
  EXPECT_EQ(message(keep, ElementKind::cone), "a cone has no radius to keep");
  EXPECT_EQ(message(keep, ElementKind::sphere), "none");
  keep.radius = -3.0;
  EXPECT_EQ(message(keep, ElementKind::cylinder), "the radius to keep is -3 mm");
  keep = {};
  keep.half_angle = 1.6;
  EXPECT_EQ(message(keep, ElementKind::cylinder), "a cylinder has no half_angle to keep");
  EXPECT_EQ(message(keep, ElementKind::cone), "the half_angle to keep is 1.6 rad");
}

}  // namespace
}  // namespace frustum::metrology
