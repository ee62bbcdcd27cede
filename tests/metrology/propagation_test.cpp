#include "metrology/propagation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "metrology/influence.hpp"
#include "step_part.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

constexpr CmmModel kCmm{.e0_mm = 0.002, .length_per_error = 300.0, .seed = 7};

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
  // Lines that do not run over the middle of the part, read away from the middle of their points.
  for (PlannedFeature& f : p.features) {
    if (f.kind != FeatureKind::line) continue;
    f.point.x() = 8.0;
    std::get<LineStrategy>(f.strategy) = {-30.0, 12.0, 9};
  }
  return p;
}

TEST(Propagation, GradientsAreWhatMovedPointsDo) {
  // Lines also in the datum system, whose floor, wall and cylinder are not those of the frames.
  InspectionPlan p = mixed_plan();
  auto points = step_part::surface_points(p, step_part::part());
  for (const bool with_datum : {false, true}) {
    if (with_datum) {
      PlannedFeature pin;
      pin.name = "pin";
      pin.kind = FeatureKind::cylinder;
      pin.point = {20, 10, 12};
      pin.radius = 6.0;
      pin.strategy = SectionStrategy{{0.0, 8.0}, 7};
      p.features.push_back(pin);
      PlannedFeature wall;
      wall.name = "wall";
      wall.axis = {0, -1, 0};
      wall.point = {0, -40, 2.5};
      wall.strategy = GridStrategy{{50, 0, 0}, {0, 0, 3}, 4, 2};
      p.features.push_back(wall);
      p.datum = DatumSystem{"F_b", "pin", "wall"};
      p.alignment = Alignment::datum;
      p.characteristics.push_back({"pin", K::diameter, {"pin"}, {}, 0.02});
      for (std::size_t i = p.features.size() - 2; i < p.features.size(); ++i) {
        FeaturePoints more{p.features[i].name, {}, {}};
        for (const PlannedPoint& planned : planned_points(p.features[i])) {
          more.points.push_back(planned.point);
        }
        points.push_back(std::move(more));
      }
    }
    const auto m = evaluate(p, points);
    ASSERT_TRUE(m) << to_string(m.error().front());
    std::vector<FittedFeature> features;
    for (const FeaturePoints& f : points) {
      std::vector<std::size_t> sections;
      const PlannedFeature& planned = *find_feature(p, f.feature);
      for (const PlannedPoint& point : planned_points(planned)) sections.push_back(point.section);
      auto fit = fit_feature(planned, f.points, sections, 0.0);
      ASSERT_TRUE(fit);
      features.push_back(std::move(*fit));
    }
    Influence influence(p, features);
    std::vector<Eigen::RowVectorXd> gradients;
    for (const PlannedCharacteristic& c : p.characteristics) {
      auto gradient = influence.of(c);
      ASSERT_TRUE(gradient);
      EXPECT_EQ(gradient->has_value(), c.kind != K::flatness);
      gradients.push_back(gradient->value_or(Eigen::RowVectorXd()));
    }
    // The whole evaluation with one point moved, by central differences.
    Eigen::Index column = 0;
    double largest = 0.0;
    for (std::size_t f = 0; f < points.size(); ++f) {
      for (std::size_t i = 0; i < points[f].points.size(); ++i, ++column) {
        constexpr double kStep = 0.5e-3;
        const Vec3 step = kStep * features[f].points[i].normal;
        auto moved = points;
        moved[f].points[i] += step;
        const auto up = evaluate(p, moved);
        moved[f].points[i] -= 2.0 * step;
        const auto down = evaluate(p, moved);
        ASSERT_TRUE(up && down);
        for (std::size_t c = 0; c < gradients.size(); ++c) {
          if (gradients[c].size() == 0) continue;
          const double wanted =
              (internal_value(up->characteristics[c]) - internal_value(down->characteristics[c])) /
              (2.0 * kStep);
          EXPECT_NEAR(gradients[c][column], wanted, 2e-6)
              << p.characteristics[c].name << ", " << points[f].feature << ' ' << i;
          largest = std::max(largest, std::abs(gradients[c][column] - wanted));
        }
      }
    }
    std::printf("largest difference of a gradient: %.2g\n", largest);
  }
}

TEST(Propagation, CovarianceIsThatOfSimulatedMeasurements) {
  const InspectionPlan p = mixed_plan();
  const step_part::Part body = step_part::part();
  const auto once = measure(p, body);
  ASSERT_TRUE(once) << to_string(once.error().front());
  const auto stated = covariance(p, *once, kCmm);
  ASSERT_TRUE(stated);
  constexpr int kDraws = 2000;
  const auto count = static_cast<Eigen::Index>(p.characteristics.size());
  Eigen::MatrixXd values(kDraws, count);
  for (int draw = 0; draw < kDraws; ++draw) {
    CmmModel cmm = kCmm;
    cmm.draw = static_cast<std::uint32_t>(draw);
    const auto m = measure(p, body, cmm);
    ASSERT_TRUE(m);
    for (Eigen::Index i = 0; i < count; ++i) {
      values(draw, i) = internal_value(m->characteristics[static_cast<std::size_t>(i)]);
    }
  }
  const Eigen::MatrixXd centred = values.rowwise() - values.colwise().mean();
  const Eigen::MatrixXd seen = centred.transpose() * centred / (kDraws - 1);
  double worst_variance = 0.0;
  double worst_correlation = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& name = p.characteristics[static_cast<std::size_t>(i)].name;
    if (name == "flat") continue;  // no gradient: see below
    // The variance of 2000 draws has a standard error of 3.2 %, a correlation one of 0.022.
    const double ratio = (*stated)(i, i) / seen(i, i);
    EXPECT_NEAR(ratio, 1.0, 0.1) << name;
    worst_variance = std::max(worst_variance, std::abs(ratio - 1.0));
    for (Eigen::Index k = 0; k < i; ++k) {
      const auto correlation = [&](const Eigen::MatrixXd& c) {
        return c(i, k) / std::sqrt(c(i, i) * c(k, k));
      };
      EXPECT_NEAR(correlation(*stated), correlation(seen), 0.08)
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
  const auto m = measure(p, step_part::part(), kCmm);
  ASSERT_TRUE(m);
  const auto joint = covariance(p, *m, kCmm);
  ASSERT_TRUE(joint);
  for (std::size_t i = 0; i < m->characteristics.size(); ++i) {
    const CharacteristicResult& c = m->characteristics[i];
    const auto k = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(2.0 * std::sqrt((*joint)(k, k)) / internal_value(c.expanded_uncertainty, c.unit),
                1.0, 1e-6)
        << c.name;
    EXPECT_GT(c.expanded_uncertainty, 0.0) << c.name;
  }
  EXPECT_EQ((*joint)(10, 0), 0.0);  // a flatness stands alone
  const auto ideal = covariance(p, *m, {});
  ASSERT_TRUE(ideal);
  EXPECT_EQ(ideal->norm(), 0.0);
}

TEST(Propagation, AgreesWithTheFormulasOfRoundFeatures) {
  const InspectionPlan p = test_part::plan();
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
    const auto joint = covariance(p, measurement, kCmm);
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
  EXPECT_FALSE(covariance(p, *m, kCmm));
}

}  // namespace
}  // namespace frustum::metrology
