// The NC front end: blocks a second of text read and run, beside LinuxCNC's rs274 where it is
// installed, and the memory that a file of ten million blocks takes. Both run on one core, of which
// the processor's time counts; rs274 writes its canonical calls to /dev/null, ours go to a sink
// that counts them.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "parser/interpreter.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kBlocks = 200'000;
constexpr std::uint64_t kManyBlocks = 10'000'000;
constexpr double kKibPerMib = 1024.0;

// How a language writes one point of the path: a block number, a position (mm), A and C (deg), a
// feed (mm/min), and the same direction as a vector.
struct Point {
  std::uint64_t number = 0;
  double x = 0.0, y = 0.0, z = 0.0;
  double a = 0.0, c = 0.0;
  double feed = 0.0;
};
struct Language {
  Dialect dialect = Dialect::linuxcnc;
  std::string_view extension;
  std::string_view head;
  void (*block)(fmt::memory_buffer& line, const Point& p);
  std::string_view end;
};

void block_of_words(fmt::memory_buffer& line, const Point& p) {
  fmt::format_to(std::back_inserter(line),
                 "N{} G1 X{:.4f} Y{:.4f} Z{:.4f} A{:.4f} C{:.4f} F{:.1f}\n", p.number, p.x, p.y,
                 p.z, p.a, p.c, p.feed);
}
void block_of_klartext(fmt::memory_buffer& line, const Point& p) {
  fmt::format_to(std::back_inserter(line),
                 "{} L X{:+.4f} Y{:+.4f} Z{:+.4f} A{:+.4f} C{:+.4f} F{:.1f}\n", p.number, p.x, p.y,
                 p.z, p.a, p.c, p.feed);
}
void record_of_cldata(fmt::memory_buffer& line, const Point& p) {
  constexpr double kRadian = 57.29577951308232;
  const double tilt = p.a / kRadian, turn = p.c / kRadian;
  fmt::format_to(std::back_inserter(line), "GOTO/{:.4f},{:.4f},{:.4f},{:.7f},{:.7f},{:.7f}\n", p.x,
                 p.y, p.z, std::sin(tilt) * std::sin(turn), -std::sin(tilt) * std::cos(turn),
                 std::cos(tilt));
}

constexpr std::array kLanguages{
    Language{Dialect::linuxcnc, ".ngc", "G21 G17 G90 G94 G54\nG0 X0 Y0 Z50 A0 C0\n", block_of_words,
             "M2\n"},
    Language{Dialect::fanuc, ".nc", "G21 G17 G90 G94 G54\nG0 X0 Y0 Z50 A0 C0\n", block_of_words,
             "M30\n"},
    Language{Dialect::sinumerik, ".mpf", "G71 G17 G90 G94 G54\nG0 X0 Y0 Z50 A0 C0\n",
             block_of_words, "M30\n"},
    Language{Dialect::heidenhain, ".h", "0 BEGIN PGM BENCH MM\n1 L X+0 Y+0 Z+50 A+0 C+0 FMAX\n",
             block_of_klartext, "9 M30\n10 END PGM BENCH MM\n"},
    Language{Dialect::cldata, ".apt",
             "PARTNO/BENCH\nUNITS/MM\nLOADTL/1\nMULTAX/ON\nFEDRAT/1200,MMPM\n", record_of_cldata,
             "FINI\n"}};

// A five-axis program in a file that goes when this does: blocks such as
// N10 G1 X12.3456 Y-3.4567 Z1.2345 A-12.3456 C123.4567 F1200.
class FiveAxisFile {
 public:
  explicit FiveAxisFile(std::uint64_t blocks, const Language& language = kLanguages.front())
      : path_(fs::temp_directory_path() /
              fmt::format("frustum_nc_bench_{}{}", getpid(), language.extension)) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(path_.c_str(), "wb"),
                                                              std::fclose);
    if (out == nullptr) return;
    fmt::print(out.get(), "{}", language.head);
    fmt::memory_buffer line;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const double turn = 1e-3 * static_cast<double>(i);
      line.clear();
      language.block(line, {i % 100'000, 40.0 * std::cos(turn), 40.0 * std::sin(turn),
                            -20.0 + 5.0 * std::cos(0.1 * turn), -15.0 + 10.0 * std::sin(0.3 * turn),
                            std::fmod(57.0 * turn, 360.0), 1200.0 + 100.0 * std::cos(turn)});
      std::fwrite(line.data(), 1, line.size(), out.get());
    }
    fmt::print(out.get(), "{}", language.end);
  }
  FiveAxisFile(const FiveAxisFile&) = delete;
  FiveAxisFile& operator=(const FiveAxisFile&) = delete;
  ~FiveAxisFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Streams the file; how many blocks ran, 0 after a failure.
std::uint64_t run(const fs::path& file, Dialect dialect) {
  const auto program = open_program(file, dialect);
  if (!program) return 0;
  std::uint64_t motions = 0;
  const auto summary = interpret(*program, [&motions](Motion&& motion) {
    benchmark::DoNotOptimize(motion);
    ++motions;
  });
  return summary && motions > 0 ? summary->blocks : 0;
}

double seconds_of(int whose) {
  rusage used{};
  getrusage(whose, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}
// Of the processor, for this process or for those that it has waited for.
double seconds_of(int whose, const auto& work) {
  const double start = seconds_of(whose);
  work();
  return seconds_of(whose) - start;
}

void five_axis_blocks(benchmark::State& state) {
  const FiveAxisFile file(kBlocks);
  double seconds = 0.0;
  for (auto _ : state) {
    std::uint64_t blocks = 0;
    seconds += seconds_of(RUSAGE_SELF, [&] { blocks = run(file.path(), Dialect::linuxcnc); });
    if (blocks < kBlocks) return state.SkipWithError("the program does not run");
  }
  const auto done = static_cast<double>(kBlocks) * static_cast<double>(state.iterations());
  state.counters["blocks_per_s"] = done / seconds;
  const bool has_peer = std::system("command -v rs274 >/dev/null") == 0;  // NOLINT: one thread
  if (!has_peer) return state.SetLabel("rs274 is not installed: apt-get install linuxcnc-uspace");
  const std::string peer = fmt::format("rs274 -g '{}' >/dev/null 2>&1", file.path().string());
  int failed = 0;
  const double theirs =
      seconds_of(RUSAGE_CHILDREN, [&] { failed = std::system(peer.c_str()); });  // NOLINT
  if (failed != 0) return state.SkipWithError("rs274 does not run the program");
  state.counters["rs274_blocks_per_s"] = static_cast<double>(kBlocks) / theirs;
  state.counters["times_rs274"] = done / seconds * theirs / static_cast<double>(kBlocks);
}
BENCHMARK(five_axis_blocks)->Unit(benchmark::kMillisecond);

// The same path in each language; the argument is its place in kLanguages.
void blocks_of_a_language(benchmark::State& state) {
  const Language& language = kLanguages.at(static_cast<std::size_t>(state.range(0)));
  state.SetLabel(std::string(name_of(language.dialect)));
  const FiveAxisFile file(kBlocks, language);
  for (auto _ : state) {
    if (run(file.path(), language.dialect) < kBlocks) {
      return state.SkipWithError("the program does not run");
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBlocks));
}
BENCHMARK(blocks_of_a_language)
    ->Unit(benchmark::kMillisecond)
    ->DenseRange(0, static_cast<int>(kLanguages.size()) - 1);

// `frustum parse` beside `rs274`, each started as a program, by the shortest of five wall times.
void programs_by_wall_time(benchmark::State& state) {
  const FiveAxisFile file(kBlocks);
  const auto seconds_of_program = [](const std::string& command) {
    const auto start = std::chrono::steady_clock::now();
    if (std::system(command.c_str()) != 0)
      return std::numeric_limits<double>::quiet_NaN();  // NOLINT
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const std::string name = file.path().string();
  const std::string ours = fmt::format("'{}' parse '{}' --quiet", FRUSTUM_PROGRAM, name);
  const std::string peer = fmt::format("rs274 -g '{}' >/dev/null 2>&1", name);
  const bool has_peer = std::system("command -v rs274 >/dev/null") == 0;  // NOLINT: one thread
  double best = std::numeric_limits<double>::infinity();
  double best_of_peer = best;
  for (auto _ : state) {
    best = std::min(best, seconds_of_program(ours));
    if (has_peer) best_of_peer = std::min(best_of_peer, seconds_of_program(peer));
  }
  if (!std::isfinite(best)) return state.SkipWithError("the program does not run");
  state.counters["ours_ms"] = 1e3 * best;
  if (!has_peer) return state.SetLabel("rs274 is not installed: apt-get install linuxcnc-uspace");
  state.counters["rs274_ms"] = 1e3 * best_of_peer;
  state.counters["times_rs274"] = best_of_peer / best;
}
BENCHMARK(programs_by_wall_time)->Unit(benchmark::kMillisecond)->Iterations(5);

// In a process of its own, so that the peak is that of the run.
void memory_of_ten_million_blocks(benchmark::State& state) {
  const FiveAxisFile file(kManyBlocks);
  for (auto _ : state) {
    const pid_t child = fork();
    if (child == 0) std::_Exit(run(file.path(), Dialect::linuxcnc) > kManyBlocks ? 0 : 1);
    int status = 1;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0) {
      return state.SkipWithError("the program does not run");
    }
    state.counters["peak_MiB"] = static_cast<double>(used.ru_maxrss) / kKibPerMib;
  }
}
BENCHMARK(memory_of_ten_million_blocks)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
}  // namespace frustum::parser
