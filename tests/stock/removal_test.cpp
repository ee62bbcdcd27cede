// What each block removes, what is at any state of the program, and how far a surface is from its
// nominal.
#include "stock/solid/removal.hpp"

#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "stock/mesh/deviation.hpp"
#include "tests/stock/milling.hpp"

namespace frustum::stock {
namespace {

using testing::cut;
using testing::end_mill;
using testing::path_through;
using testing::random_path;

Ray random_ray(std::uint32_t seed, std::uint64_t i) {
  const auto draw = [&](std::uint64_t k, double lo, double hi) {
    return lo + (hi - lo) * uniform({.seed = seed}, 8 * i + k);
  };
  const Vec3 through(draw(0, -50, 50), draw(1, -30, 30), draw(2, -12, 0));
  const Vec3 along = Vec3(draw(3, -1, 1), draw(4, -1, 1), draw(5, -1, 1)).normalized();
  return {through - 100.0 * along, along};
}

// Two passes of a slot 10 mm wide, 5 and 8 mm deep, and one beside it that takes 4 mm more.
Workpiece slot() {
  return cut(path_through(std::vector<Vec3>{
      {-60, 0, -5}, {60, 0, -5}, {60, 0, -8}, {-60, 0, -8}, {-60, 4, -8}, {60, 4, -8}}));
}

TEST(Removal, OfASlotIsItsSection) {
  const auto removal = removal_of(slot(), {.pitch = 1.0_mm});
  ASSERT_TRUE(removal);
  ASSERT_EQ(removal->size(), 5U);
  const auto& all = *removal;
  EXPECT_NEAR(all[0].volume, 5000.0, 5e-6);
  EXPECT_NEAR(all[2].volume, 3000.0, 3e-6);
  EXPECT_NEAR(all[4].volume, 3200.0, 3e-6);
  EXPECT_NEAR(all[0].rate, 30000.0, 1e-4);
  for (const std::size_t air : {1U, 3U}) {
    EXPECT_EQ(all[air].volume, 0.0);
    EXPECT_FALSE(all[air].first_contact);
  }
  EXPECT_NEAR(all[0].axial_engagement, 5.0, 1e-8);
  EXPECT_NEAR(*all[0].radial_engagement, 10.0, 1e-2);  // half a cell before the widest place
  EXPECT_NEAR(all[2].axial_engagement, 3.0, 1e-8);
  EXPECT_NEAR(*all[4].radial_engagement, 4.0, 1e-2);
  EXPECT_NEAR(all[0].largest_thickness, 100.0, 1e-9);
  // The rim reaches the box 5 mm after the start, at 12 mm/s.
  EXPECT_NEAR(*all[0].first_contact, 5.0 / 12.0, 0.05 / 12.0);
  EXPECT_GT(*all[0].last_contact, 100.0 / 12.0);
  EXPECT_LT(*all[0].last_contact, 10.0);
}

TEST(Removal, OfAPlungeIsACylinderWithoutASide) {
  const Workpiece part = cut(path_through(std::vector<Vec3>{{0, 0, 10}, {0, 0, -10}}));
  const auto removal = removal_of(part, {.pitch = 0.25_mm});
  ASSERT_TRUE(removal);
  EXPECT_NEAR(removal->front().volume, 250.0 * std::numbers::pi, 4.0);
  EXPECT_NEAR(removal->front().axial_engagement, 10.0, 1e-5);
  EXPECT_FALSE(removal->front().radial_engagement);
  EXPECT_NEAR(*removal->front().first_contact, 5.0, 1e-6);
}

// Of the first block into the box.
BlockRemoval taken_by(const kinematics::ToolPath& path, const cutter::Cutter& tool) {
  const auto removal = removal_of(cut(path, tool), {.pitch = 0.4_mm});
  if (removal) return removal->front();
  ADD_FAILURE();
  return {};
}

TEST(Removal, EngagesNoMoreOfTheCutterThanIsInTheMaterial) {
  const auto stroke = [](const Vec3& from, const Vec3& to) {
    return path_through(std::vector<Vec3>{from, to});
  };
  const cutter::Cutter ball = end_mill(16.0, 30.0, cutter::CutterType::ball);
  const BlockRemoval plunge = taken_by(stroke({0, 0, 5}, {0, 0, -3}), ball);
  EXPECT_NEAR(plunge.axial_engagement, 3.0, 0.01);
  const BlockRemoval ramp = taken_by(stroke({-10, 0, 0}, {10, 0, -5}), end_mill());
  EXPECT_NEAR(ramp.axial_engagement, 5.0, 0.01);
  EXPECT_NEAR(*ramp.radial_engagement, 10.0, 0.01);
  const BlockRemoval level = taken_by(stroke({-60, 0, -2}, {60, 0, -2}), ball);
  EXPECT_NEAR(level.axial_engagement, 2.0, 0.01);
  EXPECT_NEAR(*level.radial_engagement, 2.0 * std::sqrt(8.0 * 8.0 - 6.0 * 6.0), 0.05);
}

TEST(Removal, OfAHollowCutterEndsAndSaysWhenItMeets) {
  const auto hollow = cutter::Cutter::make({.type = cutter::CutterType::flat,
                                            .diameter = {10.0},
                                            .length = {60.0},
                                            .flute_length = {30.0},
                                            .end_angle = 5.0_deg});
  ASSERT_TRUE(hollow);
  const auto path = path_through(std::vector<Vec3>{{-60, 0, -5}, {60, 0, -5}});
  const BlockRemoval slot = taken_by(path, *hollow);
  EXPECT_NEAR(slot.axial_engagement, 5.0, 0.01);
  EXPECT_NEAR(*slot.radial_engagement, 10.0, 0.01);
  EXPECT_NEAR(*slot.first_contact, 5.0 / 12.0, 0.05 / 12.0);
}

TEST(Removal, OfAHelixIsAsWideAsTheCutter) {
  kinematics::ToolPath path;
  constexpr std::uint32_t kSegments = 48;
  for (std::uint32_t i = 0; i <= kSegments; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kSegments;
    path.poses.push_back(
        {{5.0 * std::cos(turn), 5.0 * std::sin(turn), -2.0 * i / kSegments}, Vec3::UnitZ()});
    if (i > 0) path.segments.push_back({i - 1, 0});
  }
  path.blocks.push_back({.source_line = 10, .tool = 1, .feed = 600.0, .duration = 10.0});
  const BlockRemoval helix = taken_by(path, end_mill());
  EXPECT_NEAR(helix.axial_engagement, 2.0, 0.01);
  EXPECT_NEAR(*helix.radial_engagement, 10.0, 0.01);
}

TEST(RemovalLaws, PiecesAlongARayAreWhatEveryBlockTook) {
  constexpr std::uint32_t kBlocks = 12;
  const Workpiece part = cut(random_path(3, kBlocks));
  const Timetable table(part.removed().path());
  int removers = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Ray ray = random_ray(4, i);
    const RaySpan span{0.0, 200.0};
    std::vector<double> taken(kBlocks, 0.0);
    for (const RemovedPiece& r : removed_along(part, table, ray, span)) {
      taken[r.block] += r.piece.length();
      ++removers;
    }
    double before = part.material_along(ray, span, 0).length(), sum = 0.0;
    const double blank = before;
    for (std::uint32_t b = 0; b < kBlocks; ++b) {
      const double after = part.material_along(ray, span, b + 1).length();
      EXPECT_LE(after, before + 1e-9);
      EXPECT_NEAR(taken[b], before - after, 2e-9) << "ray " << i << ", block " << b;
      before = after;
      sum += taken[b];
    }
    EXPECT_NEAR(sum, blank - part.material_along(ray, span).length(), 1e-12 * kBlocks * blank);
  }
  EXPECT_GT(removers, 200);
}

TEST(RemovalLaws, GivesTheSameBitsForAnyNumberOfThreads) {
  const Workpiece part = cut(random_path(5, 8), end_mill(10.0, 30.0, cutter::CutterType::ball));
  std::vector<BlockRemoval> first;
  for (const std::size_t threads : {1U, 2U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto removal = removal_of(part, {.pitch = 2.0_mm});
    ASSERT_TRUE(removal);
    if (first.empty()) first = *removal;
    for (std::size_t b = 0; b < first.size(); ++b) {
      EXPECT_EQ((*removal)[b].volume, first[b].volume);
      EXPECT_EQ((*removal)[b].axial_engagement, first[b].axial_engagement);
      EXPECT_EQ((*removal)[b].first_contact, first[b].first_contact);
    }
  }
}

TEST(Removal, RefusesPitchesThatAreNone) {
  for (const double pitch : {-1.0, std::nan(""), 1e-4}) {
    const auto removal = removal_of(slot(), {.pitch = Mm{pitch}});
    ASSERT_FALSE(removal) << pitch;
    EXPECT_FALSE(removal.error().front().hint.empty());
  }
}

TEST(Moment, OfALineIsAfterItsLastMotion) {
  const Workpiece part = slot();
  const auto& path = part.removed().path();
  EXPECT_EQ(after_line(path, 9)->segments, 0U);
  EXPECT_EQ(after_line(path, 10)->segments, 1U);
  EXPECT_EQ(after_line(path, 29)->source_line, 20U);
  EXPECT_EQ(after_line(path, 1000)->segments, end_of(path).segments);
  EXPECT_FALSE(after_line(path, 0));
  EXPECT_DOUBLE_EQ(after_line(path, 20)->time, 20.0);
}

TEST(Moment, OfATimeIsTheLastThatIsOver) {
  const Workpiece part = slot();
  const auto& path = part.removed().path();
  EXPECT_EQ(at_time(path, 9.99)->segments, 0U);
  EXPECT_EQ(at_time(path, 10.0)->segments, 1U);
  EXPECT_EQ(at_time(path, 1e9)->segments, 5U);
  EXPECT_FALSE(at_time(path, std::nan("")));
  const auto five = equally_spaced(path, 5, end_of(path));
  ASSERT_EQ(five.size(), 5U);
  EXPECT_EQ(five[1].segments, 2U);
  EXPECT_EQ(five.back().segments, 5U);
}

TEST(Moment, ShowsWhatStandsAndWhoMadeIt) {
  const Workpiece part = slot();
  const auto& path = part.removed().path();
  const auto first_met = [](const WorkpieceAt& then) {
    const IntervalSet met = then.material_along({Vec3(0.3, 0.2, 10), -Vec3::UnitZ()}, {0.0, 100.0});
    return met.intervals().front().lo;
  };
  const WorkpieceAt blank(part, start_of(path)), first(part, after_block(path, 0)), last(part);
  EXPECT_DOUBLE_EQ(first_met(blank), 10.0);
  EXPECT_DOUBLE_EQ(first_met(first), 15.0);
  EXPECT_DOUBLE_EQ(first_met(last), 18.0);

  const auto floor = originating_block_of(first, Vec3(0.3, 0.2, -5.0004));
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->source_line, 10U);
  EXPECT_NEAR(floor->distance, 4e-4, 1e-9);
  EXPECT_NEAR(floor->normal.z(), 1.0, 1e-9);
  EXPECT_FALSE(originating_block_of(last, Vec3(0.3, 0.2, -5.0)));
  const auto wall = originating_block_of(last, Vec3(0.3, 9.0, -2.0));
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->block, 4U);
  const auto top = originating_block_of(last, Vec3(20.0, 20.0, 0.0));
  ASSERT_TRUE(top);
  EXPECT_FALSE(top->block);
}

TEST(Deviation, NamesTheBlockThatGougedAndTheOneThatLeftTooMuch) {
  // The floor is wanted at -7.5: line 10 leaves 2.5 mm where line 50 does not come, which gouges by
  // 0.5.
  const Workpiece part =
      cut(path_through(std::vector<Vec3>{{-60, 0, -5}, {60, 0, -5}, {60, 9, -8}, {-60, 9, -8}}));
  auto mesh = extract_surface(part, part.blank().bounds(), Mm{1.0});
  ASSERT_TRUE(mesh);
  compare(*mesh, [](const Vec3& p, const Vec3& n) -> std::optional<double> {
    if (n.z() < 0.99 || p.z() > -1.0) return std::nullopt;
    return p.z() + 7.5;
  });
  const WorstDeviations worst = worst_deviations(WorkpieceAt(part), *mesh);
  ASSERT_TRUE(worst.gouge && worst.excess);
  EXPECT_NEAR(worst.gouge->deviation, -0.5, 1e-6);
  EXPECT_EQ(worst.gouge->source_line, 30U);
  EXPECT_NEAR(worst.excess->deviation, 2.5, 1e-6);
  EXPECT_EQ(worst.excess->source_line, 10U);
}

}  // namespace
}  // namespace frustum::stock
