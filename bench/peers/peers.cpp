// Frustum beside Manifold, CGAL and a plain tri-dexel: time, memory and surface error of the same
// cut, every error measured the same way (surface_error.hpp). make peers runs it;
// docs/performance.md has a table that it printed.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/peer_run.hpp"

namespace {

using namespace frustum;
using namespace frustum::bench;

constexpr double kEqualError = 1e-3;  // mm
constexpr double kExact = 1e-6;       // mm: what our exact engine states

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

// Short programs are cut with fewer settings, so that all takes minutes.
std::vector<PeerCase> cases_of(const PeerScene& scene, int blocks, bool all) {
  std::vector<PeerCase> cases = {{.program = Program::ready}};
  std::vector<double> pitches = {1.0, 0.5};
  if (blocks >= 7200 || all) pitches.insert(pitches.end(), {0.35, 0.25});
  for (const double pitch : pitches) cases.push_back({.program = Program::ours, .pitch = pitch});
  // Slow: every edge of a triangle asks the cut.
  if (all) cases.push_back({.program = Program::ours, .pitch = 1.0, .chord = 0.001});
  for (const double pitch : pitches) cases.push_back({.program = Program::dexel, .pitch = pitch});
  // Half of r (1 - cos(pi / n)) is 0.9 um with 128 facets.
  for (const int facets : {32, 128, 512}) {
    if (scene.is_ball && facets > 128) continue;  // there are facets squared
    if (!all && facets == 512) continue;
    if (all || blocks < 7200 || facets == 128) {
      cases.push_back({.program = Program::manifold, .facets = facets, .by_halves = true});
    }
    if (all || blocks < 7200) cases.push_back({.program = Program::manifold, .facets = facets});
    if (scene.is_ball || facets != 32) continue;
    cases.push_back({.program = Program::manifold,
                     .facets = facets,
                     .facing = Facing::contact,
                     .by_halves = true});
  }
  for (const int facets : {32, 128}) {
    if (facets * blocks > 10'000 && !all) continue;
    if (scene.is_ball) continue;
    cases.push_back({.program = Program::cgal, .facets = facets});
  }
  return cases;
}

std::string row_text(const PeerRow& row) {
  const std::string head =
      fmt::format("| {} | {} |", name_of(row.what.program), setting_of(row.what));
  switch (row.outcome) {
    case Outcome::not_built_in:
      return head + " not in this build | | | | | | | | |\n";
    case Outcome::too_slow:
      return head + fmt::format(" stopped | > {:.0f} | | | | | | | |\n", row.cpu_seconds);
    case Outcome::gave_up:
      return head + " gave up | | | | | | | | |\n";
    case Outcome::done:
      break;
  }
  const SurfaceError& e = row.error;
  const auto um = [](double mm) { return mm * 1e3; };
  if (row.what.program == Program::ready) {
    return head + fmt::format(" {:.3f} | {:.3f} | {:.0f} | none | {:.5f} | {:.5f} | | | |\n",
                              row.seconds, row.cpu_seconds, row.mebibytes, um(e.from_mesh.worst),
                              um(e.from_mesh.rms()));
  }
  return head +
         fmt::format(
             " {:.3f} | {:.3f} | {:.0f} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n",
             row.seconds, row.cpu_seconds, row.mebibytes, row.triangles, um(e.worst_on_faces()),
             um(e.rms_on_faces()), um(e.from_mesh.worst), um(e.from_truth.worst),
             um(e.at_edges.worst));
}

constexpr const char* kHead =
    "| program | setting | time s | CPU s | peak MiB | triangles | faces: worst um | rms um | "
    "mesh to truth um | truth to mesh um | edges: worst um |\n"
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";

// A program, and whether its cutter was turned to where the part is known to touch it.
using Rival = std::pair<Program, Facing>;

// Why a program has no row within the error.
std::string why_none(const std::vector<PeerRow>& rows, const Rival& rival) {
  std::string why;
  for (const PeerRow& row : rows) {
    if (Rival(row.what.program, row.what.facing) != rival) continue;
    if (row.outcome == Outcome::not_built_in) continue;
    if (row.outcome == Outcome::too_slow) {
      return fmt::format("{}: stopped after {:.0f} s of CPU", setting_of(row.what),
                         row.cpu_seconds);
    }
    why = "no setting tried comes within 1 um";
  }
  return why.empty() ? "not run" : why;
}

// Of each program the fastest row within the error.
void print_at_equal_error(const std::vector<PeerRow>& rows) {
  std::map<Rival, const PeerRow*> best;
  for (const PeerRow& row : rows) {
    if (row.outcome != Outcome::done || row.error.worst_on_faces() > kEqualError) continue;
    const PeerRow*& held = best[{row.what.program, row.what.facing}];
    if (!held || row.cpu_seconds < held->cpu_seconds) held = &row;
  }
  print(
      "\nAt equal surface error, no point of a face off by more than 1 um:\n\n"
      "| program | setting | time s | times as long | CPU s | times as much | triangles | faces: "
      "worst um | edges: worst um |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  const PeerRow* ours = best[{Program::ours, Facing::fixed}];
  for (const Rival& rival :
       {Rival(Program::ours, Facing::fixed), Rival(Program::dexel, Facing::fixed),
        Rival(Program::manifold, Facing::fixed), Rival(Program::manifold, Facing::contact),
        Rival(Program::cgal, Facing::fixed)}) {
    const PeerRow* row = best[rival];
    if (!row) {
      print(fmt::format("| {}{} | {} | | | | | | | |\n", name_of(rival.first),
                        rival.second == Facing::contact ? ", contact known" : "",
                        why_none(rows, rival)));
      continue;
    }
    const auto ratio = [&](double PeerRow::*of) {
      return ours ? fmt::format("{:.1f}", row->*of / (ours->*of)) : std::string();
    };
    print(fmt::format("| {} | {} | {:.3f} | {} | {:.3f} | {} | {} | {:.3f} | {:.3f} |\n",
                      name_of(rival.first), setting_of(row->what), row->seconds,
                      ratio(&PeerRow::seconds), row->cpu_seconds, ratio(&PeerRow::cpu_seconds),
                      row->triangles, row->error.worst_on_faces() * 1e3,
                      row->error.at_edges.worst * 1e3));
  }
}

// A measure that sees nothing would praise everybody: what pushes a mesh by 1 um must be seen.
bool measure_sees_a_micrometre(const RunLimits& limits, const ErrorOptions& options) {
  const PeerScene scene = cone_scene(720);
  PeerCase each{.program = Program::ours, .pitch = 0.5};
  const PeerRow as_made = run_case(scene, each, limits, options);
  each.pushed = 0.001;
  const PeerRow pushed = run_case(scene, each, limits, options);
  const double shift = pushed.error.from_mesh.mean() - as_made.error.from_mesh.mean();
  print(fmt::format(
      "Check of the measure: a mesh pushed out by 1 um is {:.3f} um farther out on average "
      "(worst {:.3f} -> {:.3f} um).\n",
      shift * 1e3, as_made.error.worst_on_faces() * 1e3, pushed.error.worst_on_faces() * 1e3));
  return std::abs(shift - 0.001) < 5e-5 && pushed.error.worst_on_faces() > 0.001;
}

bool compare_programs(const PeerScene& scene, int blocks, bool all, const std::string& only,
                      const RunLimits& limits, const ErrorOptions& options) {
  print(fmt::format("\n### {}, {} blocks\n\n{}", scene.name, scene.path.segments.size(), kHead));
  std::vector<PeerRow> rows;
  for (const PeerCase& each : cases_of(scene, blocks, all)) {
    if (!only.empty() && std::string(name_of(each.program)).find(only) == std::string::npos) {
      continue;
    }
    rows.push_back(run_case(scene, each, limits, options));
    print(row_text(rows.back()));
  }
  print_at_equal_error(rows);
  bool exact = true;
  for (const PeerRow& row : rows) {
    if (row.what.program != Program::ready) continue;
    exact = row.outcome == Outcome::done && row.error.from_mesh.worst < kExact;
    print(fmt::format(
        "\nReady to probe in {:.3f} s, without a mesh: then {:.0f} probes a second on one core, "
        "{} ends on random lines at most {:.5f} um from standing cutters.\n",
        row.seconds, row.probes_per_second, row.error.from_mesh.points,
        row.error.from_mesh.worst * 1e3));
  }
  return exact;
}

constexpr const char* kUsage =
    "frustum_peers [--blocks 72|720|7200] [--scene cone|freeform|both] [--only PROGRAM] [--all]\n"
    "              [--limit CPU_SECONDS] [--memory GIB] [--lines N] [--vertices N]\n"
    "--all: also what takes many minutes\n";

struct Wish {
  int blocks = 7200;  // of the longest program
  bool all = false;
  std::string scene = "cone";
  std::string only{};
  RunLimits limits{};
  ErrorOptions options{};
};

std::optional<Wish> wish_of(const std::vector<std::string>& words) {
  Wish wish;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--all") {
      wish.all = true;
      continue;
    }
    if (i + 1 == words.size()) return std::nullopt;
    const std::string& name = words[i];
    const std::string& value = words[++i];
    if (name == "--scene") {
      wish.scene = value;
    } else if (name == "--only") {
      wish.only = value;
    } else {
      const double number = std::atof(value.c_str());
      if (!(number >= 1.0 && number < 1e9)) return std::nullopt;
      if (name == "--blocks") {
        wish.blocks = static_cast<int>(number);
      } else if (name == "--limit") {
        wish.limits.cpu_seconds = number;
      } else if (name == "--memory") {
        wish.limits.gibibytes = number;
      } else if (name == "--lines") {
        wish.options.lines = static_cast<int>(number);
      } else if (name == "--vertices") {
        wish.options.vertices = static_cast<int>(number);
      } else {
        return std::nullopt;
      }
    }
  }
  return wish;
}

}  // namespace

int main(int count, char** words) {
  const std::optional<Wish> wish = wish_of({words + 1, words + count});
  if (!wish) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  const auto& [blocks, all, scene, only, limits, options] = *wish;

#ifdef FRUSTUM_PEERS_MANIFOLD
  print("Manifold " FRUSTUM_PEERS_MANIFOLD);
#else
  print("Without Manifold");
#endif
#ifdef FRUSTUM_PEERS_CGAL
  print(", CGAL " FRUSTUM_PEERS_CGAL);
#endif
  print(
      fmt::format(", {} cores. Random lines: {}.\n", sysconf(_SC_NPROCESSORS_ONLN), options.lines));
#ifndef FRUSTUM_PEERS_MANIFOLD
  print(
      "Manifold is not in Debian 12. With it:\n"
      "  git clone --branch v3.5.2 https://github.com/elalish/manifold\n"
      "  cmake -S manifold -B manifold/build -DCMAKE_BUILD_TYPE=Release -DMANIFOLD_PAR=ON \\\n"
      "    -DMANIFOLD_TEST=OFF -DMANIFOLD_CROSS_SECTION=OFF -DMANIFOLD_CBIND=OFF \\\n"
      "    -DMANIFOLD_DOWNLOADS=OFF -DCMAKE_INSTALL_PREFIX=$HOME/manifold\n"
      "  cmake --build manifold/build --target install\n"
      "  make peers MANIFOLD=$HOME/manifold\n");
#endif
  bool sound = measure_sees_a_micrometre(limits, options);
  for (const char* name : {"cone", "freeform"}) {
    if (scene != name && scene != "both") continue;
    for (int n = name[0] == 'c' ? 72 : 720; n <= blocks; n *= 10) {
      const PeerScene cut = name[0] == 'c' ? cone_scene(n) : freeform_scene(n);
      sound = compare_programs(cut, n, all, only, limits, options) && sound;
    }
  }
  if (!sound) print("\nThe measure itself is wrong: see above.\n");
  return sound ? 0 : 1;
}
