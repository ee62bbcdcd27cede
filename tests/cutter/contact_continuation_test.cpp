#include "cutter/search/contact_continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::cutter {
namespace {

using kinematics::ToolPath;
using proof::Draw;

constexpr double kSame = 1e-6;  // mm: 1 nm

// How a machine may be wrong: every pose a little elsewhere, neighbours alike.
struct Wrong {
  double shift = 0.0;  // mm
  double turn = 0.0;   // rad
  double waves = 0.0;  // over the path
};

ToolPath made_wrong(ToolPath path, const Wrong& wrong, Draw& draw) {
  const Vec3 shift = draw.direction(), turn = draw.direction();
  const double phase = draw.between(0.0, 2.0 * std::numbers::pi);
  const auto n = static_cast<double>(path.poses.size());
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const double wave =
        std::sin(phase + 2.0 * std::numbers::pi * wrong.waves * static_cast<double>(i) / n);
    ToolPose& pose = path.poses[i];
    pose.tip += wrong.shift * wave * shift;
    pose.axis = (pose.axis + wrong.turn * wave * turn).normalized();
  }
  return path;
}

// Once around a cone in strokes of half a degree, the cutter's flank on it.
ToolPath around_a_cone(double radius, double half_angle) {
  std::vector<ToolPose> poses;
  for (int i = 0; i <= 720; ++i) {
    const double phi = 2.0 * std::numbers::pi * i / 720.0;
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    const Vec3 up = std::cos(half_angle) * Vec3::UnitZ() - std::sin(half_angle) * out;
    poses.push_back({radius * out, up});
  }
  return proof::path_through(poses);
}

// Rows over a wavy floor.
ToolPath over_waves() {
  std::vector<ToolPose> poses;
  for (int row = 0; row < 12; ++row) {
    for (int i = 0; i <= 60; ++i) {
      const double x = row % 2 == 0 ? 0.5 * i : 30.0 - 0.5 * i, y = 1.2 * row;
      const Vec3 axis = Vec3(0.2 * std::sin(0.2 * x), 0.1 * std::cos(0.3 * y), 1.0).normalized();
      poses.push_back({{x, y, std::sin(0.25 * x) * std::cos(0.3 * y)}, axis});
    }
  }
  return proof::path_through(poses);
}

struct Followed {
  int contacts = 0, followed = 0;
  double worst = 0.0;         // mm, normal to the surface
  double worst_normal = 0.0;  // rad
};

// Probes that start inside of the sweep: `start` draws a point and the way out of it.
template <class Start>
Followed follow(const ToolPath& path, const Cutter& tool, const Wrong& wrong, int probes,
                std::uint64_t seed, const Start& start) {
  const auto nominal = SweptCutter::sweep(path, {{1, tool}});
  Draw draw(seed);
  const ToolPath changed = made_wrong(path, wrong, draw);
  const auto whole = SweptCutter::sweep(changed, {{1, tool}});
  const auto track = ChangedPath::on(*nominal, changed);
  Followed result;
  for (int k = 0; k < probes; ++k) {
    const Ray ray = start(draw);
    const auto contact = nominal->end_of_void(ray, 0.0, 200.0);
    if (!contact) continue;
    ++result.contacts;
    const auto met = track->follow(continuation_of(*nominal, ray, 0.0, *contact));
    if (!met) continue;
    ++result.followed;
    const auto truth = whole->end_of_void(ray, 0.0, 200.0);
    if (!truth) {
      ADD_FAILURE() << "followed what the whole sweep does not cover, probe " << k;
      continue;
    }
    const double along = std::abs(truth->normal.dot(ray.direction));
    const double off = std::abs(met->s - truth->s) * along;
    result.worst = std::max(result.worst, off);
    if (off < kSame) {
      result.worst_normal =
          std::max(result.worst_normal, angle_between(met->normal, truth->normal));
    }
  }
  return result;
}

TEST(RetraceLaws, FlanksAreFollowedAroundACone) {
  constexpr double kRadius = 40.0, kHalfAngle = 15.0 * kRadPerDeg;
  const auto start = [&](Draw& draw) {
    const double phi = draw.between(0.0, 2.0 * std::numbers::pi);
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    const Vec3 up = std::cos(kHalfAngle) * Vec3::UnitZ() - std::sin(kHalfAngle) * out;
    const Vec3 normal = std::cos(kHalfAngle) * out + std::sin(kHalfAngle) * Vec3::UnitZ();
    return Ray{kRadius * out + draw.between(4.0, 20.0) * up, -normal};
  };
  struct Case {
    Wrong wrong;
    int followed;  // at least
  };
  // Moved by more than a tenth of a millimetre, other strokes may come in between.
  for (const Case& c : {Case{{0.0, 0.0, 0.0}, 500}, Case{{0.02, 5e-5, 1.0}, 490},
                        Case{{0.05, 2e-4, 3.0}, 475}, Case{{0.2, 1e-3, 3.0}, 0}}) {
    const Followed result = follow(around_a_cone(kRadius, kHalfAngle),
                                   proof::kind_named("flat").cutter, c.wrong, 500, 1, start);
    EXPECT_EQ(result.contacts, 500);
    EXPECT_GE(result.followed, c.followed) << c.wrong.shift;
    EXPECT_LT(result.worst, kSame) << c.wrong.shift;
    EXPECT_LT(result.worst_normal, 1e-5) << c.wrong.shift;
  }
}

TEST(RetraceLaws, WhatIsFollowedIsWhatTheWholeSweepSays) {
  const auto start = [](Draw& draw) {
    const Vec3 from = draw.point({2, 2, 3}, {28, 11, 4});
    return Ray{from, (draw.direction() - 2.0 * Vec3::UnitZ()).normalized()};
  };
  int followed = 0;
  for (const char* kind : {"ball", "bull", "flat", "lens", "barrel", "taper_ball"}) {
    for (const Wrong& wrong :
         {Wrong{0.003, 1e-5, 1.0}, Wrong{0.05, 1e-4, 2.0}, Wrong{0.5, 5e-3, 9.0}}) {
      const Followed result =
          follow(over_waves(), proof::kind_named(kind).cutter, wrong, 150, 7, start);
      EXPECT_LT(result.worst, kSame) << kind << ' ' << wrong.shift;
      EXPECT_LT(result.worst_normal, 1e-4) << kind << ' ' << wrong.shift;
      followed += result.followed;
    }
  }
  EXPECT_GT(followed, 500);
}

TEST(RetraceLaws, AHigherPassThatComesDownIsNotMissed) {
  // Two passes side by side; on the changed path the second one goes deeper.
  std::vector<ToolPose> poses;
  for (int i = 0; i <= 200; ++i) poses.push_back({{0.1 * i, 0.0, 0.0}, Vec3::UnitZ()});
  for (int i = 0; i <= 200; ++i) poses.push_back({{20.0 - 0.1 * i, 1.0, 0.01}, Vec3::UnitZ()});
  const ToolPath path = proof::path_through(poses);
  const std::map<int, Cutter> tools{{1, proof::kind_named("ball").cutter}};
  const auto nominal = SweptCutter::sweep(path, tools);
  ToolPath changed = path;
  for (std::size_t i = 201; i < changed.poses.size(); ++i) changed.poses[i].tip.z() -= 0.05;
  const auto whole = SweptCutter::sweep(changed, tools);
  const auto track = ChangedPath::on(*nominal, changed);
  ASSERT_TRUE(track);
  int nothing = 0;
  for (int k = 0; k <= 40; ++k) {
    const Ray ray{{7.03, 0.025 * k, 2.0}, -Vec3::UnitZ()};
    const auto contact = nominal->end_of_void(ray, 0.0, 10.0);
    ASSERT_TRUE(contact);
    const auto met = track->follow(continuation_of(*nominal, ray, 0.0, *contact));
    if (!met) {
      ++nothing;
      continue;
    }
    EXPECT_NEAR(met->s, whole->end_of_void(ray, 0.0, 10.0)->s, kSame) << k;
  }
  EXPECT_GT(nothing, 10);
}

Cutter flat_mill(double diameter, double flutes) {
  return *Cutter::make({.type = CutterType::flat,
                        .diameter = {diameter},
                        .length = {flutes},
                        .flute_length = {flutes}});
}

// Followed or not: what is reported is what the changed path leaves.
void expect_the_truth(const Cutter& tool, const std::vector<ToolPose>& before,
                      const std::vector<ToolPose>& after, const Ray& ray, double start) {
  const std::map<int, Cutter> tools{{1, tool}};
  const auto nominal = SweptCutter::sweep(proof::path_through(before), tools);
  const auto whole = SweptCutter::sweep(proof::path_through(after), tools);
  const auto contact = nominal->end_of_void(ray, start, start + 50.0);
  ASSERT_TRUE(contact);
  const auto track = ChangedPath::on(*nominal, proof::path_through(after));
  const auto met = track->follow(continuation_of(*nominal, ray, start, *contact));
  if (!met) return;
  EXPECT_NEAR(met->s, whole->end_of_void(ray, start, start + 50.0)->s, kSame);
}

TEST(RetraceLaws, StrokesOfUnlikeLengthAndTurnAreNotMissed) {
  const Vec3 up = Vec3::UnitZ();
  // The floor of the cutter holds one stroke back, its flank would the next.
  const auto diagonal = [&](double dx) -> std::vector<ToolPose> {
    return {{{0, 0, 0}, up},
            {{-0.01, 0, 1.05}, up},
            {{9.9 + dx, 0, 1.001}, up},
            {{10.1 + dx, 0, 0}, up}};
  };
  expect_the_truth(flat_mill(10, 50), diagonal(0.15), diagonal(0.0),
                   {{0, 0, 6}, Vec3(1, 0, -1).normalized()}, 3.0 * std::sqrt(2.0));
  // Turning about the tip: the tip makes no way at all.
  const auto towards = [](double x, double y) {
    return ToolPose{{-1, 0, 0}, Vec3(x + 1.0, y, 90.0).normalized()};
  };
  const auto turning = [&](double x, double y, double between) -> std::vector<ToolPose> {
    return {towards(-1, 0), towards(-1.02, 0), towards(-1.04, between), towards(x, y)};
  };
  expect_the_truth(flat_mill(2, 100), turning(1.2, -3.4, -0.3), turning(1.2, -2.6, -0.15),
                   {{-1, 0, 90}, Vec3::UnitX()}, 0.2);
  // A short stroke, then a long one that comes back to the wall.
  const auto sagging = [&](double dx) -> std::vector<ToolPose> {
    return {{{-5, 0, 0}, up},
            {{-5.01, 0, 0}, up},
            {{-5.001 + dx, -0.05, 0}, up},
            {{-4.925 + dx, -1.02, 0}, up}};
  };
  expect_the_truth(flat_mill(10, 50), sagging(-0.06), sagging(0.0), {{-4, 0, 5}, Vec3::UnitX()},
                   1.0);
}

TEST(Retrace, HollowedCuttersAreNotFollowed) {
  const ToolPath path = over_waves();
  const auto nominal = SweptCutter::sweep(path, {{1, proof::kind_named("hollow").cutter}});
  const auto track = ChangedPath::on(*nominal, path);
  const Ray ray{{10.0, 6.0, 3.0}, -Vec3::UnitZ()};
  const auto contact = nominal->end_of_void(ray, 0.0, 50.0);
  ASSERT_TRUE(contact);
  EXPECT_FALSE(track->follow(continuation_of(*nominal, ray, 0.0, *contact)));
}

TEST(Retrace, OtherPathsAreRefused) {
  const ToolPath path = over_waves();
  const auto nominal = SweptCutter::sweep(path, {{1, proof::kind_named("ball").cutter}});
  ToolPath shorter = path;
  shorter.poses.pop_back();
  shorter.segments.pop_back();
  EXPECT_FALSE(ChangedPath::on(*nominal, shorter));
  ToolPath otherwise = path;
  otherwise.blocks.front().tool = 2;
  EXPECT_FALSE(ChangedPath::on(*nominal, otherwise));
  EXPECT_TRUE(ChangedPath::on(*nominal, path));
}

}  // namespace
}  // namespace frustum::cutter
