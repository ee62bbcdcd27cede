// Ctrl-C and the end that a scheduler sends, as a question that a loop may ask.
//
// Units: none. Errors: none.
#pragma once

namespace frustum::app {

// While it lives, SIGINT and SIGTERM end nothing; they are remembered. A second SIGINT ends the
// program as usual.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  [[nodiscard]] bool has_come() const;
  // 128 + the signal, as shells report it.
  [[nodiscard]] int exit_code() const;
};

}  // namespace frustum::app
