#include "metrology/uncertainty/propagation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "metrology/uncertainty/linear_uncertainty.hpp"
#include "tests/law_count.hpp"
#include "tests/metrology/step_part.hpp"
#include "tests/metrology/test_part.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

const CmmModel kPropagationCmm{.e0_mm = 0.002, .length_per_error = 300.0, .seed = 7};

// The step part with everything that may correlate: shared lines and floors, a leaning wall as
// reference, no frame at all, the flatness of a floor.
InspectionPlan mixed_plan() {
  InspectionPlan p = step_part::plan();
  p.frames.push_back({"leaning", {"F_b"}, "E_d"});
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  p.characteristics.push_back({"over", K::line_distance, {"S_a", "E_d"}, {}, 0.02, "R", y});
  p.characteristics.push_back({"tilt", K::line_angle, {"B_d", "E_c"}, {}, 1e-3, "R", y});
  p.characteristics.push_back({"lean", K::line_distance, {"E_c", "S_d"}, {}, 0.02, "leaning", y});
  p.characteristics.push_back({"bare", K::line_distance, {"E_c", "S_d"}, {}, 0.02, "", y});
  p.characteristics.push_back({"flat", K::flatness, {"F_a"}, {}, 0.02});
  // Upright lines on two walls, 40 mm apart along X: they see the frame turn about Z.
  for (const char* name : {"S_c upright", "S_d upright"}) {
    PlannedFeature f = *find_feature(p, std::string(name).substr(0, 3));
    f.name = name;
    f.axis = z;
    f.point.x() = name[2] == 'c' ? -20.0 : 20.0;
    f.strategy = LineStrategy{-1.5, 1.5, 4};
    p.features.push_back(f);
  }
  p.characteristics.push_back(
      {"yaw", K::line_distance, {"S_c upright", "S_d upright"}, {}, 0.02, "R", y});
  p.characteristics.push_back(
      {"lean yaw", K::line_distance, {"S_c upright", "S_d upright"}, {}, 0.02, "leaning", y});
  // Lines that do not run over the middle of the part, read away from the middle of their points.
  for (PlannedFeature& f : p.features) {
    if (f.kind != FeatureKind::line || f.name.size() > 3) continue;
    f.point.x() = 8.0;
    std::get<LineStrategy>(f.strategy) = {-30.0, 12.0, 9};
  }
  return p;
}

std::vector<FeaturePoints> points_of(const Measurement& m) {
  std::vector<FeaturePoints> all;
  for (const MeasuredFeature& f : m.features) {
    FeaturePoints points{f.name, {}, {}};
    for (const MeasuredPoint& p : f.points) {
      points.points.push_back(m.workpiece_from_datum.point(p.point));
      points.sections.push_back(p.section);
    }
    all.push_back(std::move(points));
  }
  return all;
}

// Largest relative difference between the standard uncertainties of independent points of 1 um and
// the root of the squares of what the whole evaluation does when each point moves, one by one.
double gradient_error(const InspectionPlan& p, const std::vector<FeaturePoints>& points) {
  std::vector<FittedFeature> features;
  for (const FeaturePoints& f : points) {
    auto fit = fit_feature(*find_feature(p, f.feature), f.points, f.sections, 0.0);
    EXPECT_TRUE(fit);
    if (!fit) return HUGE_VAL;
    features.push_back(std::move(*fit));
  }
  const auto stated = linear_uncertainty(p, features, {.probing = 1e-3});
  EXPECT_TRUE(stated);
  if (!stated) return HUGE_VAL;
  Eigen::VectorXd squares =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(p.characteristics.size()));
  for (std::size_t f = 0; f < points.size(); ++f) {
    for (std::size_t i = 0; i < points[f].points.size(); ++i) {
      constexpr double kStep = 0.5e-3;
      const Vec3 step = kStep * features[f].points[i].normal;
      auto moved = points;
      moved[f].points[i] += step;
      const auto up = evaluate(p, moved);
      moved[f].points[i] -= 2.0 * step;
      const auto down = evaluate(p, moved);
      EXPECT_TRUE(up && down);
      if (!up || !down) return HUGE_VAL;
      for (Eigen::Index c = 0; c < squares.size(); ++c) {
        const auto k = static_cast<std::size_t>(c);
        const double slope =
            (internal_value(up->characteristics[k]) - internal_value(down->characteristics[k])) /
            (2.0 * kStep);
        squares[c] += 1e-6 * slope * slope;
      }
    }
  }
  double largest = 0.0;
  for (Eigen::Index c = 0; c < squares.size(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    if (!has_derivative(p.characteristics[k].kind)) continue;
    largest = std::max(largest, std::abs(stated->standard[k] / std::sqrt(squares[c]) - 1.0));
  }
  std::printf("largest difference: %.2g\n", largest);
  return largest;
}

TEST(Propagation, GradientsAreWhatMovedPointsDo) {
  const InspectionPlan p = mixed_plan();
  const auto perfect = evaluate(p, step_part::surface_points(p, step_part::part()));
  ASSERT_TRUE(perfect) << to_string(perfect.error().front());
  EXPECT_LT(gradient_error(p, points_of(*perfect)), 1e-7);
  // Gradients are about 1; what a part 1 mrad askew changes is of the order of 1e-3 of them.
  const Pose lie{rotation_about(Vec3(2, -1, 2).normalized(), 1e-3), Vec3(0.2, -0.1, 0.3)};
  const auto askew = evaluate(p, step_part::surface_points(p, step_part::part().moved(lie)));
  ASSERT_TRUE(askew);
  EXPECT_LT(gradient_error(p, points_of(*askew)), 1e-3);
}

TEST(Propagation, GradientsInADatumSystemToo) {
  InspectionPlan p = mixed_plan();
  PlannedFeature pin;
  pin.name = "pin";
  pin.kind = FeatureKind::cylinder;
  pin.point = {20, 10, 12};
  pin.radius = 6.0;
  pin.strategy = SectionStrategy{{0.0, 8.0}, 7};
  PlannedFeature wall;
  wall.name = "wall";
  wall.axis = {0, -1, 0};
  wall.point = {0, -40, 2.5};
  wall.strategy = GridStrategy{{50, 0, 0}, {0, 0, 3}, 4, 2};
  auto points = step_part::surface_points(p, step_part::part());
  for (const PlannedFeature& feature : {pin, wall}) {
    p.features.push_back(feature);
    FeaturePoints more{feature.name, {}, {}};
    for (const PlannedPoint& planned : planned_points(feature)) {
      more.points.push_back(planned.point);
    }
    points.push_back(std::move(more));
  }
  p.datum = DatumSystem{"F_b", "pin", "wall"};
  p.alignment = Alignment::datum;
  const auto m = evaluate(p, points);
  ASSERT_TRUE(m) << to_string(m.error().front());
  // Pin and wall are fitted with the direction that the floor gives, off which they are a little:
  // of second order.
  EXPECT_LT(gradient_error(p, points_of(*m)), 1e-5);
}

TEST(Propagation, GradientsOfRoundFeaturesToo) {
  InspectionPlan p = test_part::plan();
  PlannedFeature hole;
  hole.name = "hole";
  hole.kind = FeatureKind::circle;
  hole.side = Side::inside;
  hole.radius = 9.0;
  hole.strategy = SectionStrategy{{0.0}, 8, 0.0, 4.0};
  p.features.push_back(hole);
  p.characteristics.push_back({"hole", K::radius, {"hole"}, {}, 0.01});
  std::vector<FeaturePoints> points;
  for (const PlannedFeature& feature : p.features) {
    FeaturePoints all{feature.name, {}, {}};
    for (const PlannedPoint& planned : planned_points(feature)) {
      all.points.push_back(planned.point);
      all.sections.push_back(planned.section);
    }
    points.push_back(std::move(all));
  }
  EXPECT_LT(gradient_error(p, points), 1e-6);
}

TEST(Propagation, CovarianceIsThatOfSimulatedMeasurements) {
  const InspectionPlan p = mixed_plan();
  const step_part::Part body = step_part::part();
  const auto once = measure(p, body);
  ASSERT_TRUE(once) << to_string(once.error().front());
  const auto stated = covariance(p, *once, kPropagationCmm);
  ASSERT_TRUE(stated);
  const int draws = proof::law_count(2000, 500);
  const double wider = std::sqrt(2000.0 / draws);
  const auto count = static_cast<Eigen::Index>(p.characteristics.size());
  Eigen::MatrixXd values(draws, count);
  for (int draw = 0; draw < draws; ++draw) {
    CmmModel cmm = kPropagationCmm;
    cmm.draw = static_cast<std::uint32_t>(draw);
    const auto m = measure(p, body, cmm);
    ASSERT_TRUE(m);
    for (Eigen::Index i = 0; i < count; ++i) {
      values(draw, i) = internal_value(m->characteristics[static_cast<std::size_t>(i)]);
    }
  }
  const Eigen::MatrixXd centred = values.rowwise() - values.colwise().mean();
  const Eigen::MatrixXd seen = centred.transpose() * centred / (draws - 1);
  double worst_variance = 0.0;
  double worst_correlation = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& name = p.characteristics[static_cast<std::size_t>(i)].name;
    if (name == "flat") continue;  // no gradient: see below
    // The variance of 2000 draws has a standard error of 3.2 %, a correlation one of 0.022.
    const double ratio = (*stated)(i, i) / seen(i, i);
    EXPECT_NEAR(ratio, 1.0, 0.1 * wider) << name;
    worst_variance = std::max(worst_variance, std::abs(ratio - 1.0));
    for (Eigen::Index k = 0; k < i; ++k) {
      const auto correlation = [&](const Eigen::MatrixXd& c) {
        return c(i, k) / std::sqrt(c(i, i) * c(k, k));
      };
      EXPECT_NEAR(correlation(*stated), correlation(seen), 0.08 * wider)
          << name << ", " << p.characteristics[static_cast<std::size_t>(k)].name;
      worst_correlation =
          std::max(worst_correlation, std::abs(correlation(*stated) - correlation(seen)));
    }
  }
  std::printf("worst variance %.3f, worst correlation %.3f\n", worst_variance, worst_correlation);
  // dL and the distance of the outer walls share the machine's scale along Y.
  EXPECT_GT((*stated)(0, 4), 0.01 * std::sqrt((*stated)(0, 0) * (*stated)(4, 4)));
}

TEST(Propagation, IsTheUncertaintyThatEachResultStates) {
  const InspectionPlan p = mixed_plan();
  const auto m = measure(p, step_part::part(), kPropagationCmm);
  ASSERT_TRUE(m);
  const auto joint = covariance(p, *m, kPropagationCmm);
  ASSERT_TRUE(joint);
  for (std::size_t i = 0; i < m->characteristics.size(); ++i) {
    const CharacteristicResult& c = m->characteristics[i];
    const auto k = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(std::sqrt((*joint)(k, k)) / internal_value(c.standard_uncertainty, c.unit), 1.0,
                1e-6)
        << c.name;
    EXPECT_GT(c.expanded_uncertainty, 0.0) << c.name;
  }
  EXPECT_EQ((*joint)(10, 0), 0.0);  // a flatness stands alone
  const auto ideal = covariance(p, *m, {});
  ASSERT_TRUE(ideal);
  EXPECT_EQ(ideal->norm(), 0.0);
}

TEST(Propagation, AgreesWithTheFormulasOfRoundFeatures) {
  InspectionPlan p = test_part::plan();
  p.alignment = Alignment::plan;  // the formulas leave out what a datum adds to a cone's section
  const auto m = measure(p, test_part::part());
  ASSERT_TRUE(m);
  const auto index_of = [&](std::string_view name) {
    for (std::size_t i = 0; i < p.characteristics.size(); ++i) {
      if (p.characteristics[i].name == name) return static_cast<Eigen::Index>(i);
    }
    throw std::out_of_range(std::string(name));
  };
  // Noise alone: the cofactors of the fits say the same.
  const CmmModel noise{.e0_mm = 0.002};
  const auto measured = measure(p, test_part::part(), noise);
  ASSERT_TRUE(measured);
  const auto by_noise = covariance(p, *m, noise);
  ASSERT_TRUE(by_noise);
  for (const char* name : {"cone.half_angle", "cylinder.diameter", "cone.radius"}) {
    const Eigen::Index i = index_of(name);
    const CharacteristicResult& c = measured->characteristics[static_cast<std::size_t>(i)];
    // Here the points are those of a noisy part: its cofactors differ by noise over size.
    EXPECT_NEAR(2.0 * std::sqrt((*by_noise)(i, i)) / internal_value(c.expanded_uncertainty, c.unit),
                1.0, 1e-3)
        << name;
  }
  // Scales alone: a diameter grows by the mean of two scales, over the path of the ball centres.
  const CmmModel scales{.e0_mm = 0.0, .length_per_error = 500.0};
  const auto by_scale = covariance(p, *m, scales);
  ASSERT_TRUE(by_scale);
  const Eigen::Index i = index_of("cylinder.diameter");
  EXPECT_NEAR(std::sqrt((*by_scale)(i, i)), 53.0 * 1e-6 / std::sqrt(2.0), 1e-9);
}

TEST(Propagation, RefusesTheMeasurementOfAnotherPlan) {
  InspectionPlan p = step_part::plan();
  const auto m = measure(p, step_part::part());
  ASSERT_TRUE(m);
  const auto message = [&](const Measurement& measurement) {
    const auto joint = covariance(p, measurement, kPropagationCmm);
    return joint ? std::string() : joint.error().front().message;
  };
  Measurement other = *m;
  other.characteristics[1].name = "dX";
  EXPECT_EQ(message(other), "the plan has no characteristic 'dX'");
  other = *m;
  other.features[3].name = "S_x";
  EXPECT_EQ(message(other), "the plan has no feature 'S_x'");
  other = *m;
  other.features.erase(other.features.begin());
  EXPECT_EQ(message(other), "frame 'R': feature 'F_a' has no points");
  p.features[0].axis = Vec3::Zero();
  EXPECT_FALSE(covariance(p, *m, kPropagationCmm));
}

}  // namespace
}  // namespace frustum::metrology
