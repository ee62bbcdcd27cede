#include "app/study/interruption.hpp"

#include <csignal>

namespace frustum::app {
namespace {

// Signal handlers reach nothing else.
volatile std::sig_atomic_t came = 0;

extern "C" void frustum_remember_signal(int signal) {
  came = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  came = 0;
  std::signal(SIGINT, frustum_remember_signal);
  std::signal(SIGTERM, frustum_remember_signal);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::has_come() const { return came != 0; }
int Interruption::exit_code() const { return 128 + static_cast<int>(came); }

}  // namespace frustum::app
