// Whether intervals hold what is known: the noise of all characteristics about one measurement,
// simulated as every interval is computed. It hardly depends on the measurement, so one simulation
// serves for all.
// Units: as results.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "metrology/evaluation.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"
#include "metrology/uncertainty/non_negative_interval.hpp"

namespace frustum::metrology::coverage {

inline std::vector<FittedFeature> fitted(const InspectionPlan& plan, const Measurement& m) {
  std::vector<FittedFeature> features;
  for (const MeasuredFeature& f : m.features) {
    std::vector<Vec3> points;
    std::vector<std::size_t> sections;
    for (const MeasuredPoint& p : f.points) {
      points.push_back(m.workpiece_from_datum.point(p.point));
      sections.push_back(p.section);
    }
    auto fit = fit_feature(*find_feature(plan, f.name), points, sections, 0.0);
    if (fit) features.push_back(std::move(*fit));
  }
  return features;
}

// The part with the errors of one measurement in its points.
inline std::vector<FittedFeature> measured_again(const std::vector<FittedFeature>& part,
                                                 const MeasuringErrors& errors) {
  std::vector<FittedFeature> seen;
  for (std::size_t f = 0; f < part.size(); ++f) {
    std::vector<Vec3> points;
    std::vector<std::size_t> sections;
    for (const MeasuredPoint& p : part[f].points) {
      points.push_back(errors(p.point, p.normal, f, points.size()));
      sections.push_back(p.section);
    }
    auto fitted = fit_feature(*part[f].planned, points, sections, 0.0);
    EXPECT_TRUE(fitted);
    if (fitted) seen.push_back(*std::move(fitted));
  }
  return seen;
}

inline Eigen::VectorXd parts_of(const CharacteristicResult& c) {
  return Eigen::Map<const Eigen::VectorXd>(c.measurand.parts.data(),
                                           static_cast<Eigen::Index>(c.measurand.parts.size()));
}

// The draws of all characteristics about one measurement.
struct Noise {
  std::vector<std::vector<double>> values{};  // of those of either sign, less the measured one
  std::vector<Eigen::MatrixXd> parts{};
  std::vector<std::optional<ShapeEstimate>> shapes{};
};
inline Noise noise_about(const InspectionPlan& plan, const Measurement& one,
                         const ErrorDraws& draws, std::uint32_t count) {
  const auto features = fitted(plan, one);
  const auto& about = one.characteristics;
  Noise noise;
  noise.values.resize(about.size());
  noise.parts.resize(about.size());
  noise.shapes.resize(about.size());
  for (std::uint32_t draw = 0; draw < count; ++draw) {
    const auto m = remeasured(plan, features, draws(draw));
    EXPECT_TRUE(m);
    for (std::size_t c = 0; c < about.size(); ++c) {
      const CharacteristicResult& drawn = m->characteristics[c];
      noise.values[c].push_back(drawn.value - about[c].value);
      if (!drawn.measurand.is_known()) continue;
      noise.parts[c].conservativeResize(parts_of(drawn).size(), count);
      noise.parts[c].col(draw) = parts_of(drawn) - parts_of(about[c]);
    }
  }
  for (std::size_t c = 0; c < about.size(); ++c) {
    std::sort(noise.values[c].begin(), noise.values[c].end());
    if (noise.parts[c].size() == 0) continue;
    noise.shapes[c].emplace(about[c].measurand.rule, about[c].measurand.places, noise.parts[c]);
  }
  return noise;
}

inline bool holds(const Noise& noise, std::size_t c, const CharacteristicResult& measured,
                  const CharacteristicResult& truth) {
  if (!noise.shapes[c]) {
    const auto& sorted = noise.values[c];
    const double off = truth.value - measured.value;
    return off >= sorted[sorted.size() / 40] &&
           off <= sorted[sorted.size() - 1 - sorted.size() / 40];
  }
  const Eigen::VectorXd shape = (*noise.shapes[c])(parts_of(measured));
  const SizeUnderNoise sizes(measured.measurand.rule, noise.parts[c], shape);
  const double exact = internal_value(truth);
  // Rounding is no form.
  return sizes.accepts(internal_value(measured), exact < 1e-8 ? 0.0 : exact);
}

}  // namespace frustum::metrology::coverage
