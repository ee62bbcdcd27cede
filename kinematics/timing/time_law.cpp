#include "kinematics/timing/time_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustum::kinematics {
namespace {

// Of an axis's acceleration, what bends of the path may take; the rest can still change the speed.
constexpr double kBendShare = 0.7;
// 8192 blocks of 10 um are 80 mm: the braking distance of a fast machine several times over.
constexpr std::size_t kWindow = 8192;
// In seconds of a rapid: far below a picometre.
constexpr double kNoLength = 1e-15;

std::size_t index_of(AxisLetter letter) { return static_cast<std::size_t>(letter); }

const SpeedPhase* phase_at(const TimedSegment& segment, double& t) {
  const SpeedPhase* last = nullptr;
  for (const SpeedPhase& phase : segment.phases) {
    last = &phase;
    if (t < phase.duration) break;
    if (&phase != &segment.phases.back()) t -= phase.duration;
  }
  return last;
}

}  // namespace

double TimedSegment::time_at(double x) const {
  double way = x * length;
  double time = start;
  for (const SpeedPhase& phase : phases) {
    const double part = phase.length();
    if (way < part) return std::min(time + phase.time_of(way), start + duration);
    way -= part;
    time += phase.duration;
  }
  return start + duration;
}

double TimedSegment::share_at(double time) const {
  double t = std::clamp(time - start, 0.0, duration);
  double way = 0.0;
  for (const SpeedPhase& phase : phases) {
    if (t < phase.duration) return std::min((way + phase.length_after(t)) / length, 1.0);
    way += phase.length();
    t -= phase.duration;
  }
  return 1.0;
}

double TimedSegment::speed_at(double time) const {
  double t = std::clamp(time - start, 0.0, duration);
  const SpeedPhase* phase = phase_at(*this, t);
  return phase == nullptr ? 0.0 : std::max(phase->speed_after(std::min(t, phase->duration)), 0.0);
}

TimeLaw::TimeLaw(const Machine& machine, const TimeLawOptions& options)
    : options_(options), average_(options.jerk_time) {
  weight_.fill(1.0);
  velocity_.fill(kNoLimit);
  acceleration_.fill(kNoLimit);
  double slowest = kNoLimit;  // acceleration in h
  for (const Joint& joint : machine.joints()) {
    const std::size_t i = index_of(joint.letter);
    const AxisDynamics& can = joint.dynamics;
    weight_[i] = can.velocity > 0.0 ? can.velocity
                 : joint.rotary()   ? options.rotary_rapid
                                    : options.rapid;
    if (!options.limits) continue;
    if (can.velocity > 0.0) velocity_[i] = can.velocity;
    if (can.acceleration > 0.0) acceleration_[i] = can.acceleration;
    if (options.jerk && can.jerk > 0.0) {
      // Averaged, an acceleration that turns from + to - changes by twice its size in jerk_time.
      acceleration_[i] = std::min(acceleration_[i], 0.5 * can.jerk * options.jerk_time);
      averages_ = true;
    }
    slowest = std::min(slowest, acceleration_[i] / weight_[i]);
    limits_any_ = limits_any_ || velocity_[i] < kNoLimit || acceleration_[i] < kNoLimit;
  }
  if (averages_) least_part_ = slowest * options.jerk_time * options.jerk_time / 24.0;
}

TimeLaw::Piece TimeLaw::piece_of(const AxisPositions& step, const AxisPositions& unevenness,
                                 double length, double least_time) const {
  Piece piece{.length = length, .step_length = length};
  if (least_time > 0.0) piece.feed_speed = length / least_time;
  piece.top.value = piece.feed_speed;
  for (const AxisLetter letter : kAxisLetters) {
    const double pace = (std::abs(step[letter]) + unevenness[letter]) / length;
    if (pace == 0.0) continue;
    const std::size_t i = index_of(letter);
    piece.per_length[letter] = step[letter] / length;
    // A rapid runs at what the axis can do; a feed is slowed by stated limits only.
    const double velocity = least_time > 0.0 ? velocity_[i] : weight_[i];
    piece.top.lower(velocity / pace, letter);
  }
  piece.own_top = piece.top.value;
  return piece;
}

// How fast the axes may go round the bend between two pieces, and what it takes of their
// accelerations.
void TimeLaw::bend(Piece& before, Piece& after, bool corner) const {
  const double beside = 0.5 * (before.step_length + after.step_length);
  after.entry.lower(std::min(before.own_top, after.own_top), std::nullopt);
  std::array<double, 6> jumps{};
  for (const AxisLetter letter : kAxisLetters) {
    const std::size_t i = index_of(letter);
    jumps[i] = std::abs(after.per_length[letter] - before.per_length[letter]);
    if (jumps[i] == 0.0 || acceleration_[i] == kNoLimit) continue;
    const double share = kBendShare * acceleration_[i];
    after.entry.lower(std::sqrt(share * beside / jumps[i]), letter);
    // Two corners may be side by side.
    const double jump = 0.5 * acceleration_[i] * options_.corner_time;
    if (corner) after.entry.lower(jump / jumps[i], letter);
  }
  const double speed = after.entry.value;
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    const double taken = jumps[i] * speed * speed / beside;
    before.bends[i] = std::max(before.bends[i], taken);
    after.bends[i] = std::max(after.bends[i], taken);
  }
}

// Long steps are cut ever finer towards their ends, where limits of the neighbours may reach in.
std::vector<double> TimeLaw::parts_of(double length) const {
  if (!averages_ || !(least_part_ > 0.0) || 4.0 * least_part_ > length) return {length};
  std::vector<double> from_end;
  double covered = 0.0;
  for (double part = least_part_; covered + part < 0.5 * length; part *= 2.0) {
    from_end.push_back(part);
    covered += part;
  }
  std::vector<double> parts = from_end;
  parts.push_back(length - 2.0 * covered);
  parts.insert(parts.end(), from_end.rbegin(), from_end.rend());
  return parts;
}

bool TimeLaw::add(const AxisPositions& step, const AxisPositions& unevenness, double least_time,
                  bool corner) {
  double sum = 0.0;
  for (const AxisLetter letter : kAxisLetters) {
    const double part = step[letter] / weight_[index_of(letter)];
    sum += part * part;
  }
  const double length = std::sqrt(sum);
  if (length < kNoLength) return false;
  Piece piece = piece_of(step, unevenness, length, least_time);
  if (window_.empty()) {
    piece.entry.value = 0.0;
  } else {
    bend(window_.back(), piece, corner);
  }
  const std::vector<double> parts = parts_of(length);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    piece.length = parts[k];
    piece.begins_step = k == 0;
    piece.ends_step = k + 1 == parts.size();
    if (k == 1) {
      piece.entry = {};
      piece.bends = {};
    }
    window_.push_back(piece);
  }
  if (!limits_any_) {
    plan(window_.size());
  } else if (window_.size() >= kWindow) {
    plan(kWindow / 2);
  }
  return true;
}

void TimeLaw::bound_accelerations() {
  for (Piece& piece : window_) {
    if (piece.widened) continue;
    for (const AxisLetter letter : kAxisLetters) {
      const double slope = std::abs(piece.per_length[letter]);
      const std::size_t i = index_of(letter);
      if (slope == 0.0 || acceleration_[i] == kNoLimit) continue;
      piece.acceleration.lower((acceleration_[i] - piece.bends[i]) / slope, letter);
    }
  }
}

// The average at a place looks at all that the axes pass within jerk_time, so a limit must hold
// there too: from the place, speed x time / 2, and what the averaged and the plain motion are
// apart.
void TimeLaw::widen(std::size_t from, double speed, const Cap& acceleration, bool backwards) {
  const double time = options_.jerk_time;
  double reach = speed * 0.5 * time;
  if (acceleration.value < kNoLimit) reach += acceleration.value * time * time / 24.0;
  for (std::size_t i = from; reach > 0.0 && i < window_.size(); backwards ? --i : ++i) {
    Piece& piece = window_[i];
    piece.top.lower(speed, acceleration.axis);
    piece.acceleration.lower(acceleration.value, acceleration.axis);
    reach -= piece.length;
  }
}

void TimeLaw::widen_limits(std::size_t known) {
  for (std::size_t i = 0; i < known; ++i) {
    Piece& piece = window_[i];
    if (piece.widened) continue;
    piece.widened = true;
    const Cap acceleration = piece.acceleration;
    widen(i + 1, piece.own_top, acceleration, false);
    widen(i - 1, piece.own_top, acceleration, true);
    if (piece.entry.value >= piece.own_top || piece.entry.value == 0.0) continue;
    // A corner so slow that its neighbourhood would be crept through: come to rest instead.
    if (piece.entry.value < acceleration.value * options_.jerk_time / 12.0) {
      piece.entry.value = 0.0;
      piece.halts = true;
      continue;
    }
    Cap by = acceleration;
    by.axis = piece.entry.axis;
    widen(i, piece.entry.value, by, false);
    widen(i - 1, piece.entry.value, by, true);
  }
}

// Plans the window and lets its first `release` pieces go.
void TimeLaw::plan(std::size_t release) {
  bound_accelerations();
  const std::size_t n = window_.size();
  // What the last piece bends into is not known yet, unless the axes come to rest after it.
  if (averages_) widen_limits(release == n ? n : n - 1);
  const double entered = n > 0 ? window_.front().entry_speed : 0.0;
  double exit = limits_any_ ? 0.0 : kNoLimit;
  for (std::size_t i = n; i-- > 0;) {
    Piece& piece = window_[i];
    exit = std::min(exit, piece.top.value);
    const double reachable = std::sqrt(exit * exit + 2.0 * piece.acceleration.value * piece.length);
    piece.entry_speed = std::min({piece.entry.value, piece.top.value, reachable});
    exit = piece.entry_speed;
  }
  if (n > 0) window_.front().entry_speed = entered;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Piece& piece = window_[i];
    const double reachable = std::sqrt(piece.entry_speed * piece.entry_speed +
                                       2.0 * piece.acceleration.value * piece.length);
    window_[i + 1].entry_speed = std::min(window_[i + 1].entry_speed, reachable);
  }
  for (std::size_t i = 0; i < release; ++i) {
    emit(window_.front(), window_.size() > 1 ? window_[1].entry_speed : 0.0);
    window_.pop_front();
  }
}

void TimeLaw::emit(const Piece& piece, double exit_speed) {
  if (piece.halts) come_to_rest();
  if (piece.begins_step) {
    Open open{.feed_time = piece.step_length / piece.feed_speed};
    open.segment.start = now_;
    open.segment.length = piece.step_length;
    open.segment.per_length = piece.per_length;
    open_.push_back(std::move(open));
  }
  TimedSegment& segment = open_.back().segment;
  const bool top_binds = piece.top.axis.has_value();
  if (!segment.limited_by || top_binds) {
    segment.limited_by = top_binds                                ? piece.top.axis
                         : piece.entry_speed >= piece.entry.value ? piece.entry.axis
                                                                  : piece.acceleration.axis;
    if (!segment.limited_by) segment.limited_by = piece.acceleration.axis;
  }
  for (const SpeedPhase& phase : trapezoid(piece.length, piece.entry_speed, exit_speed,
                                           piece.top.value, piece.acceleration.value)) {
    if (averages_) {
      average_.add(phase);
    } else {
      collect(phase);
    }
  }
  if (!averages_) {
    if (piece.ends_step) close();
    return;
  }
  while (const auto phase = average_.next()) collect(*phase);
}

// Phases of the average run over the ends of segments.
void TimeLaw::collect(const SpeedPhase& phase) {
  SpeedPhase rest = phase;
  while (averages_ && open_.size() > 1) {
    Open& open = open_.front();
    const double missing = open.segment.length - open.covered;
    if (rest.length() < missing) break;
    SpeedPhase part = rest;
    part.duration = rest.time_of(missing);
    rest = rest.after(part.duration);
    open.segment.phases.push_back(part);
    now_ += part.duration;
    close();
  }
  if (!open_.empty()) {
    open_.front().segment.phases.push_back(rest);
    open_.front().covered += rest.length();
  }
  now_ += rest.duration;
}

void TimeLaw::close() {
  TimedSegment segment = std::move(open_.front().segment);
  const double feed_time = open_.front().feed_time;
  open_.pop_front();
  segment.duration = now_ - segment.start;
  segment.lost = feed_time > 0.0 ? std::max(segment.duration - feed_time, 0.0) : 0.0;
  settled_.push_back(std::move(segment));
  if (!open_.empty()) open_.front().segment.start = now_;
}

void TimeLaw::come_to_rest() {
  if (averages_) {
    average_.rest();
    while (const auto phase = average_.next()) collect(*phase);
  }
  while (!open_.empty()) close();
}

void TimeLaw::rest(double seconds) {
  plan(window_.size());
  come_to_rest();
  now_ += seconds;
}

std::optional<TimedSegment> TimeLaw::next() {
  if (settled_.empty()) return std::nullopt;
  TimedSegment segment = std::move(settled_.front());
  settled_.pop_front();
  return segment;
}

}  // namespace frustum::kinematics
