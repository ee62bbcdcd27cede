// Cuts that have a formula: every reported end against it, and volumes by rays and by dexels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <vector>

#include "stock/dexel/tri_dexel.hpp"
#include "stock/solid/workpiece.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using cutter::Cutter;
using cutter::CutterType;
using cutter::SweptCutter;
using kinematics::ToolPath;
using kinematics::ToolPose;
using std::numbers::pi;

constexpr double kRelative = 1e-9;

Cutter cutter_of(CutterType type, double diameter, double flutes) {
  return Cutter::make(
             {.type = type, .diameter = {diameter}, .length = {100.0}, .flute_length = {flutes}})
      .value();
}

SweptCutter sweep(const Cutter& cutter, const ToolPath& path) {
  return SweptCutter::sweep(path, {{1, cutter}}).value();
}

ToolPose upright(double x, double y, double z) { return {Vec3(x, y, z), Vec3::UnitZ()}; }

double covered(const SweptCutter& cut, const Ray& ray) {
  return cut.along(ray, {-400, 400}).length();
}

void expect_relative(double found, double exact) {
  EXPECT_NEAR(found, exact, kRelative * std::abs(exact)) << "of " << exact;
}

// Gauss-Legendre with 20 points, over `parts` equal parts of [a, b].
double integral(double a, double b, int parts, const std::function<double(double)>& f) {
  static const auto rule = [] {
    std::array<std::array<double, 2>, 20> all{};
    for (std::size_t i = 0; i < 20; ++i) {
      double x = std::cos(pi * (static_cast<double>(i) + 0.75) / 20.5), slope = 0.0;
      for (int newton = 0; newton < 50; ++newton) {
        double p0 = 1.0, p1 = x;
        for (int k = 2; k <= 20; ++k) {
          const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
          p0 = p1;
          p1 = p2;
        }
        slope = 20.0 * (x * p1 - p0) / (x * x - 1.0);
        x -= p1 / slope;
      }
      all[i] = {x, 2.0 / ((1.0 - x * x) * slope * slope)};
    }
    return all;
  }();
  double sum = 0.0;
  const double half = 0.5 * (b - a) / parts;
  for (int k = 0; k < parts; ++k) {
    const double middle = a + (2 * k + 1) * half;
    for (const auto& [x, weight] : rule) sum += half * weight * f(middle + half * x);
  }
  return sum;
}

TEST(ClosedFormReference, ASlotIsABoxAndTwoHalfCylinders) {
  const double r = 6.0, length = 40.0;
  const SweptCutter slot = sweep(cutter_of(CutterType::flat, 2 * r, 30),
                                 path_through({upright(0, 0, 0), upright(length, 0, 0)}));
  for (const double y : {0.0, 1.0, 3.0, 5.9, 5.9999}) {
    expect_relative(covered(slot, {Vec3(-50, y, 1), Vec3::UnitX()}),
                    length + 2.0 * std::sqrt(r * r - y * y));
    expect_relative(covered(slot, {Vec3(20, y, -50), Vec3::UnitZ()}), 30.0);
  }
  // The section at half height, across: sin substitutes the root at the rim.
  const double area = integral(-pi / 2, pi / 2, 2, [&](double u) {
    return r * std::cos(u) * covered(slot, {Vec3(-50, r * std::sin(u), 15), Vec3::UnitX()});
  });
  expect_relative(area, 2 * r * length + pi * r * r);
}

TEST(ClosedFormReference, APocketIsARoundedBox) {
  // Rows closer than the cutter is wide, then the contour.
  const double r = 5.0, half = 20.0;
  std::vector<ToolPose> poses;
  for (int row = 0; row <= 5; ++row) {
    const double y = -half + 8.0 * row, x = row % 2 == 0 ? -half : half;
    poses.push_back(upright(x, y, 2));
    poses.push_back(upright(-x, y, 2));
  }
  for (const auto& [x, y] :
       {std::pair{half, half}, {-half, half}, {-half, -half}, {half, -half}, {half, half}}) {
    poses.push_back(upright(x, y, 2));
  }
  const SweptCutter pocket = sweep(cutter_of(CutterType::flat, 2 * r, 20), path_through(poses));
  for (const double y : {0.0, 7.0, 19.0, 21.0, 24.0, 24.9}) {
    const double corner = y <= half ? r : std::sqrt(r * r - (y - half) * (y - half));
    expect_relative(covered(pocket, {Vec3(-50, y, 5), Vec3::UnitX()}), 2 * (half + corner));
  }
  const double ends = integral(0.0, pi / 2, 2, [&](double u) {
    return r * std::cos(u) * covered(pocket, {Vec3(-50, half + r * std::sin(u), 5), Vec3::UnitX()});
  });
  const double middle = integral(0.0, half, 1, [&](double y) {
    return covered(pocket, {Vec3(-50, y, 5), Vec3::UnitX()});
  });
  expect_relative(2 * (ends + middle), 4 * half * half + 8 * half * r + pi * r * r);
}

TEST(ClosedFormReference, APlungeIsTheCutterDrawnOutAlongItsAxis) {
  const Vec3 axis = Vec3(0.3, -0.2, 0.9).normalized();
  const Vec3 across = perpendicular_to(axis);
  for (const CutterType type : {CutterType::flat, CutterType::ball}) {
    const double r = 4.0, height = 15.0, depth = 12.5;
    const SweptCutter hole = sweep(cutter_of(type, 2 * r, height),
                                   path_through({{depth * axis, axis}, {Vec3::Zero(), axis}}));
    for (const double off : {0.0, 1.0, 3.9, 3.99999}) {
      const double end = type == CutterType::flat ? 0.0 : r - std::sqrt(r * r - off * off);
      expect_relative(covered(hole, {off * across - 60.0 * axis, axis}), height + depth - end);
    }
    const double round = type == CutterType::flat ? 0.0 : pi * r * r * r / 3.0;
    const double volume = integral(0.0, r, 1, [&](double off) {
      return 2 * pi * off * covered(hole, {off * across - 60.0 * axis, axis});
    });
    EXPECT_NEAR(volume, pi * r * r * (height + depth) - round,
                type == CutterType::flat ? 1e-6 : 0.1);
    const double by_angle = integral(0.0, pi / 2, 1, [&](double u) {
      return 2 * pi * r * std::sin(u) * r * std::cos(u) *
             covered(hole, {r * std::sin(u) * across - 60.0 * axis, axis});
    });
    expect_relative(by_angle, pi * r * r * (height + depth) - round);
  }
}

// A ball on a circle of chords. Where a ray meets a chord's tube perpendicular to it, it is at the
// middle of the chord's sagitta: radius R cos(step/2) there, and R at its ends.
TEST(ClosedFormReference, ABallOnACircleCutsATorus) {
  const double tube = 5.0, ring = 30.0;
  constexpr int kBlocks = 720;
  std::vector<ToolPose> poses;
  for (int i = 0; i <= kBlocks; ++i) {
    const double phi = 2 * pi * i / kBlocks;
    poses.push_back(upright(ring * std::cos(phi), ring * std::sin(phi), -tube));
  }
  poses.back() = poses.front();
  const SweptCutter torus = sweep(cutter_of(CutterType::ball, 2 * tube, 30), path_through(poses));
  for (const double part : {0.0, 0.5}) {
    // At a pose the ball's own meridian; in the middle of a chord that of a cylinder nearer to the
    // centre.
    const double phi = 2 * pi * (100 + part) / kBlocks;
    const double here = part == 0.0 ? ring : ring * std::cos(pi / kBlocks);
    const Vec3 out(std::cos(phi), std::sin(phi), 0);
    for (const double off : {0.0, -2.0, -4.5}) {
      const IntervalSet up =
          torus.along({(here + off) * out - 50.0 * Vec3::UnitZ(), Vec3::UnitZ()}, {0.0, 60.0});
      ASSERT_EQ(up.intervals().size(), 1U);
      if (part == 0.5) {
        expect_relative(up.intervals()[0].lo, 50.0 - std::sqrt(tube * tube - off * off));
      } else {  // the tubes of both chords reach a little farther in than the ball between them
        EXPECT_NEAR(up.intervals()[0].lo, 50.0 - std::sqrt(tube * tube - off * off), 2e-4);
      }
    }
  }
  // Outside, at a pose, the ball stands alone.
  const double phi = 2 * pi * 100 / kBlocks;
  const Vec3 out(std::cos(phi), std::sin(phi), 0);
  for (const double down : {0.0, 2.0, 4.5}) {
    const IntervalSet in = torus.along({100.0 * out - down * Vec3::UnitZ(), -out}, {0.0, 100.0});
    expect_relative(in.intervals()[0].lo, 100.0 - ring - std::sqrt(tube * tube - down * down));
  }
}

// Flank milling: the cutter's side lies against a cone of half angle `half`, point up, and walks
// round it in blocks of equal angle. The tip lies a little below the ground.
ToolPath around_a_cone(double ground_radius, double half, double cutter_radius, int blocks) {
  std::vector<ToolPose> poses;
  for (int i = 0; i <= blocks; ++i) {
    const double phi = 2 * pi * (i % blocks) / blocks;
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    const Vec3 normal = std::cos(half) * out + std::sin(half) * Vec3::UnitZ();
    const Vec3 up = -std::sin(half) * out + std::cos(half) * Vec3::UnitZ();
    poses.push_back({ground_radius * out + cutter_radius * normal - 2.0 * up, up});
  }
  return path_through(poses);
}

TEST(ClosedFormReference, FlankMillingLeavesTheConeAndItsChords) {
  const double ground = 50.0, half = 15.0 * kRadPerDeg, r = 6.0;
  constexpr int kBlocks = 7200;
  const ToolPath path = around_a_cone(ground, half, r, kBlocks);
  const SweptCutter cut = sweep(cutter_of(CutterType::flat, 2 * r, 40), path);
  const double step = 2 * pi / kBlocks;
  double worst = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double z = 0.05 * k + 1.0;
    const double at_pose = step * (18 * k);
    const double cone = ground - z * std::tan(half);
    for (const double part : {0.0, 0.5, 0.3}) {
      const double phi = at_pose + part * step;
      const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
      // From the axis outwards into the cutter, perpendicular to the cone's flank.
      const Vec3 normal = std::cos(half) * out + std::sin(half) * Vec3::UnitZ();
      const Vec3 on_cone = cone * out + z * Vec3::UnitZ();
      const IntervalSet met = cut.along({on_cone - 5.0 * normal, normal}, {0.0, 10.0});
      ASSERT_FALSE(met.empty());
      // Chords run inside the circles of the axis points, which are wider than the cone by r
      // cos(half); inwards of the cone, the end of the block is what stands highest there.
      const double circle = cone + r * std::cos(half);
      const double sagitta = circle * (1.0 - std::cos(step / 2)) * std::cos(half);
      const double deep = 5.0 - met.intervals()[0].lo;  // into the cone
      if (part == 0.5) {
        EXPECT_NEAR(deep, sagitta, 1e-9) << z;
      }
      EXPECT_LT(deep, sagitta + 1e-9) << z << ' ' << part;
      EXPECT_GT(deep, -1e-9) << z << ' ' << part;
      worst = std::max(worst, deep);
    }
  }
  RecordProperty("deepest_chord_nm", fmt::format("{:.3f}", worst * 1e6));
}

TEST(ClosedFormReference, ATiltedEndFaceLeavesAnEllipticTrough) {
  const double r = 6.0;
  for (const double delta : {1e-4, 0.02, 0.3}) {
    const Vec3 axis = rotation_y(delta) * Vec3::UnitZ();
    const SweptCutter cut = sweep(cutter_of(CutterType::flat, 2 * r, 30),
                                  path_through({{Vec3(-60, 0, 0), axis}, {Vec3(60, 0, 0), axis}}));
    for (const double y : {0.0, 2.0, 4.0, 5.5, 5.999}) {
      const IntervalSet up = cut.along({Vec3(0, y, -20), Vec3::UnitZ()}, {0.0, 20.5});
      expect_relative(up.intervals()[0].lo, 20.0 - std::sin(delta) * std::sqrt(r * r - y * y));
    }
  }
}

TEST(ClosedFormReference, TurningAboutTheTipCutsSphereZonesAndPlanes) {
  const double r = 6.0, height = 30.0, turn = 1.0;
  const SweptCutter cut =
      sweep(cutter_of(CutterType::flat, 2 * r, height),
            path_through({upright(0, 0, 0), {Vec3::Zero(), rotation_y(turn) * Vec3::UnitZ()}}));
  // In the plane of the turn the far rim (r, height) runs on a sphere about the tip, between its
  // two ends.
  const double reach = std::hypot(r, height), lag = std::atan(r / height);
  for (const double angle : {lag + 0.01, 0.5, 0.9, turn + lag - 0.01}) {
    const Vec3 out(std::sin(angle), 0.0, std::cos(angle));
    const IntervalSet met = cut.along({Vec3::Zero() + 1e-3 * out, out}, {0.0, 100.0});
    expect_relative(met.intervals().back().hi + 1e-3, reach);
  }
  // Off that plane by y the rim of the top is nearer to the plane's tip: r^2 - y^2 instead of r^2.
  for (const double y : {1.0, 4.0, 5.9}) {
    const double in_plane = std::hypot(std::sqrt(r * r - y * y), height);
    const Vec3 out(std::sin(0.6), 0.0, std::cos(0.6));
    const IntervalSet met = cut.along({y * Vec3::UnitY(), out}, {0.0, 100.0});
    const double top = std::max(in_plane, height);
    expect_relative(met.intervals().back().hi, top);
    // Beside: |y| = r is where the sides lie.
    const IntervalSet beside =
        cut.along({15.0 * out - 20.0 * Vec3::UnitY(), Vec3::UnitY()}, {0, 40});
    expect_relative(beside.length(), 2 * r);
  }
}

// A lattice sum is exact to order 2 where what the rays meet begins at zero depth with a slope, as
// at the rim of a trough that is shallower than the ball's radius; smooth generatrices make it no
// worse. The sides of the blank, along the rays, would hide that at order 1, so what was removed is
// compared.
TEST(ClosedFormReference, TriDexelVolumeConvergesAtSecondOrder) {
  const double r = 5.0, above = 1.0, length = 11.0;
  const auto blank = stock::Blank::make(stock::BoxShape{30, 24, 10}, Vec3::Zero()).value();
  const stock::Workpiece left(blank,
                              sweep(cutter_of(CutterType::ball, 2 * r, 30),
                                    path_through({upright(-length / 2, 0.3, 10 + above - r),
                                                  upright(length / 2, 0.3, 10 + above - r)})));
  const stock::Workpiece uncut(blank, SweptCutter::sweep({}, {}).value());
  const double deep = r - above;
  const double exact =
      length * (r * r * std::acos(above / r) - above * std::sqrt(r * r - above * above)) +
      pi * deep * deep * (3 * r - deep) / 3.0;
  // Errors of a lattice go up and down with its offset: the slope of a long series counts.
  double sx = 0, sy = 0, sxx = 0, sxy = 0, n = 0, last = 0;
  for (double pitch = 2.5; pitch > 0.12; pitch /= 1.12) {
    const auto cut = stock::TriDexel::sample(left, blank.bounds(), Mm{pitch}).value();
    const auto whole = stock::TriDexel::sample(uncut, blank.bounds(), Mm{pitch}).value();
    last = std::abs(whole.volumes()[2] - cut.volumes()[2] - exact);
    const double x = std::log(pitch), y = std::log(last);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double order = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  RecordProperty("order", fmt::format("{:.2f}", order));
  std::cout << fmt::format("order {:.2f}, last error {:.2e} of {:.3f} mm^3\n", order, last, exact);
  EXPECT_GT(order, 1.8);
  EXPECT_LT(last, 1e-4 * exact);
}

}  // namespace
}  // namespace frustum::proof
