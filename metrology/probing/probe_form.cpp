#include "metrology/probing/probe_form.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/probing/legendre.hpp"

namespace frustum::metrology {
namespace {

constexpr double kPi = std::numbers::pi;

// Directions evenly over the sphere (golden spiral).
Vec3 spread_direction(int index, int count) {
  const double z = 1.0 - (2.0 * index + 1.0) / count;
  const double angle = index * kPi * (3.0 - std::sqrt(5.0));
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

double bending(double force, const Stylus& stylus) {
  const double moment_of_area = kPi * std::pow(stylus.diameter, 4) / 64.0;
  return force * std::pow(stylus.length, 3) / (3.0 * stylus.modulus * moment_of_area);
}

ProbeForm::ProbeForm(const ProbeErrors& errors, const Stylus& stylus, std::uint64_t seed)
    : errors_(errors), pole_(stylus.direction) {
  std::tie(u_, v_) = tangents(stylus.direction);
  if (errors.force > 0.0) bending_ = bending(errors.force, stylus);
  if (!(errors.ball_form > 0.0)) return;
  const RandomKey key{.seed = seed, .purpose = RandomPurpose::cmm_probe};
  for (std::uint64_t i = 0; i < harmonics_.size(); ++i) {
    const Vec3 axis(normal(key, 4 * i), normal(key, 4 * i + 1), normal(key, 4 * i + 2));
    harmonics_[i] = {axis.normalized(), normal(key, 4 * i + 3)};
  }
  // Some 12 deg apart: a harmonic of degree 4 rises no more than 5 % between them.
  constexpr int kDirections = 300;
  double largest = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    largest = std::max(largest, std::abs(ball(spread_direction(i, kDirections))));
  }
  for (Harmonic& h : harmonics_) h.amplitude *= errors.ball_form / largest;
}

double ProbeForm::ball(const Vec3& direction) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < harmonics_.size(); ++i) {
    const Harmonic& h = harmonics_[i];
    sum += h.amplitude * legendre<4>(h.axis.dot(direction))[2 + i / 3];
  }
  return sum;
}

double ProbeForm::outward_shift(const Vec3& outward) const {
  const double x = outward.dot(u_);
  const double y = outward.dot(v_);
  const double across = std::hypot(x, y);
  // Nothing turns about the stylus where the approach is along it.
  const double lobes =
      errors_.lobe * across * across * across *
      (across > 0.0 ? std::cos(3.0 * (std::atan2(y, x) - errors_.lobe_phase)) : 0.0);
  return ball(-outward) - errors_.pre_travel - lobes - bending_ * across * across;
}

}  // namespace frustum::metrology
