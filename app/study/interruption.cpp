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

struct sigaction replaced(int signal) {
  struct sigaction ours {
  }, before{};
  ours.sa_handler = frustum_remember_signal;
  ::sigaction(signal, &ours, &before);
  return before;
}

}  // namespace

Interruption::Interruption() {
  came = 0;
  before_interrupt_ = replaced(SIGINT);
  before_end_ = replaced(SIGTERM);
}

Interruption::~Interruption() {
  ::sigaction(SIGINT, &before_interrupt_, nullptr);
  ::sigaction(SIGTERM, &before_end_, nullptr);
}

bool Interruption::has_come() const { return came != 0; }
int Interruption::exit_code() const { return 128 + static_cast<int>(came); }

}  // namespace frustum::app
