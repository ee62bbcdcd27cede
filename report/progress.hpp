// Tells whoever waits how far a long piece of work is.
//
// On a terminal: a bar redrawn on one line, once the work has taken longer than a second. In a log:
// a plain line at each quarter, and one at the end. Silent: nothing. Short work stays silent
// everywhere. Several threads may report at once; the share shown never runs backwards.
// Units: shares in [0, 1], seconds. Errors: none; a share outside [0, 1] is clamped.
#pragma once

#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>

namespace frustum::report {

enum class ProgressStyle { silent, log, bar };

class Progress {
 public:
  // Seconds from any fixed instant; never runs backwards.
  using Clock = std::function<double()>;

  // Writes to `out`, which must outlive the progress.
  Progress(std::ostream& out, ProgressStyle style);
  Progress(std::ostream& out, ProgressStyle style, Clock clock);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;
  ~Progress();

  // Starts a step, ending the one before: "cutting", "measuring".
  void begin(std::string step);
  void at(double share);
  // Ends the step; a bar is wiped, so that what follows starts on a clean line.
  void end();

 private:
  void draw(double now);
  void finish();

  std::ostream& out_;
  ProgressStyle style_;
  Clock clock_;
  std::mutex mutex_;
  std::string step_;
  bool is_running_ = false;
  bool is_drawn_ = false;
  double started_ = 0.0;
  double drawn_at_ = 0.0;
  double share_ = 0.0;
  int quarter_ = 0;
};

}  // namespace frustum::report
