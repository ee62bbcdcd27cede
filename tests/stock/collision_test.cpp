// Shanks and holders in material, when they are there; rapids, many of them.
#include "stock/collision/collision.hpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <numbers>

#include "stock/solid/removal.hpp"
#include "tests/law_count.hpp"
#include "tests/stock/milling.hpp"

namespace frustum::stock {
namespace {

using kinematics::PathKind;
using kinematics::SpindleDirection;
using testing::cut;
using testing::end_mill;
using testing::path_through;
using testing::random_path;

// Flutes of 6 mm and a shank or holder above them.
NonCuttingBody above_flutes(CollisionBody body, double radius) {
  return {1, body, {cutter::Profile({cutter::cone_zone(radius, radius, 6.0, 60.0)})}};
}
const NonCuttingBody kShank = above_flutes(CollisionBody::shank, 5.0);
const NonCuttingBody kThinShank = above_flutes(CollisionBody::shank, 4.0);
const NonCuttingBody kHolder = above_flutes(CollisionBody::holder, 12.0);

std::vector<Collision> of_slot(const std::vector<double>& floors, const NonCuttingBody& body) {
  std::vector<Vec3> tips;
  double x = -70.0;
  for (const double z : floors) {
    tips.push_back({x, 0, z});
    tips.push_back({x = -x, 0, z});
  }
  return find_body_collisions(cut(path_through(tips), end_mill(10.0, 6.0)), {body});
}

TEST(Collision, StandingToolsMayGoBackThroughEachSlotThatTheyHaveCut) {
  kinematics::ToolPath path = path_through(std::vector<Vec3>{
      {-70, 0, -5}, {70, 0, -5}, {-70, 0, -5}, {-70, 20, -5}, {70, 20, -5}, {-70, 20, -5}});
  path.blocks[1].spindle = path.blocks[4].spindle = SpindleDirection::off;
  EXPECT_TRUE(find_collisions(cut(path, end_mill(10.0, 20.0))).empty());
  // Without the second slot the way back is closed.
  path.blocks[3].spindle = SpindleDirection::off;
  EXPECT_FALSE(find_collisions(cut(path, end_mill(10.0, 20.0))).empty());
}

TEST(BodyCollision, OfAShankInASlotDeeperThanItsFlutes) {
  EXPECT_TRUE(of_slot({-6.0}, kShank).empty());
  const auto found = of_slot({-9.0}, kShank);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, CollisionKind::body_in_material);
  EXPECT_EQ(found[0].body, CollisionBody::shank);
  EXPECT_EQ(found[0].source_line, 10U);
  EXPECT_EQ(found[0].tool, 1);
  EXPECT_NEAR(found[0].depth, 3.0, 0.03);
}

TEST(BodyCollision, OfABodyThatIsDeepInTheMaterial) {
  for (const double floor : {-9.0, -15.0, -19.0}) {
    const auto shank = of_slot({floor}, kShank), holder = of_slot({floor}, kHolder);
    ASSERT_EQ(shank.size(), 1U) << floor;
    ASSERT_EQ(holder.size(), 1U) << floor;
    // No deeper than it is wide.
    EXPECT_NEAR(shank[0].depth, std::min(-6.0 - floor, 10.0), 0.03);
    EXPECT_NEAR(holder[0].depth, -6.0 - floor, 0.03);
  }
  // Blocks of both kinds that follow each other make one collision.
  const auto path = path_through(
      std::vector<Vec3>{{-70, 0, -9}, {-20, 0, -9}, {20, 0, -15}, {30, 0, -15}, {40, 0, -19}});
  const auto found = find_body_collisions(cut(path, end_mill(10.0, 6.0)), {kShank});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].source_line, 10U);
  EXPECT_EQ(found[0].last_line, 40U);
}

// Nothing is stated but flute_length. The shank begins 6 mm above the tip: 3 mm below the top.
TEST(BodyCollision, Fault2_24_OfAToolThatStatesNoShank) {
  const auto found_in = [](const std::vector<Vec3>& tips, double flutes) {
    return find_collisions(cut(path_through(tips), end_mill(10.0, flutes)));
  };
  const auto found = found_in({{-70, 0, -9}, {70, 0, -9}}, 6.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, CollisionKind::body_in_material);
  EXPECT_EQ(found[0].body, CollisionBody::shank);
  EXPECT_EQ(found[0].source_line, 10U);
  EXPECT_NEAR(found[0].depth, 3.0, 0.03);
  // Deep enough flutes, none stated, and passes that are each no deeper than the flutes.
  EXPECT_TRUE(found_in({{-70, 0, -9}, {70, 0, -9}}, 9.0).empty());
  EXPECT_TRUE(found_in({{-70, 0, -9}, {70, 0, -9}}, 0.0).empty());
  EXPECT_TRUE(
      found_in(
          {{-70, 0, -6}, {70, 0, -6}, {70, 0, -12}, {-70, 0, -12}, {-70, 0, -18}, {70, 0, -18}},
          6.0)
          .empty());
  // A hole: what the flutes have left open is no obstacle.
  EXPECT_TRUE(found_in({{0, 0, 10}, {0, 0, -19}, {0, 0, 10}}, 6.0).empty());
  // The second pass is 0.03 mm beside the first: within the relief of the shank; 0.2 mm are not.
  EXPECT_TRUE(
      found_in({{-70, 0, -6}, {70, 0, -6}, {70, 0.03, -12}, {-70, 0.03, -12}}, 6.0).empty());
  EXPECT_FALSE(found_in({{-70, 0, -6}, {70, 0, -6}, {70, 0.2, -12}, {-70, 0.2, -12}}, 6.0).empty());
}

// In air, then into the block twice, then in the slot that is there.
TEST(CutsAgainstHand, Fault2_30_AreToldOncePerStretch) {
  kinematics::ToolPath path = path_through(std::vector<Vec3>{{-70, 0, 5},
                                                             {-70, 0, -5},
                                                             {0, 0, -5},
                                                             {70, 0, -5},
                                                             {-70, 0, -5},
                                                             {-70, 20, -5},
                                                             {70, 20, -5}});
  const auto all = [&path](SpindleDirection direction) {
    for (auto& block : path.blocks) block.spindle = direction;
  };
  using Blocks = std::vector<std::uint32_t>;
  EXPECT_EQ(cuts_against_hand(cut(path)), Blocks{});
  all(SpindleDirection::off);
  EXPECT_EQ(cuts_against_hand(cut(path)), Blocks{});
  all(SpindleDirection::counterclockwise);
  EXPECT_EQ(cuts_against_hand(cut(path)), Blocks{1});
  path.blocks[4].spindle = SpindleDirection::clockwise;
  EXPECT_EQ(cuts_against_hand(cut(path)), (Blocks{1, 5}));

  cutter::CutterSpec left = end_mill().spec();
  left.hand = cutter::CutterHand::left;
  const auto by_left = [&] { return cuts_against_hand(cut(path, *cutter::Cutter::make(left))); };
  EXPECT_EQ(by_left(), Blocks{});
  all(SpindleDirection::clockwise);
  EXPECT_EQ(by_left(), Blocks{1});
}

// A tap comes back along its axis with the spindle reversed; a drill comes back as it went in.
TEST(CutsAgainstHand, Fault2_30_AreNotThoseOfATap) {
  kinematics::ToolPath path =
      path_through(std::vector<Vec3>{{0, 0, 5}, {0, 0, -5}, {0, 0, -10}, {0, 0, 5}, {9, 0, 5}});
  for (auto& block : path.blocks) block.spindle = SpindleDirection::counterclockwise;
  EXPECT_EQ(cuts_against_hand(cut(path)), std::vector<std::uint32_t>{0});
  path.blocks[2].spindle = SpindleDirection::clockwise;
  EXPECT_TRUE(cuts_against_hand(cut(path)).empty());
  // Reversed after it has left the hole by rapid.
  path.blocks[2].kind = PathKind::rapid;
  EXPECT_EQ(cuts_against_hand(cut(path)), std::vector<std::uint32_t>{0});
}

TEST(BodyCollision, DoesNotCountWhatWasCutBefore_Complaint16) {
  // The second pass is deeper than the flutes, but the shank runs where the first has cut.
  EXPECT_TRUE(of_slot({-6.0, -11.0}, kShank).empty());
  EXPECT_TRUE(of_slot({-6.0, -11.0}, kThinShank).empty());
  // A holder wider than the slot meets its shoulders.
  const auto found = of_slot({-6.0, -11.0}, kHolder);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].body, CollisionBody::holder);
  EXPECT_EQ(found[0].source_line, 30U);
  EXPECT_NEAR(found[0].depth, 5.0, 0.05);
}

TEST(BodyCollision, IsNotUndoneByALaterCut) {
  // What is in the way is removed afterwards: it was in the way all the same.
  const Workpiece part =
      cut(path_through(std::vector<Vec3>{
              {-70, 0, -9}, {70, 0, -9}, {70, 0, 30}, {-70, 0, 30}, {-70, 0, -3}, {70, 0, -3}}),
          end_mill(40.0, 6.0));
  const auto found = find_body_collisions(part, {kShank});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].source_line, 10U);
  EXPECT_NEAR(found[0].depth, 3.0, 0.05);
}

TEST(BodyCollision, OfBlocksThatFollowEachOtherIsOne) {
  std::vector<Vec3> tips;
  for (int i = 0; i <= 14; ++i) tips.emplace_back(-70.0 + 10.0 * i, 0, -9);
  const auto found = find_body_collisions(cut(path_through(tips), end_mill(10.0, 6.0)), {kShank});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].source_line, 20U);
  EXPECT_EQ(found[0].last_line, 130U);
}

TEST(CollisionLaws, GiveTheSameBitsForAnyNumberOfThreads) {
  auto path = random_path(7, 12);
  for (std::size_t i = 0; i < path.blocks.size(); i += 3) path.blocks[i].kind = PathKind::rapid;
  const Workpiece part = cut(path);
  std::vector<Collision> cutter, body;
  for (const std::size_t threads : {1U, 2U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto c = find_cutter_collisions(part);
    const auto b = find_body_collisions(part, {kHolder});
    if (threads == 1) cutter = c, body = b;
    ASSERT_EQ(c.size(), cutter.size());
    ASSERT_EQ(b.size(), body.size());
    for (std::size_t i = 0; i < c.size(); ++i) EXPECT_EQ(c[i].depth, cutter[i].depth);
    for (std::size_t i = 0; i < b.size(); ++i) EXPECT_EQ(b[i].depth, body[i].depth);
  }
  EXPECT_FALSE(cutter.empty());
  EXPECT_FALSE(body.empty());
}

// Whole sweeps tell where single passages need not be asked, and nothing else.
TEST(CollisionLaws, OfLongProgramsAreThoseOfEachPassage) {
  const auto seeds = proof::law_count(8U, 2U);
  std::size_t found = 0;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const auto tool = cutter::Cutter::make({.diameter = {10.0},
                                            .length = {40.0},
                                            .flute_length = {6.0},
                                            .holder = {{20.0, 24.0, 60.0}}});
    ASSERT_TRUE(tool);
    // Small steps all over the box, 250 of them.
    auto poses = random_path(seed, 250).poses;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      poses[i] = {poses[i - 1].tip + 0.1 * (poses[i].tip - poses[i - 1].tip),
                  (poses[i - 1].axis + 0.1 * poses[i].axis).normalized()};
    }
    const Workpiece part = cut(path_through(poses), *tool);
    std::vector<NonCuttingBody> bodies = non_cutting_bodies(part);
    ASSERT_EQ(bodies.size(), 2U);
    const auto fast = find_body_collisions(part, bodies);
    for (NonCuttingBody& body : bodies) body.whole.reset();
    const auto slow = find_body_collisions(part, bodies);
    found += slow.size();
    ASSERT_EQ(fast.size(), slow.size());
    for (std::size_t i = 0; i < fast.size(); ++i) {
      EXPECT_EQ(fast[i].block, slow[i].block);
      EXPECT_EQ(fast[i].last_line, slow[i].last_line);
      EXPECT_EQ(fast[i].depth, slow[i].depth);
    }
  }
  EXPECT_GT(found, 0U);
}

// Each stroke cuts 0.05 mm deeper and comes back in rapid where it has cut; one comes back too low.
TEST(RapidCollision, IsFoundAmongHundredsThatAreNone) {
  constexpr int kStrokes = 200, kBad = 123;
  std::vector<Vec3> tips{{-60, 0, 0}};
  for (int i = 0; i < kStrokes; ++i) {
    const double z = -0.05 * (i + 1);
    const double back = i == kBad ? z - 0.04 : z;
    for (const Vec3& tip :
         {Vec3(-60, 0, z), Vec3(60, 0, z), Vec3(60, 0, back), Vec3(-60, 0, back)}) {
      tips.push_back(tip);
    }
  }
  auto path = path_through(tips);
  for (std::size_t i = 0; i < path.blocks.size(); ++i) {
    if (i % 4 == 0 || i % 4 == 3) path.blocks[i].kind = PathKind::rapid;
  }
  const auto found = find_collisions(cut(path));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].block, 4U * kBad + 3U);
  EXPECT_EQ(found[0].body, CollisionBody::cutter);
  EXPECT_NEAR(found[0].depth, 0.04, 0.002);
}

// A recess of 0.175 mm in the end, or a cove: what touches first is the rim.
TEST(RapidCollision, OfAHollowedCutterIsAsDeepAsItsRim) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  using cutter::CutterType;
  const std::vector<cutter::CutterSpec> specs{
      {.type = CutterType::flat,
       .diameter = {10.0},
       .length = {80.0},
       .flute_length = {20.0},
       .end_angle = {2.0 * kDegree}},
      {.type = CutterType::profile,
       .length = {60.0},
       .rows = {{0, 0, 0}, {4, 0, 0}, {6, 4, -4}, {6, 12, 0}}}};
  for (const cutter::CutterSpec& spec : specs) {
    for (const double depth : {0.05, 0.5, 5.0}) {
      auto path = path_through(std::vector<Vec3>{{-70, 0, -depth}, {70, 0, -depth}});
      path.blocks[0].kind = PathKind::rapid;
      const auto found = find_collisions(cut(path, cutter::Cutter::make(spec).value()));
      ASSERT_EQ(found.size(), 1U) << depth;
      EXPECT_NEAR(found[0].depth, depth, 0.03) << depth;
    }
  }
}

TEST(RapidCollision, IsAsDeepAsTheToolIsTooLow) {
  for (const double depth : {0.011, 0.02, 0.5}) {
    auto path = path_through(std::vector<Vec3>{{-70, 0, -depth}, {70, 0, -depth}});
    path.blocks[0].kind = PathKind::rapid;
    const auto found = find_collisions(cut(path));
    ASSERT_EQ(found.size(), 1U) << depth;
    EXPECT_NEAR(found[0].depth, depth, 1e-6);
  }
  auto path = path_through(std::vector<Vec3>{{-70, 0, -0.009}, {70, 0, -0.009}});
  path.blocks[0].kind = PathKind::rapid;
  EXPECT_TRUE(find_collisions(cut(path)).empty());
}

}  // namespace
}  // namespace frustum::stock
