// Surfaces of states that follow each other are, bit for bit, those of each state by itself.
#include "stock/mesh/surface_sequence.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cstring>
#include <string>
#include <vector>

#include "stock/dexel/reached_rays.hpp"
#include "tests/law_count.hpp"
#include "tests/stock/mapped_parts.hpp"
#include "tests/stock/random_cuts.hpp"

namespace frustum::stock {
namespace {

using testing::cone;
using testing::hub;
using testing::kFlat;
using testing::kHollow;

template <class T>
bool are_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// Empty, or what differs.
std::string difference(const SurfaceMesh& a, const SurfaceMesh& b) {
  if (a.vertices.size() != b.vertices.size()) return "the number of vertices";
  if (!are_same_bits(a.vertices, b.vertices)) return "vertices";
  if (!are_same_bits(a.normals, b.normals)) return "normals";
  if (!are_same_bits(a.kinds, b.kinds)) return "kinds";
  if (!are_same_bits(a.triangles, b.triangles)) return "triangles";
  return {};
}

ProgramState after(const Workpiece& part, std::uint32_t segments) {
  ProgramState state = end_of(part.removed().path());
  state.segments = segments;
  return state;
}

std::vector<ProgramState> states_of(const Workpiece& part, std::uint32_t count) {
  const auto all = static_cast<std::uint32_t>(part.removed().path().segments.size());
  std::vector<ProgramState> states;
  for (std::uint32_t k = 0; k <= count; ++k) states.push_back(after(part, all * k / count));
  return states;
}

// Of each state by itself and of all in a row. `placed`: the share of vertices placed again.
struct Compared {
  std::string difference{};
  double placed = 0.0;
};
Compared compare(const Workpiece& part, const std::vector<ProgramState>& states, double pitch) {
  SurfaceSequence surfaces(part, Mm{pitch});
  Compared compared;
  std::size_t vertices = 0, placed = 0;
  for (const ProgramState& state : states) {
    const auto mesh = surfaces.at(state);
    const auto anew = extract_surface(WorkpieceAt(part, state), part.blank().bounds(), Mm{pitch});
    if (!mesh || !anew) return {"one that is refused"};
    vertices += surfaces.work().vertices;
    placed += surfaces.work().placed;
    if (std::string found = difference(*mesh, *anew); !found.empty()) {
      compared.difference = found + " after " + std::to_string(state.segments) + " segments";
      return compared;
    }
  }
  compared.placed = static_cast<double>(placed) / static_cast<double>(vertices);
  return compared;
}

TEST(SurfaceSequence, IsBitForBitThatOfEachStateAloneOnTheCone) {
  const Workpiece part = cone(kFlat);
  for (const std::size_t threads : {1U, 2U, 8U}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads);
    const Compared found = compare(part, states_of(part, 6), 1.0);
    EXPECT_EQ(found.difference, "") << threads << " threads";
    EXPECT_LT(found.placed, 0.5) << threads << " threads";
  }
}

TEST(SurfaceSequence, IsBitForBitThatOfEachStateAloneOnTheBladedHub) {
  const Workpiece part = hub();
  const Compared found = compare(part, states_of(part, 6), 2.6);
  EXPECT_EQ(found.difference, "");
  EXPECT_LT(found.placed, 0.6);
}

TEST(SurfaceSequence, IsBitForBitThatOfEachStateAloneForAHollowEndMill) {
  const Workpiece part = cone(kHollow);
  const Compared found = compare(part, states_of(part, 6), 2.5);
  EXPECT_EQ(found.difference, "");
  EXPECT_LT(found.placed, 0.9);
}

TEST(SurfaceSequence, PlacesNothingAgainWhereNothingHasCut) {
  const Workpiece part = cone(kFlat);
  SurfaceSequence surfaces(part, Mm{1.5});
  const auto first = surfaces.at(after(part, 300));
  EXPECT_EQ(surfaces.work().placed, surfaces.work().vertices);
  const auto second = surfaces.at(after(part, 300));
  EXPECT_EQ(surfaces.work().placed, 0U);
  EXPECT_EQ(difference(*first, *second), "");
}

TEST(SurfaceSequence, GoesBackToEarlierStates) {
  const Workpiece part = cone(kFlat);
  const Compared found =
      compare(part, {after(part, 500), after(part, 100), after(part, 300), after(part, 0)}, 1.5);
  EXPECT_EQ(found.difference, "");
}

TEST(SurfaceSequence, RefusesAPitchThatIsNone) {
  const Workpiece part = cone(kFlat);
  EXPECT_FALSE(SurfaceSequence(part, Mm{0.0}).at(after(part, 1)));
}

TEST(SurfaceSequenceLaws, IsBitForBitThatOfEachStateAloneForRandomPrograms) {
  const int programs = proof::law_count(400, 12);
  std::size_t states = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(programs); ++seed) {
    const proof::RandomCut cut = proof::random_cut(seed);
    const auto swept = cutter::SweptCutter::sweep(cut.path, cut.tools);
    ASSERT_TRUE(swept.has_value());
    const Workpiece part(cut.blank, *swept);
    const auto segments = static_cast<std::uint32_t>(cut.path.segments.size());
    const auto all = states_of(part, std::max(segments, 1U));
    EXPECT_EQ(compare(part, all, cut.pitch).difference, "") << "seed " << seed;
    states += all.size();
  }
  EXPECT_GT(states, 20U);
}

TEST(ReachedRays, AreThoseThatMeetABox) {
  const DexelGrid grid = DexelGrid::over({Vec3::Zero(), Vec3(10, 20, 30)}, 1.0);
  const Box box{Vec3(2.2, 3.3, 4.4), Vec3(3.9, 5.1, 8.7)};
  const ReachedRays reached(grid, std::vector<Box>{box});
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    int rays = 0, met = 0;
    for (int j = 0; j < grid.nodes[static_cast<std::size_t>(v)]; ++j) {
      for (int i = 0; i < grid.nodes[static_cast<std::size_t>(u)]; ++i) {
        const Vec3 at = grid.ray(axis, i, j).origin;
        const bool meets = at[u] >= box.min[u] && at[u] <= box.max[u] && at[v] >= box.min[v] &&
                           at[v] <= box.max[v];
        EXPECT_TRUE(!meets || reached.reaches(axis, i, j)) << axis << " " << i << " " << j;
        met += meets ? 1 : 0;
        rays += reached.reaches(axis, i, j) ? 1 : 0;
      }
    }
    EXPECT_GT(met, 0);
    EXPECT_LE(rays, 3 * met);
  }
  EXPECT_TRUE(reached.reaches(Box{Vec3(3, 4, 8.5), Vec3(4, 5, 10)}));
  EXPECT_FALSE(reached.reaches(Box{Vec3(3, 4, 10.5), Vec3(4, 5, 12)}));
  EXPECT_FALSE(reached.reaches(Box{Vec3(100, 4, 5), Vec3(101, 5, 6)}));
  EXPECT_FALSE(
      ReachedRays(grid, std::vector<Box>{{Vec3(2, 3, 40), Vec3(3, 4, 41)}}).reaches(2, 3, 4));
}

}  // namespace
}  // namespace frustum::stock
