// Tells whoever waits how far a long piece of work is.
//
// On a terminal: a bar redrawn on one line, or the seconds gone by while none reports a share, once
// the work has taken longer than a second. In a log: a plain line at each quarter, and one at the
// end. Silent: nothing. Short work stays silent
// everywhere. Several threads may report at once; the share shown never runs backwards.
// Units: shares in [0, 1], seconds. Errors: none; a share outside [0, 1] is clamped.
#pragma once

#include <condition_variable>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>

namespace frustum::report {

enum class ProgressStyle { silent, log, bar };

// What is known of the device that is written to.
struct OutputDevice {
  bool is_terminal = false;
  const char* term = nullptr;      // $TERM
  const char* no_color = nullptr;  // $NO_COLOR: nothing but plain text (no-color.org)
};
[[nodiscard]] ProgressStyle style_on(const OutputDevice& device);

class Progress {
 public:
  // Seconds from any fixed instant; never runs backwards.
  using Clock = std::function<double()>;

  // Writes to `out`, which must outlive the progress. Without a clock of its own the bar is redrawn
  // whether work reports its share or not.
  Progress(std::ostream& out, ProgressStyle style);
  Progress(std::ostream& out, ProgressStyle style, Clock clock);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;
  ~Progress();

  // Starts a step, ending the one before: "cutting", "measuring".
  void begin(std::string step);
  // Another text for the step that goes on.
  void rename(std::string step);
  void at(double share);
  // Ends the step; a bar is wiped, so that what follows starts on a clean line.
  void end();

 private:
  void draw(double now);
  void finish();
  void tick();

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
  bool is_ending_ = false;
  std::condition_variable ending_;
  std::thread ticker_;
};

}  // namespace frustum::report
