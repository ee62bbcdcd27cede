// One row of the table: a program cuts a scene in a process of its own, which is then measured.
//
// Units    : mm, s, MiB
// Errors   : a row says so where the program is not there, gave up or was stopped
// Accuracy : the fastest of up to three runs within two seconds; the memory is the peak of the
//            process up to the finished mesh, before anything is measured
#pragma once

#include "bench/peers/peer_programs.hpp"
#include "bench/peers/surface_error.hpp"

namespace frustum::bench {

struct RunLimits {
  double cpu_seconds = 600.0;  // of all threads, for a mesh
  double gibibytes = 12.0;
};

enum class Outcome { done, gave_up, too_slow, not_built_in };

struct PeerRow {
  PeerCase what{};
  Outcome outcome = Outcome::gave_up;
  double seconds = 0.0;      // by the clock
  double cpu_seconds = 0.0;  // of all threads; too_slow: when it was stopped
  double mebibytes = 0.0;
  long triangles = 0;
  double probes_per_second = 0.0;  // Program::ready: one core
  SurfaceError error{};
};

// Call it before this process starts a thread: it forks.
[[nodiscard]] PeerRow run_case(const PeerScene& scene, const PeerCase& what,
                               const RunLimits& limits, const ErrorOptions& options);

}  // namespace frustum::bench
