#include "cutter/search/separating_plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <type_traits>

#include "cutter/search/end_fan.hpp"
#include "cutter/search/pose_tree.hpp"
#include "cutter/search/quad_crossing.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::cutter {
namespace {

using kinematics::ToolPath;
using proof::Draw;

// Many short strokes on a curved way, the axis swaying.
ToolPath swaying(Draw& draw, int strokes) {
  const Vec3 feed = draw.direction(), bend = draw.direction();
  const Vec3 axis = draw.axis(1.0), sway = draw.direction();
  const double length = draw.decades(0.3, 30.0), lean = draw.decades(1e-3, 0.3);
  std::vector<ToolPose> poses;
  for (int i = 0; i <= strokes; ++i) {
    const double x = static_cast<double>(i) / strokes;
    poses.push_back({length * (x * feed + 0.3 * x * x * bend),
                     (axis + lean * std::sin(3.0 * x) * sway).normalized()});
  }
  return proof::path_through(poses);
}

// A body on such a way, and a ray through it where it stands at one of the poses.
struct Swaying {
  Swaying(Draw& draw, const Body& body)
      : path(swaying(draw, 48)),
        tree(path, all_segments(path), body),
        stands(path.poses[static_cast<std::size_t>(draw.below(49))]),
        ray(through(draw, body, stands)) {}

  ToolPath path;
  PoseTree tree;
  ToolPose stands;
  Ray ray;

 private:
  static std::vector<std::uint32_t> all_segments(const ToolPath& path) {
    std::vector<std::uint32_t> all(path.segments.size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  static Ray through(Draw& draw, const Body& body, const ToolPose& stands) {
    const Vec3 origin = stands.tip + draw.between(0.1, 0.9) * body.height() * stands.axis;
    return {origin, draw.direction()};
  }
};

// Of a group and all that is under it.
std::vector<std::uint32_t> segments_under(const PoseTree& tree, std::uint32_t index) {
  const PoseGroup group = tree.group(index);
  if (group.count > 0) {
    const auto leaf = tree.segments().subspan(group.first, group.count);
    return {leaf.begin(), leaf.end()};
  }
  std::vector<std::uint32_t> all;
  for (std::uint32_t k = 0; k < kSiblings; ++k) {
    if (tree.is_free(group.children + k)) continue;
    const std::vector<std::uint32_t> more = segments_under(tree, group.children + k);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

// The farthest that the body covers beyond s = 0 while it moves through a segment, at 17 moments.
double farthest(const Body& body, const SegmentMotion& motion, const Ray& ray) {
  double most = -1e9;
  for (int k = 0; k <= 16; ++k) {
    for (const Profile& part : body.parts()) {
      const auto chord = part.chord(motion.at(k / 16.0), ray);
      if (chord) most = std::max(most, chord->hi);
    }
  }
  return most;
}

// Every group of random paths, and every stroke, against an end that one of its cutters makes.
TEST(EndGuardLaws, NothingIsCoveredBeyondWhatAGuardAllows) {
  int held = 0, bounded = 0, strokes_held = 0;
  for (const proof::Kind& kind : proof::cutter_kinds()) {
    const Body& body = kind.cutter.body();
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      Draw draw(seed);
      const Swaying scene(draw, body);
      const auto& [path, tree, stands, ray] = scene;
      for (std::uint32_t part = 0; part < body.parts().size(); ++part) {
        const auto chord = body.parts()[part].chord(stands, ray);
        if (!chord) continue;
        const SeparatingPlane guard(body, ray, {chord->hi, part, chord->hi_face, stands}, true);
        for (std::uint32_t index = 0; index < kSiblings * tree.quads().size(); ++index) {
          if (tree.is_free(index)) continue;
          const double over =
              guard.overreach(tree.quads()[index / kSiblings]).most[index % kSiblings];
          if (!std::isfinite(over)) continue;
          double most = -1e9;
          for (const std::uint32_t i : segments_under(tree, index)) {
            const SegmentMotion motion(path.from(path.segments[i]), path.to(path.segments[i]),
                                       body.reach());
            const double beyond = farthest(body, motion, ray) - chord->hi;
            most = std::max(most, beyond);
            if (!guard.holds(motion)) continue;
            ++strokes_held;
            EXPECT_LE(beyond, 1e-6) << kind.name << ' ' << seed << " stroke " << i;
          }
          ++bounded;
          if (over <= 0.0) ++held;
          EXPECT_LE(most, std::max(0.0, over) + 1e-6) << kind.name << ' ' << seed;
        }
      }
    }
  }
  EXPECT_GT(bounded, 500);
  EXPECT_GT(held, 100);
  EXPECT_GT(strokes_held, 300);
}

// Fans of planes at the end of one ray, at the ends of rays beside it, of which some are parallel.
TEST(EndFanLaws, NothingIsCoveredBeyondAnEndThatAFanHoldsBack) {
  int held = 0, open = 0;
  for (const proof::Kind& kind : proof::cutter_kinds()) {
    const Body& body = kind.cutter.body();
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      Draw draw(seed);
      const Swaying scene(draw, body);
      const auto& [path, tree, stands, ray] = scene;
      std::vector<std::uint32_t> groups(kSiblings * tree.quads().size());
      std::iota(groups.begin(), groups.end(), 0U);
      std::erase_if(groups, [&](std::uint32_t index) { return tree.is_free(index); });
      const Profile& part = body.parts().front();
      const auto chord = part.chord(stands, ray);
      if (!chord) continue;
      const SeparatingPlane plane(body, ray, {chord->hi, 0, chord->hi_face, stands}, true);
      const EndFan fan(plane, tree.quads(), groups);
      for (int beside = 0; beside < 8; ++beside) {
        const Vec3 place = ray.at(chord->hi) + draw.decades(1e-3, 3.0) * draw.direction();
        const Vec3 direction =
            beside < 4 ? ray.direction : (ray.direction + 0.5 * draw.direction()).normalized();
        const EndFan::Beside at = fan.beside(place, direction);
        std::vector<std::uint8_t> holds((groups.size() + 3) / 4), by_two = holds;
        fan.find_held(at, 0, holds);
        fan.find_held(at, 0, by_two, LaneChoice::two);
        EXPECT_EQ(holds, by_two);
        for (std::size_t i = 0; i < groups.size(); ++i) {
          if ((holds[i / 4] >> i % 4 & 1U) == 0) {
            ++open;
            continue;
          }
          ++held;
          for (const std::uint32_t segment : segments_under(tree, groups[i])) {
            const SegmentMotion motion(path, path.segments[segment], body.reach());
            EXPECT_LE(farthest(body, motion, {place, direction}), -0.5 * kFanMargin)
                << kind.name << ' ' << seed << " group " << groups[i];
          }
        }
      }
    }
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(open, 1000);
}

// Bit for bit, but that zero has no sign.
template <class T>
bool are_same(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0);
  std::array<double, sizeof(T) / sizeof(double)> of_a{}, of_b{};
  std::memcpy(of_a.data(), &a, sizeof(T));
  std::memcpy(of_b.data(), &b, sizeof(T));
  return std::ranges::equal(
      of_a, of_b, [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

// Of all groups and leaves of random paths, at ends that all kinds of cutters make.
TEST(Lanes, TwoAndFourMakeTheSameNumbers) {
  std::size_t quads = 0;
  for (const proof::Kind& kind : proof::cutter_kinds()) {
    const Body& body = kind.cutter.body();
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      Draw draw(seed);
      const Swaying scene(draw, body);
      const auto& [path, tree, stands, ray] = scene;
      const QuadCrossing crossing(ray);
      for (const GroupQuad& quad : tree.quads()) {
        EXPECT_TRUE(are_same(crossing.within(quad, {-9.0, 20.0}),
                             crossing.within(quad, {-9.0, 20.0}, LaneChoice::two)));
      }
      const auto chord = body.parts().front().chord(stands, ray);
      if (!chord) continue;
      const SeparatingPlane plane(body, ray, {chord->hi, 0, chord->hi_face, stands}, true);
      for (const GroupQuad& quad : tree.quads()) {
        ++quads;
        EXPECT_TRUE(are_same(plane.planes(quad), plane.planes(quad, LaneChoice::two)));
        EXPECT_TRUE(
            are_same(plane.overreach(quad, 0.0), plane.overreach(quad, 0.0, LaneChoice::two)));
      }
      for (std::size_t i = 0; i + 4 < path.poses.size(); i += 4) {
        MotionFour motions;
        for (std::size_t k = 0; k < 4; ++k)
          motions.set(k, path.poses[i + k], path.poses[i + k + 1]);
        const DoubleFour rooms = plane.rooms(motions, kSearchTolerance);
        EXPECT_TRUE(are_same(rooms, plane.rooms(motions, kSearchTolerance, LaneChoice::two)));
        for (std::size_t k = 0; k < 4; ++k) {
          const double one = plane.room(path.poses[i + k], path.poses[i + k + 1]);
          if (one == rooms[k]) continue;  // infinite ones, too
          EXPECT_NEAR(one, rooms[k], 1e-11) << kind.name << ' ' << seed;
        }
      }
    }
  }
  EXPECT_GT(quads, 300U);
}

}  // namespace
}  // namespace frustum::cutter
