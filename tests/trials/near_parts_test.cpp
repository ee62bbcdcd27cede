#include "trials/population/near_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace frustum::trials {
namespace {

// One column, which moves the cutter at the only place by 1 mm along Z for a unit.
NearPlaces one_place() {
  NearPlaces places;
  const ColumnMotions along_z{{0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F}};
  places.places.push_back({Vec3(1, 2, 3), along_z});
  places.path = {{along_z}, {0.0}, 0.0};
  return places;
}

// A part 0.5 mm from the contact, which stays where it is.
NearParts near_part(const Vec3& first, const Vec3& second) {
  NearParts near{.is_known = true, .far = 10.0};
  NearPart part{.distance = 0.5F};
  part.between = static_cast<float>(std::sqrt(0.5 * (1.0 + first.dot(second))));
  part.ends = {NearPart::End{0, first.cast<float>()}, NearPart::End{0, second.cast<float>()}};
  near.parts.push_back(part);
  near.own.push_back({0.0F, 0.0F, 0.0F});
  return near;
}

bool keeps_away(const NearParts& near, double weight) {
  const NearPlaces places = one_place();
  return MachineNearness(places, {weight}).keep_away(near, Vec3::Zero(), 1.0, 0.0, 0.0);
}

TEST(NearParts, ACutterThatMovesOutwardsComesNearer) {
  const NearParts near = near_part(Vec3::UnitZ(), Vec3::UnitZ());
  EXPECT_TRUE(keeps_away(near, 0.45));
  EXPECT_FALSE(keeps_away(near, 0.6));
  EXPECT_TRUE(keeps_away(near, -0.6));
}

TEST(NearParts, AContactThatMovesOutwardsGoesAway) {
  NearParts near = near_part(Vec3::UnitZ(), Vec3::UnitZ());
  near.own.front() = {0.0F, 0.0F, 1.0F};
  EXPECT_TRUE(keeps_away(near, 2.0));
  near.own.front() = {0.0F, 0.0F, 2.0F};
  EXPECT_TRUE(keeps_away(near, 2.0));
  EXPECT_FALSE(keeps_away(near, -2.0));
}

TEST(NearParts, NormalsBetweenTheEndsAreSeen) {
  // In the middle the normal is Z; at the ends the motion looks 0.8 of it.
  const NearParts turned = near_part({0.6, 0.0, 0.8}, {-0.6, 0.0, 0.8});
  EXPECT_TRUE(keeps_away(turned, 0.45));
  EXPECT_FALSE(keeps_away(turned, 0.55));
  EXPECT_FALSE(keeps_away(near_part(Vec3::UnitX(), -Vec3::UnitX()), 0.01));
}

TEST(NearParts, FarMotionsAndUnknownPartsAreNoProof) {
  NearParts near = near_part(Vec3::UnitZ(), Vec3::UnitZ());
  EXPECT_FALSE(keeps_away(near, -6.0));
  near.is_known = false;
  EXPECT_FALSE(keeps_away(near, 0.0));
}

}  // namespace
}  // namespace frustum::trials
