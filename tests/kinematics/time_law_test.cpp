#include "kinematics/timing/time_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "kinematics/timing/servo_lag.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;

// X: 200 mm/s, 1000 mm/s^2; Y: 400 mm/s, 2000 mm/s^2; Z: nothing stated.
Machine machine(const std::string& more_x = "", const std::string& more_y = "") {
  const auto made = Machine::read(
      "name = \"m\"\ntitle = \"m\"\nstructure = \"t-(C)-Z-b-Y-X-w\"\ndatum = [\"X\", \"Y\"]\n"
      "[axis.X]\ntravel = [-4000, 4000]\nvelocity = 200\nacceleration = 1000\n" +
          more_x + "[axis.Y]\ntravel = [-4000, 4000]\nvelocity = 400\nacceleration = 2000\n" +
          more_y + "[axis.Z]\ntravel = [-4000, 4000]\n",
      "m.toml");
  EXPECT_TRUE(made) << to_string(made.error().front());
  return *made;
}

AxisPositions step(double x, double y = 0.0, double z = 0.0) {
  AxisPositions q;
  q[X] = x;
  q[Y] = y;
  q[Z] = z;
  return q;
}

struct Motion {
  std::vector<TimedSegment> segments{};
  std::vector<AxisPositions> starts{};
  double end = 0.0;

  [[nodiscard]] AxisPositions at(double time) const {
    const auto after =
        std::upper_bound(segments.begin(), segments.end(), time,
                         [](double t, const TimedSegment& s) { return t < s.start; });
    const auto k =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - segments.begin() - 1, 0));
    AxisPositions q = starts[k];
    const double way = segments[k].share_at(time) * segments[k].length;
    for (const AxisLetter letter : kAxisLetters) q[letter] += way * segments[k].per_length[letter];
    return q;
  }
};

// Feeds every step at `feed` mm/s (0: rapid); all steps begin a block.
Motion timed(const Machine& on, const TimeLawOptions& options,
             const std::vector<AxisPositions>& steps, double feed, bool corners = true) {
  TimeLaw law(on, options);
  Motion motion;
  AxisPositions q;
  const auto take = [&] {
    while (const auto segment = law.next()) motion.segments.push_back(*segment);
  };
  for (const AxisPositions& s : steps) {
    const double length = std::hypot(s[X], s[Y], s[Z]);
    EXPECT_TRUE(law.add(s, {}, feed > 0.0 ? length / feed : 0.0, corners));
    motion.starts.push_back(q);
    for (const AxisLetter letter : kAxisLetters) q[letter] += s[letter];
    take();
  }
  law.rest(0.0);
  take();
  motion.end = law.now();
  EXPECT_EQ(motion.segments.size(), steps.size());
  return motion;
}

TEST(TimeLaw, TakesTheTimeOfATrapezoid) {
  // 100 mm at 100 mm/s with 1000 mm/s^2: 1 s, and half of 0.1 s at either end.
  const Motion m = timed(machine(), {}, {step(100)}, 100.0);
  EXPECT_NEAR(m.end, 1.1, 1e-12);
  EXPECT_NEAR(m.at(0.1)[X], 5.0, 1e-12);
  EXPECT_NEAR(m.segments[0].time_at(0.5), 0.55, 1e-12);
  EXPECT_EQ(m.segments[0].limited_by, X);
  // 10 mm: the top of the triangle is sqrt(1000 * 10) = 100 mm/s.
  EXPECT_NEAR(timed(machine(), {}, {step(10)}, 1000.0).end, 0.2, 1e-12);
  // Cut into pieces, it is the same motion.
  EXPECT_NEAR(timed(machine(), {}, std::vector(1000, step(0.1)), 100.0).end, 1.1, 1e-9);
}

TEST(TimeLaw, FollowsFromTheFeedAloneWithoutLimits) {
  const Motion m = timed(machine(), {.limits = false}, {step(100), step(0, 50)}, 1000.0);
  EXPECT_NEAR(m.end, 0.15, 1e-12);
  EXPECT_FALSE(m.segments[0].limited_by && m.segments[0].lost > 1e-12);
  // Rapids run at the axes' velocity, and where none is stated at the given one.
  EXPECT_NEAR(timed(machine(), {.limits = false}, {step(100)}, 0.0).end, 0.5, 1e-12);
  EXPECT_NEAR(timed(machine(), {.limits = false, .rapid = 250.0}, {step(0, 0, 100)}, 0.0).end, 0.4,
              1e-12);
}

TEST(TimeLaw, SlowsAFeedThatAnAxisCannotFollowAndNamesIt) {
  const Motion m = timed(machine(), {}, {step(3000, 3000)}, 1000.0);
  // X alone is at its 200 mm/s.
  EXPECT_NEAR(m.end, 3000.0 / 200.0 + 0.2, 1e-9);
  EXPECT_EQ(m.segments[0].limited_by, X);
  EXPECT_NEAR(m.segments[0].lost, m.end - std::hypot(3000.0, 3000.0) / 1000.0, 1e-9);
}

std::vector<AxisPositions> wild(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> turn(-1.5, 1.5), size(-2.5, 1.0);
  std::vector<AxisPositions> steps;
  double direction = 0.0;
  for (int i = 0; i < 60; ++i) {
    direction += turn(random) * (i % 7 == 0 ? 2.0 : 0.2);
    const double length = std::pow(10.0, size(random));
    steps.push_back(step(length * std::cos(direction), length * std::sin(direction)));
  }
  return steps;
}

std::vector<AxisPositions> circle(double radius, int parts) {
  std::vector<AxisPositions> steps;
  const double d = 2.0 * std::numbers::pi / parts;
  for (int i = 0; i < parts; ++i) {
    steps.push_back(step(radius * (std::cos((i + 1) * d) - std::cos(i * d)),
                         radius * (std::sin((i + 1) * d) - std::sin(i * d))));
  }
  return steps;
}

// Largest excess of velocity and acceleration over their limits, from differences over dt. Corners
// may jump by what the acceleration gives in corner_time.
void expect_within_limits(const Motion& m, double corner_time, double velocity_slack = 1e-6) {
  const struct {
    AxisLetter axis;
    double velocity, acceleration;
  } limits[] = {{X, 200.0, 1000.0}, {Y, 400.0, 2000.0}};
  constexpr double kStep = 2e-4;
  std::vector<AxisPositions> positions;
  for (double t = 0.0; t <= m.end; t += kStep) positions.push_back(m.at(t));
  for (const auto& limit : limits) {
    double worst_velocity = 0.0, worst_change = 0.0;
    std::vector<double> velocities;
    for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
      velocities.push_back((positions[i + 1][limit.axis] - positions[i][limit.axis]) / kStep);
      worst_velocity = std::max(worst_velocity, std::abs(velocities.back()));
    }
    // Over 1, 5 and 25 steps of time.
    for (const std::size_t span : {1u, 5u, 25u}) {
      for (std::size_t i = 0; i + span < velocities.size(); ++i) {
        const double allowed =
            limit.acceleration * (static_cast<double>(span + 1) * kStep + corner_time);
        worst_change =
            std::max(worst_change, std::abs(velocities[i + span] - velocities[i]) / allowed);
      }
    }
    EXPECT_LE(worst_velocity, limit.velocity * (1.0 + velocity_slack));
    EXPECT_LE(worst_change, 1.0 + 1e-6) << to_char(limit.axis);
  }
}

TEST(TimeLawLaws, KeepsVelocityAndAccelerationOfEveryAxisAlongWildPaths) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    for (const double feed : {60.0, 1000.0}) {
      const Motion m = timed(machine(), {}, wild(seed), feed);
      expect_within_limits(m, TimeLawOptions{}.corner_time);
      EXPECT_FALSE(HasFailure()) << seed << " at " << feed;
    }
  }
}

TEST(TimeLawLaws, GoesRoundACircleAtTheSpeedThatItsAccelerationAllows) {
  // v^2 / r = 0.7 of X's 1000 mm/s^2 (its share for bends): 83.7 mm/s at 10 mm.
  const Motion m = timed(machine(), {}, circle(10.0, 720), 1000.0, false);
  expect_within_limits(m, 0.0015);
  const double around = 2.0 * std::numbers::pi * 10.0;
  EXPECT_GT(m.end, around / (std::sqrt(0.7 * 2000.0 * 10.0)));
  EXPECT_LT(m.end, around / std::sqrt(0.7 * 1000.0 * 10.0) + 0.2);
}

TEST(TimeLawLaws, DoesNotDependOnHowLongTheProgramIs) {
  // More segments than the window: what comes much later changes nothing.
  std::vector<AxisPositions> path;
  for (int i = 0; i < 20; ++i) {
    for (const AxisPositions& s : circle(50.0, 720)) path.push_back(s);
  }
  const Motion whole = timed(machine(), {}, path, 80.0);
  path.resize(10000);
  const Motion part = timed(machine(), {}, path, 80.0);
  for (std::size_t i = 0; i < 5000; ++i) {
    EXPECT_EQ(whole.segments[i].start, part.segments[i].start);
  }
}

TEST(TimeLawLaws, KeepsTheJerkOfEveryAxisOnStraightWays) {
  const Machine on = machine("jerk = 20000\n", "jerk = 40000\n");
  const TimeLawOptions options{.jerk = true};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(-1.5, 2.0);
  std::vector<AxisPositions> steps;
  for (int i = 0; i < 60; ++i) {
    const double length = std::pow(10.0, size(random));
    steps.push_back(step(0.6 * length, 0.8 * length));
  }
  for (const double feed : {100.0, 1000.0}) {
    const Motion m = timed(on, options, steps, feed);
    expect_within_limits(m, 0.0);
    constexpr double kStep = 1e-3;
    double worst = 0.0;
    for (double t = 0.0; t + 3 * kStep <= m.end; t += kStep) {
      const auto x = [&](int k) { return m.at(t + k * kStep)[X]; };
      worst = std::max(worst, std::abs(x(3) - 3 * x(2) + 3 * x(1) - x(0)) / std::pow(kStep, 3));
    }
    EXPECT_LE(worst, 20000.0 * (1.0 + 1e-4)) << feed;
    EXPECT_NEAR(m.at(m.end)[X], m.starts.back()[X] + steps.back()[X], 1e-9);
  }
}

TEST(TimeLawLaws, KeepsCornersAndVelocitiesWithJerkLimitedSpeed) {
  const Machine on = machine("jerk = 20000\n", "jerk = 40000\n");
  for (unsigned seed = 1; seed <= 6; ++seed) {
    for (const double feed : {60.0, 400.0}) {
      expect_within_limits(timed(on, {.jerk = true}, wild(seed), feed),
                           TimeLawOptions{}.corner_time);
      EXPECT_FALSE(HasFailure()) << seed << " at " << feed;
    }
  }
}

TEST(ServoLag, LagsByVelocityOverGainAndShrinksACircle) {
  const Machine on = machine("servo_gain = 50\n", "servo_gain = 50\n");
  ServoLag ramp(on, {});
  for (int i = 1; i <= 1000; ++i) ramp.follow(step(0.1 * i), 0.001);
  EXPECT_NEAR(100.0 - ramp.actual()[X], 100.0 / 50.0, 1e-9);

  // r w = speed: radius r / sqrt(1 + (w / Kv)^2), behind by atan(w / Kv).
  const double radius = 20.0, w = 5.0, h = 1e-4;
  ServoLag lag(on, step(radius));
  double error = 0.0;
  for (int i = 1; i <= 40000; ++i) {
    const double t = i * h;
    const AxisPositions& q =
        lag.follow(step(radius * std::cos(w * t), radius * std::sin(w * t)), h);
    if (t > 1.0) {
      error =
          std::max(error, std::abs(std::hypot(q[X], q[Y]) - radius / std::hypot(1.0, w / 50.0)));
    }
  }
  EXPECT_LT(error, 1e-6);
}

TEST(ServoLag, MakesAnEllipseAt45DegOfMismatchedGains) {
  // Kx < Ky: X lags further, y = x is passed later: the ellipse is along 45 deg or -45 deg by the
  // sense, with half axes r (1 +- (w / Kx - w / Ky) / 2) to first order.
  const Machine on = machine("servo_gain = 50\n", "servo_gain = 60\n");
  const double radius = 20.0, w = 1.0, h = 1e-4;
  ServoLag lag(on, step(radius));
  double at_45 = 0.0, at_135 = 0.0;
  for (int i = 1; i <= 100000; ++i) {
    const double t = i * h;
    const AxisPositions& q =
        lag.follow(step(radius * std::cos(w * t), radius * std::sin(w * t)), h);
    if (t < 2.0) continue;
    at_45 = std::max(at_45, (q[X] + q[Y]) / std::sqrt(2.0));
    at_135 = std::max(at_135, (q[Y] - q[X]) / std::sqrt(2.0));
  }
  const double half = 0.5 * radius * w * (1.0 / 50.0 - 1.0 / 60.0);
  EXPECT_NEAR(at_45 - at_135, 2.0 * half, 0.02 * half);
}

}  // namespace
}  // namespace frustum::kinematics
