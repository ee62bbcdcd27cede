// Ctrl-C and the end that a scheduler sends, as a question that a loop may ask.
//
// Units: none. Errors: none.
#pragma once

#include <csignal>

namespace frustum::app {

// While it lives, SIGINT and SIGTERM end nothing; they are remembered. A second SIGINT ends the
// program. Afterwards they do what they did before.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  [[nodiscard]] bool has_come() const;
  // 128 + the signal, as shells report it.
  [[nodiscard]] int exit_code() const;

 private:
  struct sigaction before_interrupt_ {};
  struct sigaction before_end_ {};
};

}  // namespace frustum::app
