#include "bench/peers/peer_run.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>
#include <type_traits>

namespace frustum::bench {
namespace {

using Clock = std::chrono::steady_clock;
static_assert(std::is_trivially_copyable_v<PeerRow>, "it is sent through a pipe");

constexpr int kMostRuns = 3;
constexpr double kEnoughSeconds = 2.0;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

// Unanswered, the signal at the limit ends this process. By the clock, others would count.
void limit_cpu(std::optional<double> seconds) {
  rlimit limit{};
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = seconds ? static_cast<rlim_t>(*seconds) + 1 : limit.rlim_max;
  setrlimit(RLIMIT_CPU, &limit);
}

double peak_mebibytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss) / 1024.0;
}

double probe_speed(const PeerScene& scene) {
  const stock::Workpiece part = scene.cut();
  constexpr int kProbes = 10000;
  long met = 0;
  const auto start = Clock::now();
  for (std::uint64_t k = 0; k < kProbes; ++k) {
    met += part.first_surface(scene.probe(k), {0.0, 30.0}) ? 1 : 0;
  }
  return static_cast<double>(met) / seconds_since(start);
}

void make_and_measure(const PeerScene& scene, const RunLimits& limits, const ErrorOptions& options,
                      PeerRow& row) {
  std::optional<stock::SurfaceMesh> mesh;
  double all = 0.0;
  for (int run = 0; run < kMostRuns && all < kEnoughSeconds; ++run) {
    mesh.reset();
    limit_cpu(cpu_seconds() + limits.cpu_seconds);
    const auto start = Clock::now();
    const double cpu = cpu_seconds();
    if (row.what.program == Program::ready) {
      const stock::Workpiece part = scene.cut();
    } else {
      mesh = make_mesh(scene, row.what);
    }
    const double took = seconds_since(start);
    if (run == 0 || took < row.seconds) {
      row.seconds = took;
      row.cpu_seconds = cpu_seconds() - cpu;
    }
    all += took;
    limit_cpu(std::nullopt);
  }
  row.mebibytes = peak_mebibytes();
  if (row.what.program == Program::ready) {
    row.probes_per_second = probe_speed(scene);
    row.error.from_mesh = ErrorMeasure(scene, options).exact_ends();
  } else if (mesh && !mesh->triangles.empty()) {
    row.triangles = static_cast<long>(mesh->triangles.size());
    row.error = ErrorMeasure(scene, options).of(*mesh);
  } else {
    return;
  }
  row.outcome = Outcome::done;
}

}  // namespace

PeerRow run_case(const PeerScene& scene, const PeerCase& what, const RunLimits& limits,
                 const ErrorOptions& options) {
  PeerRow row{.what = what};
  if (!is_built_in(what.program)) {
    row.outcome = Outcome::not_built_in;
    return row;
  }
  int ends[2];
  if (pipe(ends) != 0) return row;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const auto most = static_cast<rlim_t>(limits.gibibytes * 1024.0 * 1024.0 * 1024.0);
    const rlimit memory{most, most};
    setrlimit(RLIMIT_AS, &memory);
    make_and_measure(scene, limits, options, row);
    const bool sent = write(ends[1], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  PeerRow answer;
  const bool came =
      child > 0 && read(ends[0], &answer, sizeof answer) == static_cast<ssize_t>(sizeof answer);
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  if (came) return answer;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    row.outcome = Outcome::too_slow;
    row.cpu_seconds = limits.cpu_seconds;
  }
  return row;
}

}  // namespace frustum::bench
