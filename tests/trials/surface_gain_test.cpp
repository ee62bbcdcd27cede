// Gains of surface points against whole cuts: the program runs again with the error in the machine,
// and the same probe ray is asked.
#include "trials/surface_gain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "tests/trials/cone_trial.hpp"
#include "tests/trials/surface_at_point.hpp"

namespace frustum::trials {
namespace {

TrialOptions quick() {
  TrialOptions options;
  options.find_collisions = false;
  options.measure = false;
  return options;
}

// The cone in 250 blocks a turn: chords of 3 um, facets that lean by 0.7 degrees against the cone.
programs::ConeFrustum coarse_cone() {
  programs::ConeFrustum cone;
  cone.chord_tolerance = {3e-3};
  return cone;
}

// Every machine error that moves the cone's surface, each of one kind at least: linear and rotary
// axes, places, squareness, and the tool.
const std::vector<std::string> kErrors = {"tool_radius_error",
                                          "EX0Y",
                                          "EC0Y",
                                          "EA0Z",
                                          "EB0Z",
                                          "EX0B",
                                          "EZ0B",
                                          "EA0B",
                                          "EC0B",
                                          "EX0C",
                                          "EY0C",
                                          "EA0C",
                                          "EB0C"};

struct Difference {
  double worst = 0.0;    // of slope against gain
  double largest = 0.0;  // slope
  int points = 0, changed = 0;
};

class ConeCuts {
 public:
  ConeCuts() : cone_(ConeTrial::on("iwf-bc", coarse_cone())) {
    TrialOptions options = quick();
    options.measure = true;
    auto base = run_trial(cone_.machine, kinematics::GeometricErrors{}, cone_.piece, {}, options);
    EXPECT_TRUE(base);
    if (base) base_ = *std::move(base);
  }

  [[nodiscard]] SurfaceGains gains(std::span<const Parameter> parameters) const {
    auto gains = surface_gains(cone_.machine, cone_.piece, base_, parameters);
    EXPECT_TRUE(gains);
    return gains ? *std::move(gains) : SurfaceGains{};
  }

  [[nodiscard]] Trial with(const Parameter& parameter, double amount) const {
    kinematics::GeometricErrors errors;
    programs::TestPiece piece = cone_.piece;
    if (parameter.unit) errors = errors.plus(*parameter.unit, amount);
    for (auto& [number, tool] : piece.tools) {
      if (!parameter.unit) tool.radius_error.value += amount;
    }
    auto trial = run_trial(cone_.machine, errors, piece, {}, quick());
    EXPECT_TRUE(trial) << (trial ? "" : to_string(trial.error().front()));
    return trial ? *std::move(trial) : Trial{};
  }

  // Central differences over `step` at every 20th point. Where another block has made the point
  // after the step, or an edge has passed it, there is no derivative.
  [[nodiscard]] Difference compare(const Parameter& parameter, double step,
                                   const Eigen::VectorXd& gain) const {
    const Trial plus = with(parameter, step), minus = with(parameter, -step);
    Difference d;
    Eigen::Index row = -1;
    for (const auto& feature : base_.measurement.features) {
      for (std::size_t i = 0; i < feature.points.size(); ++i) {
        if (++row % 20 != 0) continue;
        const Vec3 at = feature.touches.at(i).point;
        const Vec3 n = base_.measurement.workpiece_from_datum.direction(feature.points[i].normal);
        const auto here = surface_at_point(*base_.workpiece, at, n);
        const auto a = surface_at_point(*plus.workpiece, at, n);
        const auto b = surface_at_point(*minus.workpiece, at, n);
        if (!here || !here->segment) continue;
        ++d.points;
        if (!a || !b || a->source_line != here->source_line ||
            b->source_line != here->source_line) {
          ++d.changed;
          continue;
        }
        const double slope = (b->s - a->s) / (2.0 * step);
        d.worst = std::max(d.worst, std::abs(slope - gain[row]));
        d.largest = std::max(d.largest, std::abs(slope));
      }
    }
    return d;
  }

 private:
  ConeTrial cone_;
  Trial base_{};
};

TEST(SurfaceGain, RefusesPointsWhoseProvenanceNobodyKnows) {
  const ConeTrial cone = ConeTrial::on("iwf-bc", coarse_cone());
  Trial trial;
  trial.measurement.features = {{.name = "cone", .points = {{}}}};
  const auto parameters = parameters_named(cone.machine, kErrors);
  ASSERT_TRUE(parameters);
  const auto gains = surface_gains(cone.machine, cone.piece, trial, *parameters);
  ASSERT_FALSE(gains);
  EXPECT_EQ(gains.error().front().id, "no-provenance"_id);
}

TEST(SurfaceGainReference, AgreesWithWholeCutsOfTheFiveAxisCone) {
  const ConeCuts cuts;
  const auto parameters = parameters_named(
      kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml").value(),
      kErrors);
  ASSERT_TRUE(parameters);
  const SurfaceGains gains = cuts.gains(*parameters);
  for (std::size_t k = 0; k < kErrors.size(); ++k) {
    // 2.5 um, or what moves the surface by about as much at 130 mm from the rotary axes.
    const double step = (*parameters)[k].angular ? 1e-5 : 2.5e-3;
    const Difference d =
        cuts.compare((*parameters)[k], step, gains.odd.col(static_cast<Eigen::Index>(k)));
    std::cout << fmt::format(
        "{}: largest gain {:.4g}, worst difference {:.1e} in {} points; {} left out between "
        "blocks\n",
        kErrors[k], d.largest, d.worst, d.points - d.changed, d.changed);
    // The path is a chain of chords within 0.01 um: where the point moves from one to the next
    // within the step its normal turns by up to 4 * 1e-5 / 0.3 mm = 1.3e-4, of which half shows.
    EXPECT_LT(d.worst, 2e-5 * std::max(1.0, d.largest)) << kErrors[k];
    EXPECT_LE(d.changed * 20, d.points) << kErrors[k];
    EXPECT_GT(d.points, 90);
  }
}

}  // namespace
}  // namespace frustum::trials
