#include "metrology/characteristic/datum_system.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measured_feature.hpp"
#include "metrology/cmm.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/plan/nominal.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using measured::feature;
using measured::turned;

PlannedFeature sphere(std::string name, const Vec3& point) {
  PlannedFeature f;
  f.name = std::move(name);
  f.kind = FeatureKind::sphere;
  f.point = point;
  f.radius = 6.0;
  return f;
}

// A block of 100 x 80 x 40 mm with bores, a pin, a taper and three balls.
std::vector<PlannedFeature> block() {
  PlannedFeature taper = measured::cylinder("taper", {20, 20, 40}, -Vec3::UnitZ(), 8.0, {2, 6, 10});
  taper.kind = FeatureKind::cone;
  taper.half_angle = 20.0 * kRadPerDeg;
  return {measured::plane("top", {50, 40, 40}, Vec3::UnitZ(), {80, 0, 0}, {0, 60, 0}),
          measured::plane("front", {50, 0, 20}, -Vec3::UnitY(), {80, 0, 0}, {0, 0, 20}),
          measured::plane("side", {0, 40, 20}, -Vec3::UnitX(), {0, 60, 0}, {0, 0, 20}),
          measured::cylinder("bore", {30, 30, 30}, Vec3::UnitZ(), 10.0),
          measured::cylinder("bore 2", {80, 50, 25}, Vec3::UnitZ(), 5.0),
          measured::cylinder("pin", {50, 0, 20}, Vec3::UnitY(), 7.0),
          measured::line("edge", {50, 0, 20}, Vec3::UnitX(), -Vec3::UnitY()),
          measured::point("stop", {0, 40, 20}, -Vec3::UnitX()),
          taper,
          sphere("ball 1", {0, 0, 0}),
          sphere("ball 2", {100, 0, 0}),
          sphere("ball 3", {10, 80, 5})};
}

struct System {
  DatumSystem datum{};
  std::vector<std::vector<std::string>> degrees{};
  std::vector<std::string> free{};
};
DatumSystem best_fit_of(std::vector<std::string> features, std::vector<std::string> locked = {}) {
  DatumSystem datum;
  datum.best_fit = std::move(features);
  datum.locked = std::move(locked);
  return datum;
}
std::vector<System> systems() {
  return {
      {{"top", "bore", "side"}, {{"TZ", "RX", "RY"}, {"TX", "TY"}, {"RZ"}}},
      {{"top", "front", "side"}, {{"TZ", "RX", "RY"}, {"TY", "RZ"}, {"TX"}}},
      {{"top", "edge", "stop"}, {{"TZ", "RX", "RY"}, {"TY", "RZ"}, {"TX"}}},
      {{"top", "bore", "bore 2"}, {{"TZ", "RX", "RY"}, {"TX", "TY"}, {"RZ"}}},
      {{"bore", "top", "side"}, {{"TX", "TY", "RX", "RY"}, {"TZ"}, {"RZ"}}},
      {{"bore", "bore 2", "top"}, {{"TX", "TY", "RX", "RY"}, {"RZ"}, {"TZ"}}},
      {{"pin", "top", "stop"}, {{"TX", "TZ", "RX", "RZ"}, {"RY"}, {}}},
      {{"top", "pin", "front"}, {{"TZ", "RX", "RY"}, {"TX", "RZ"}, {"TY"}}},
      {{"taper", "bore", ""}, {{"TX", "TY", "TZ", "RX", "RY"}, {"RZ"}}},
      {{"ball 1", "ball 2", "ball 3"}, {{"TX", "TY", "TZ"}, {"RY", "RZ"}, {"RX"}}},
      {best_fit_of({"top", "front", "side"}),
       {{"TX", "TY", "TZ", "RX", "RY", "RZ"},
        {"TX", "TY", "TZ", "RX", "RY", "RZ"},
        {"TX", "TY", "TZ", "RX", "RY", "RZ"}}},
  };
}

std::vector<FittedFeature> measured_block(const std::vector<PlannedFeature>& planned,
                                          const Pose& lies) {
  std::vector<FittedFeature> features;
  for (const PlannedFeature& f : planned) features.push_back(feature(f, lies));
  return features;
}

double apart(const Pose& a, const Pose& b) {
  return (a.rotation - b.rotation).norm() + 1e-2 * (a.translation - b.translation).norm();
}

TEST(DatumSystemLaws, FindHowAPerfectPartLies) {
  const std::vector<PlannedFeature> planned = block();
  synthetic::Draws draws(61);
  for (const System& system : systems()) {
    if (system.degrees.back().empty()) continue;  // one datum too many, and a degree left
    for (int i = 0; i < 5; ++i) {
      const Pose lies{rotation_about(draws.direction(), draws.between(-0.02, 0.02)),
                      draws.place(1.0)};
      const auto found = found_datum(system.datum, measured_block(planned, lies));
      ASSERT_TRUE(found);
      EXPECT_LT(apart(found->workpiece_from_datum, lies), 1e-12) << system.datum.primary;
      EXPECT_TRUE(found->free_degrees.empty());
    }
  }
}

TEST(DatumSystem, TellsWhichDatumTakesWhat) {
  const std::vector<PlannedFeature> planned = block();
  InspectionPlan plan;
  plan.features = planned;
  for (const System& system : systems()) {
    const auto found = found_datum(system.datum, measured_block(planned, {}));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->datums.size(), system.degrees.size());
    for (std::size_t i = 0; i < system.degrees.size(); ++i) {
      EXPECT_EQ(found->datums[i].degrees, system.degrees[i])
          << system.datum.primary << ": " << found->datums[i].feature;
    }
    if (!system.datum.best_fit.empty()) continue;
    const std::vector<DatumShare> shares = planned_shares(plan, system.datum);
    for (std::size_t i = 0; i < shares.size(); ++i) EXPECT_EQ(shares[i].degrees, system.degrees[i]);
  }
}

TEST(DatumSystem, PlaneCylinderGrooveAsConstructedFromItsElements) {
  // A base alignment: primary normal; secondary axis pierced with that plane; tertiary plane's
  // trace in it.
  const std::vector<PlannedFeature> planned = block();
  synthetic::Draws draws(62);
  for (int i = 0; i < 20; ++i) {
    const auto askew = [&] {
      return Pose{rotation_about(draws.direction(), draws.between(-1e-3, 1e-3)), draws.place(0.1)};
    };
    const std::vector<FittedFeature> features{
        feature(planned[0], askew()), feature(planned[3], askew()), feature(planned[2], askew())};
    const auto frame = [](const Element& plane, const Element& bore, const Element& side) {
      const Vec3 z = *axis_of(plane);
      const Vec3 along = *axis_of(bore);
      const Vec3 y = z.cross(axis_of(side)->vec()).normalized();
      Pose pose;
      pose.rotation << y.cross(z), y, z;
      pose.translation =
          point_of(bore) + (point_of(plane) - point_of(bore)).dot(z) / along.dot(z) * along;
      return pose;
    };
    const Pose expected =
        frame(features[0].element, features[1].element, features[2].element) *
        frame(nominal_element(planned[0]), nominal_element(planned[3]), nominal_element(planned[2]))
            .inverse();
    DatumSystem system{"top", "bore", "side"};
    system.base = true;
    const auto found = found_datum(system, features);
    ASSERT_TRUE(found);
    EXPECT_LT(apart(found->workpiece_from_datum, expected), 1e-13);
  }
}

TEST(DatumSystemLaws, LaterDatumsAreFittedWithTheDirectionsThatEarlierOnesGive) {
  // Along the top's normal a bore is a circle and a side is a line.
  const std::vector<PlannedFeature> planned = block();
  synthetic::Draws draws(64);
  for (int i = 0; i < 20; ++i) {
    const auto rough = [&](const PlannedFeature& f) {
      const Pose lies{rotation_about(draws.direction(), draws.between(-1e-3, 1e-3)),
                      draws.place(0.1)};
      return feature(f, lies, [&](const Vec3&) { return 0.02 * draws.gauss(); });
    };
    const std::vector<FittedFeature> features{rough(planned[0]), rough(planned[3]),
                                              rough(planned[2])};
    const auto found = found_datum({"top", "bore", "side"}, features);
    ASSERT_TRUE(found);
    const Pose datum_from_workpiece = found->workpiece_from_datum.inverse();
    const auto seen_along = [&](const FittedFeature& f) {
      std::vector<Vec3> points;
      for (const MeasuredPoint& p : f.points) {
        points.push_back(datum_from_workpiece.point(p.point));
        points.back().z() = 0.0;
      }
      return points;
    };
    const auto circle = fit_circle_2d(seen_along(features[1]));
    ASSERT_TRUE(circle);
    EXPECT_LT((circle->element.point - Vec3(30, 30, 0)).norm(), 1e-9);
    const auto side = fit_line_2d(seen_along(features[2]));
    ASSERT_TRUE(side);
    EXPECT_NEAR(side->element.axis.vec().x(), 0.0, 1e-12);
  }
}

TEST(DatumSystem, LaterDatumsGiveWayToEarlierOnes) {
  const std::vector<PlannedFeature> planned = block();
  // The front is out of square by 1 mrad about X, about the middle of its points.
  const std::vector<FittedFeature> features{
      feature(planned[0]), feature(planned[1], turned(Vec3::UnitX(), 1e-3, {50, 0, 20})),
      feature(planned[2])};
  const auto top_first = found_datum({"top", "front", "side"}, features);
  ASSERT_TRUE(top_first);
  EXPECT_LT(apart(top_first->workpiece_from_datum, {}), 1e-12);
  const auto front_first = found_datum({"front", "top", "side"}, features);
  ASSERT_TRUE(front_first);
  EXPECT_NEAR((front_first->workpiece_from_datum.rotation - rotation_x(1e-3)).norm(), 0.0, 1e-12);
  // The top is held in the middle of its points.
  const Vec3 middle = front_first->workpiece_from_datum.inverse().point({50, 40, 40});
  EXPECT_NEAR(middle.z(), 40.0, 1e-12);
}

TEST(DatumSystem, SaysWhichDegreesNoDatumTakes) {
  const std::vector<PlannedFeature> planned = block();
  const Pose lies = Pose::translated({0.3, -0.2, 0.1}) * turned(Vec3::UnitZ(), 0.01);
  const auto features = measured_block(planned, lies);
  const auto hole = found_datum({"top", "bore", ""}, features);
  ASSERT_TRUE(hole);
  EXPECT_EQ(hole->free_degrees, std::vector<std::string>{"RZ"});
  EXPECT_LT((hole->workpiece_from_datum.rotation - Mat3::Identity()).norm(), 1e-12);
  const auto table = found_datum({"top", "", ""}, features);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->free_degrees, (std::vector<std::string>{"TX", "TY", "RZ"}));
  EXPECT_LT((table->workpiece_from_datum.translation - Vec3(0, 0, 0.1)).norm(), 1e-12);
  const auto fit = found_datum(best_fit_of({"bore"}), features);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->free_degrees, (std::vector<std::string>{"TZ", "RZ"}));
}

TEST(DatumSystem, BestFitMakesTheSumOfSquaresLeast) {
  const std::vector<PlannedFeature> planned = block();
  synthetic::Draws draws(63);
  const Pose lies{rotation_about(draws.direction(), 0.01), draws.place(0.5)};
  std::vector<FittedFeature> features;
  for (const PlannedFeature& f : planned) {
    features.push_back(feature(f, lies, [&](const Vec3&) { return 0.01 * draws.gauss(); }));
  }
  DatumSystem system = best_fit_of({"top", "front", "bore", "taper", "edge", "ball 2"});
  const auto sum = [&](const Pose& workpiece_from_datum) {
    double squares = 0.0;
    for (const FittedFeature& f : features) {
      const auto& names = system.best_fit;
      if (std::find(names.begin(), names.end(), f.planned->name) == names.end()) continue;
      const Element nominal = f.planned->kind == FeatureKind::line
                                  ? Element(Plane{f.planned->point, unit(f.planned->normal)})
                                  : nominal_element(*f.planned);
      for (const MeasuredPoint& p : f.points) {
        const double d = residual(nominal, workpiece_from_datum.inverse().point(p.point));
        squares += d * d;
      }
    }
    return squares;
  };
  const auto least_against = [&](const Pose& best, std::initializer_list<int> ways) {
    for (const int way : ways) {
      for (const double by : {-1e-4, 1e-4}) {
        Pose step;
        if (way < 3) step.translation[way] = by;
        if (way >= 3) step.rotation = rotation_about(Vec3::Unit(way - 3), by);
        EXPECT_LT(sum(best), sum(best * step)) << way;
      }
    }
  };
  const auto found = found_datum(system, features);
  ASSERT_TRUE(found);
  EXPECT_LT((found->workpiece_from_datum.translation - lies.translation).norm(), 0.05);
  least_against(found->workpiece_from_datum, {0, 1, 2, 3, 4, 5});
  system.locked = {"TZ", "RX", "RY", "RZ"};
  const auto shifted = found_datum(system, features);
  ASSERT_TRUE(shifted);
  EXPECT_EQ(shifted->workpiece_from_datum.rotation, Mat3::Identity());
  EXPECT_EQ(shifted->workpiece_from_datum.translation.z(), 0.0);
  EXPECT_EQ(shifted->free_degrees, (std::vector<std::string>{"TZ", "RX", "RY", "RZ"}));
  least_against(shifted->workpiece_from_datum, {0, 1});
}

TEST(DatumSystem, IsReportedWithTheMeasurement) {
  InspectionPlan plan;
  plan.features = block();
  std::erase_if(plan.features,
                [](const PlannedFeature& f) { return f.kind == FeatureKind::sphere; });
  plan.datum = DatumSystem{"top", "bore", "bore 2"};
  const Pose lies = Pose::translated({0.3, -0.2, 0.1}) * turned(Vec3::UnitX(), 0.01);
  std::vector<FeaturePoints> points;
  for (const PlannedFeature& f : plan.features) {
    FeaturePoints& of_feature = points.emplace_back();
    of_feature.feature = f.name;
    for (const PlannedPoint& p : planned_points(f)) {
      of_feature.points.push_back(lies.point(p.point));
    }
  }
  const auto measurement = evaluate(plan, points);
  ASSERT_TRUE(measurement) << to_string(measurement.error().front());
  EXPECT_LT(apart(measurement->workpiece_from_datum, lies), 1e-12);
  ASSERT_EQ(measurement->datums.size(), 3U);
  EXPECT_EQ(measurement->datums[2].degrees, std::vector<std::string>{"RZ"});
  points.erase(points.begin());
  const auto without = evaluate(plan, points);
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().front().message, "datum feature 'top' has no points");
}

}  // namespace
}  // namespace frustum::metrology
