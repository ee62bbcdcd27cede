// When the axes are where: feed, velocity, acceleration and jerk limits over a look-ahead.
//
// Model    : the commanded motion is a polyline of axis positions; its length h weighs every axis
//            by its rapid velocity, so that one speed v = dh/dt is continuous over all blocks. Each
//            segment has a top speed (feed; velocity of its axes), each corner between segments a
//            speed at which no axis velocity jumps by more than 0.7 of its acceleration times the
//            time that the bend takes (that of the half segments beside it), nor between blocks by
//            more than half of what it gives in corner_time; the rest of the acceleration may
//            change v. So an axis changes its velocity within any time dt by at most acceleration x
//            (dt + corner_time). A backward and a forward pass then give the fastest trapezoidal
//            profile. With `jerk` accelerations are held down to jerk x jerk_time / 2, v(t) is
//            averaged over jerk_time, and each limit is kept over all that the average looks at
// Units    : mm, rad, s
// Shape    : streamed through a window of 8192 segments, the end of which is taken as standstill
// Errors   : none
// Accuracy : limits hold on differences of the axis positions (tests/kinematics/time_law_test.cpp)
// Source   : backward and forward pass over a velocity limit curve: Bobrow, Dubowsky, Gibson 1985
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "kinematics/model/axes.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/timing/speed_phases.hpp"

namespace frustum::kinematics {

struct TimeLawOptions {
  bool limits = true;          // false: times follow from the feed alone
  bool jerk = false;           // limit the jerk of axes that state one
  double corner_time = 0.005;  // s, in which an axis takes up its velocity jump at a corner
  double jerk_time = 0.04;     // s, over which the speed is averaged
  double rapid = 500.0;        // mm/s: of linear axes that state no velocity
  double rotary_rapid = 3.0;   // rad/s: of rotary axes that state no velocity
};

// A straight piece of the commanded motion with its times.
struct TimedSegment {
  double start = 0.0;                      // s since the beginning
  double duration = 0.0;                   // s
  double length = 0.0;                     // h
  AxisPositions per_length{};              // change of the axes per unit of h
  double lost = 0.0;                       // s: what it takes longer than its feed asks for
  std::optional<AxisLetter> limited_by{};  // the axis that cost that time
  std::vector<SpeedPhase> phases{};

  // When the share x in [0, 1] of the segment is reached.
  [[nodiscard]] double time_at(double x) const;
  // The share reached at a time, and dh/dt there.
  [[nodiscard]] double share_at(double time) const;
  [[nodiscard]] double speed_at(double time) const;
};

class TimeLaw {
 public:
  TimeLaw(const Machine& machine, const TimeLawOptions& options);

  // False: no axis states a limit that could slow a feed.
  [[nodiscard]] bool limits_any() const { return limits_any_; }

  // The axes go on by `step`, in no less than `least_time` (0: a rapid); `unevenness`: what every
  // axis would go further at its fastest pace within the step. `corner`: a new block begins.
  // Returns false for a step without length, which takes no time and gives no segment.
  bool add(const AxisPositions& step, const AxisPositions& unevenness, double least_time,
           bool corner);
  // The axes come to rest and wait.
  void rest(double seconds);

  // The next segment whose times are settled, in the order of add(); after rest() all are.
  [[nodiscard]] std::optional<TimedSegment> next();
  // After rest(): the end of the wait, s.
  [[nodiscard]] double now() const { return now_; }

 private:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  struct Cap {
    double value = kNoLimit;
    std::optional<AxisLetter> axis{};
    void lower(double other, std::optional<AxisLetter> by) {
      if (other < value) *this = {other, by};
    }
  };
  // A step, or a part of one: long steps are cut where limits reach into them from their ends.
  struct Piece {
    AxisPositions per_length{};
    double length = 0.0;
    double step_length = 0.0;
    double feed_speed = kNoLimit;
    Cap top{};    // speed all along, with what its neighbourhood asks for
    Cap entry{};  // speed at its beginning
    Cap acceleration{};
    std::array<double, 6> bends{};  // acceleration that the bends at its ends take, by axis
    double own_top = 0.0;           // without its neighbourhood
    double entry_speed = 0.0;       // as planned
    bool begins_step = true;
    bool ends_step = true;
    bool halts = false;    // the axes come to rest at its beginning
    bool widened = false;  // its limits have been laid over its neighbourhood
  };
  // A segment whose phases are being collected.
  struct Open {
    TimedSegment segment{};
    double feed_time = 0.0;
    double covered = 0.0;
  };

  [[nodiscard]] Piece piece_of(const AxisPositions& step, const AxisPositions& unevenness,
                               double length, double least_time) const;
  void bend(Piece& before, Piece& after, bool corner) const;
  [[nodiscard]] std::vector<double> parts_of(double length) const;
  void bound_accelerations();
  void widen_limits(std::size_t known);
  void widen(std::size_t from, double speed, const Cap& acceleration, bool backwards);
  void plan(std::size_t release);
  void emit(const Piece& piece, double exit_speed);
  void collect(const SpeedPhase& phase);
  void close();
  void come_to_rest();

  TimeLawOptions options_;
  std::array<double, 6> weight_{};  // velocity by which an axis counts in h
  std::array<double, 6> velocity_{};
  std::array<double, 6> acceleration_{};
  bool limits_any_ = false;
  bool averages_ = false;
  double least_part_ = 0.0;  // h
  std::deque<Piece> window_{};
  double now_ = 0.0;
  SpeedAverage average_;
  std::deque<Open> open_{};
  std::deque<TimedSegment> settled_{};
};

}  // namespace frustum::kinematics
