#include "trials/population/near_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trials/population/middle_contact.hpp"

namespace frustum::trials {
namespace {

// Of either motion, for what is of second order in the errors.
constexpr double kSecondOrder = 0.02;

kinematics::PoseDisplacement summed(const ColumnMotions& motions, std::span<const double> off) {
  kinematics::PoseDisplacement sum;
  for (std::size_t j = 0; j < off.size(); ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      sum.tip[i] += off[j] * motions[j][k];
      sum.turn[i] += off[j] * motions[j][k + 3];
    }
  }
  return sum;
}

}  // namespace

MachineNearness::MachineNearness(const NearPlaces& places, std::vector<double> off)
    : places_(places), off_(std::move(off)), known_(places.places.size()) {
  for (const ColumnMotions& motions : places.path.places) {
    const kinematics::PoseDisplacement by = summed(motions, off_);
    largest_ = std::max(largest_, by.tip.norm() + places.path.reach * by.turn.norm());
  }
  for (std::size_t j = 0; j < off_.size(); ++j)
    largest_ += std::abs(off_[j]) * places.path.spread[j];
  largest_ *= 1.0 + kSecondOrder;
}

const kinematics::PoseDisplacement& MachineNearness::at(std::uint32_t place) {
  std::optional<kinematics::PoseDisplacement>& known = known_[place];
  if (!known) known = summed(places_.places[place].motions, off_);
  return *known;
}

bool MachineNearness::keep_away(const NearParts& near, const Vec3& point, double scale,
                                double drift, double moved) {
  if (!near.is_known || !(2.0 * largest_ + drift < near.far)) return false;
  if (!keeps_away(near.rest, scale, drift, moved)) return false;
  Vec3 own = Vec3::Zero();
  for (std::size_t j = 0; j < off_.size(); ++j) {
    for (std::size_t k = 0; k < 3; ++k)
      own[static_cast<Eigen::Index>(k)] += off_[j] * near.own[j][k];
  }
  const auto nearer = [&](const NearPart::End& end) {
    if (end.place == NearPart::kFar) return 2.0 * largest_;
    const Vec3 normal = end.normal.cast<double>();
    const double by_own = normal.dot(own);
    const double by_other = normal.dot(at(end.place).at(point - places_.places[end.place].tip));
    return by_other - by_own + kSecondOrder * (std::abs(by_own) + std::abs(by_other));
  };
  return std::ranges::all_of(near.parts, [&](const NearPart& part) {
    const double most = std::max({0.0, nearer(part.ends[0]), nearer(part.ends[1])});
    return most + part.lean * drift < part.between * part.distance;
  });
}

}  // namespace frustum::trials
