#include "metrology/probing/geometry_field.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "metrology/probing/legendre.hpp"

namespace frustum::metrology {
namespace {

constexpr int kStations = 5;  // along each axis, both ends included

}  // namespace

GeometryField::GeometryField(std::uint64_t seed, const Vec3& travel, const LengthLimit& limit)
    : half_travel_(0.5 * travel) {
  if (!(limit.constant > 0.0) && !(limit.slope > 0.0)) return;
  is_zero_ = false;
  draw(seed);
  const RandomKey key{.seed = seed, .purpose = RandomPurpose::cmm_geometry};
  // Between the points of the lattice a length may err a few percent more.
  const double share = 0.85 + 0.1 * uniform(key, 0);
  scale(share / worst_ratio(limit));
}

void GeometryField::draw(std::uint64_t seed) {
  const RandomKey key{.seed = seed, .purpose = RandomPurpose::cmm_geometry};
  std::uint64_t index = 1;
  // A straightness has no linear part: that is squareness. A rotation of 1 / half travel moves what
  // the axis carries about as far as a shift of 1 does.
  const double per_arm = 1.0 / half_travel_.maxCoeff();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t way = 0; way < 3; ++way) {
      for (std::size_t degree = 1; degree <= kDegrees; ++degree) {
        const double fall = 1.0 / static_cast<double>(degree);
        const bool is_straightness = way != axis;
        axes_[axis].shift[way][degree - 1] =
            is_straightness && degree == 1 ? 0.0 : fall * normal(key, index);
        axes_[axis].rotation[way][degree - 1] = fall * per_arm * normal(key, index + 1);
        index += 2;
      }
    }
  }
  for (int i = 0; i < 3; ++i) squareness_[i] = per_arm * normal(key, index++);
}

void GeometryField::scale(double factor) {
  for (Axis& axis : axes_) {
    for (auto* curves : {&axis.shift, &axis.rotation}) {
      for (Curve& curve : *curves) {
        for (double& c : curve) c *= factor;
      }
    }
  }
  squareness_ *= factor;
}

GeometryField::AxisError GeometryField::error_of(int axis, double place) const {
  const auto polynomials = legendre<kDegrees>(std::clamp(place / half_travel_[axis], -1.0, 1.0));
  const auto value = [&](const Curve& curve) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kDegrees; ++i) sum += curve[i] * polynomials[i + 1];
    return sum;
  };
  const auto vector = [&](const std::array<Curve, 3>& curves) {
    return Vec3(value(curves[0]), value(curves[1]), value(curves[2]));
  };
  const Axis& a = axes_[static_cast<std::size_t>(axis)];
  return {vector(a.shift), vector(a.rotation)};
}

Vec3 GeometryField::at(const Vec3& position) const {
  if (is_zero_) return Vec3::Zero();
  const AxisError x = error_of(0, position.x());
  const AxisError y = error_of(1, position.y());
  const AxisError z = error_of(2, position.z());
  // The ram's own rotations turn the stylus alone; its length hangs below the scales.
  const Vec3 tip(0.0, 0.0, -half_travel_.z());
  const Vec3 square(-squareness_[2] * position.y() + squareness_[1] * position.z(),
                    -squareness_[0] * position.z(), 0.0);
  const Vec3 on_ram = tip;
  const Vec3 on_x = Vec3(0.0, 0.0, position.z()) + tip;
  const Vec3 on_y = Vec3(position.x(), 0.0, position.z()) + tip;
  return x.shift + y.shift + z.shift + square + z.rotation.cross(on_ram) + x.rotation.cross(on_x) +
         y.rotation.cross(on_y);
}

bool GeometryField::reaches(const Vec3& position) const {
  return is_zero_ || (position.cwiseAbs().array() <= half_travel_.array()).all();
}

double GeometryField::worst_ratio(const LengthLimit& limit) const {
  std::vector<Vec3> places;
  std::vector<Vec3> errors;
  const auto station = [](int i) { return 2.0 * i / (kStations - 1) - 1.0; };
  for (int i = 0; i < kStations; ++i) {
    for (int j = 0; j < kStations; ++j) {
      for (int k = 0; k < kStations; ++k) {
        places.push_back(half_travel_.cwiseProduct(Vec3(station(i), station(j), station(k))));
        errors.push_back(at(places.back()));
      }
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 apart = places[i] - places[j];
      const double length = apart.norm();
      const double error = (errors[i] - errors[j]).dot(apart) / length;
      worst = std::max(worst, std::abs(error) / limit.of(length));
    }
  }
  return worst;
}

}  // namespace frustum::metrology
