#include "trials/surface_gain.hpp"

#include <fmt/format.h>

#include <iostream>

#include "tests/trials/cone_trial.hpp"
#include "trials/cut_check.hpp"

namespace frustum::trials {
namespace {

TrialOptions exact(double bound) {
  TrialOptions options;
  options.path_bound = bound;
  options.find_collisions = false;
  return options;
}

TEST(SurfaceGain, Explore) {
  programs::ConeFrustum shape;
  shape.chord_tolerance = {std::getenv("CT") ? std::atof(std::getenv("CT")) : 5e-4};
  const double pb = std::getenv("PB") ? std::atof(std::getenv("PB")) : 1e-8;
  const ConeTrial cone = ConeTrial::on("iwf-bc", shape);
  const auto base =
      run_trial(cone.machine, kinematics::GeometricErrors{}, cone.piece, {}, exact(pb));
  ASSERT_TRUE(base);
  std::vector<std::string> names = constant_errors(cone.machine);
  const auto parameters = *parameters_named(cone.machine, names);
  const auto gains = surface_gains(cone.machine, cone.piece, *base, parameters);
  ASSERT_TRUE(gains);
  std::cout << "rows " << gains->odd.rows() << " stretches "
            << base->workpiece->removed().path().stretches.size() << '\n';
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    std::cout << names[k];
    for (const double factor : {4.0, 2.0, 1.0, 0.5}) {
      const double step = factor * (parameters[k].angular ? 2e-5 : 5e-3);
      const auto varied = [&](double amount) {
        if (parameters[k].unit)
          return run_trial(cone.machine,
                           kinematics::GeometricErrors{}.plus(*parameters[k].unit, amount),
                           cone.piece, {}, exact(pb));
        programs::TestPiece piece = cone.piece;
        for (auto& [number, tool] : piece.tools) tool.radius_error.value += amount;
        return run_trial(cone.machine, kinematics::GeometricErrors{}, piece, {}, exact(pb));
      };
      const auto plus = varied(step), minus = varied(-step);
      ASSERT_TRUE(plus && minus);
      Eigen::Index row = -1;
      double worst = 0.0, biggest = 0.0, wodd = 0;
      std::string where;
      int changed = 0;
      for (const auto& feature : base->measurement.features) {
        for (const auto& p : feature.points) {
          ++row;
          if (row % 10 != 0) continue;
          const Vec3 at = base->measurement.workpiece_from_datum.point(p.point);
          const Vec3 n = base->measurement.workpiece_from_datum.direction(p.normal);
          const auto a = surface_at_point(*plus->workpiece, at, n),
                     b = surface_at_point(*minus->workpiece, at, n),
                     c = surface_at_point(*base->workpiece, at, n);
          if (!a || !b || !c) {
            std::cout << " lost";
            continue;
          }
          if (!c->stretch) continue;
          if (a->source_line != b->source_line || a->source_line != c->source_line) {
            ++changed;
            continue;
          }
          const double slope = (b->s - a->s) / (2.0 * step);
          const double e = std::abs(slope - gains->odd(row, static_cast<Eigen::Index>(k)));
          if (e > worst) {
            worst = e;
            where = feature.name;
            wodd = slope;
          }
          biggest = std::max(biggest, std::abs(slope));
        }
      }
      std::cout << fmt::format("  {:.3g}: {:.2e} of {:.3g} ({} {:.3g}) ch {}", step, worst, biggest,
                               where, wodd, changed);
    }
    std::cout << '\n';
  }
}

}  // namespace
}  // namespace frustum::trials
