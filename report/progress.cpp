#include "report/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <string_view>
#include <utility>

namespace frustum::report {
namespace {

constexpr double kSilentSeconds = 1.0;   // work shorter than this says nothing
constexpr double kRedrawSeconds = 0.05;  // twenty redraws a second look smooth
constexpr int kBarCells = 40;

double steady_seconds() {
  using Seconds = std::chrono::duration<double>;
  return Seconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Time left at the pace so far, worth a number once a twentieth of the work is done.
std::string remaining_text(double elapsed, double share) {
  if (share < 0.05) return "";
  return fmt::format(", {:.0f} s left", std::ceil(elapsed * (1.0 - share) / share));
}

}  // namespace

ProgressStyle style_on(const OutputDevice& device) {
  const bool is_plain = device.no_color != nullptr && *device.no_color != '\0';
  const bool can_draw = device.term != nullptr && std::string_view(device.term) != "dumb";
  return device.is_terminal && can_draw && !is_plain ? ProgressStyle::bar : ProgressStyle::log;
}

Progress::Progress(std::ostream& out, ProgressStyle style) : Progress(out, style, steady_seconds) {
  if (style == ProgressStyle::bar) ticker_ = std::thread([this] { tick(); });
}

Progress::Progress(std::ostream& out, ProgressStyle style, Clock clock)
    : out_(out), style_(style), clock_(std::move(clock)) {}

Progress::~Progress() {
  end();
  if (!ticker_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  ending_.notify_one();
  ticker_.join();
}

void Progress::tick() {
  std::unique_lock lock(mutex_);
  while (!is_ending_) {
    ending_.wait_for(lock, std::chrono::milliseconds(100));
    const double now = clock_();
    if (is_running_ && now - started_ > kSilentSeconds) draw(now);
  }
}

void Progress::begin(std::string step) {
  const std::lock_guard lock(mutex_);
  finish();
  step_ = std::move(step);
  is_running_ = true;
  is_drawn_ = false;
  share_ = 0.0;
  quarter_ = 0;
  started_ = clock_();
}

void Progress::rename(std::string step) {
  const std::lock_guard lock(mutex_);
  if (is_running_) step_ = std::move(step);
}

void Progress::at(double share) {
  if (style_ == ProgressStyle::silent || !std::isfinite(share)) return;
  const std::lock_guard lock(mutex_);
  if (!is_running_) return;
  share_ = std::max(share_, std::clamp(share, 0.0, 1.0));
  const double now = clock_();
  if (now - started_ > kSilentSeconds) draw(now);
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  finish();
}

void Progress::draw(double now) {
  if (style_ == ProgressStyle::log) {
    const int quarter = static_cast<int>(share_ * 4.0);
    if (quarter <= quarter_ || quarter >= 4) return;
    quarter_ = quarter;
    out_ << fmt::format("{}: {} %\n", step_, quarter * 25) << std::flush;
    is_drawn_ = true;
    return;
  }
  if (is_drawn_ && now - drawn_at_ < kRedrawSeconds) return;
  const int full = static_cast<int>(share_ * kBarCells);
  if (share_ <= 0.0) {
    out_ << fmt::format("\r\x1b[K{}: {:.0f} s", step_, now - started_) << std::flush;
  } else {
    out_ << fmt::format("\r\x1b[K{} [{}{}] {:3.0f} %{}", step_,
                        std::string(static_cast<std::size_t>(full), '#'),
                        std::string(static_cast<std::size_t>(kBarCells - full), '.'),
                        std::floor(share_ * 100.0), remaining_text(now - started_, share_))
         << std::flush;
  }
  is_drawn_ = true;
  drawn_at_ = now;
}

void Progress::finish() {
  if (!is_running_) return;
  is_running_ = false;
  if (style_ == ProgressStyle::silent) return;
  const double elapsed = clock_() - started_;
  if (style_ == ProgressStyle::bar) {
    if (is_drawn_) out_ << "\r\x1b[K" << std::flush;
  } else if (elapsed > kSilentSeconds) {
    out_ << fmt::format("{}: done in {:.1f} s\n", step_, elapsed) << std::flush;
  }
}

}  // namespace frustum::report
