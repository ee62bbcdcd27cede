// The job that compensate writes: the original's, but for what cannot stay.
#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

// Every key that docs/how-it-works.md lists, and files in the folder of the job.
constexpr const char* kJob = R"(# A plate
title   = "a plate"            # of aluminium
machine = "three-axis"
program = { file = "part.nc", dialect = "fanuc" }
tools   = "library.toml"
setup   = { origin = [0, 0, 0], tilt = [0, 0, 90] }
blank   = { shape = "box", size = [40, 40, 20], origin = [0, 0, -20] }
tool.1  = { radius_error = "1 um", length_error = "2 um" }
error_draw = { seed = 7, index = 2 }

[offsets]
G54 = [0, 0, 0]
G59 = [1, 2, 3]

[[fixtures]]
name   = "vise"
shape  = "mesh"
file   = "vise.obj"
origin = [0, 0, 0]
tilt   = [0, 0, 0]
[[fixtures]]
name   = "clamp"
shape  = "box"
size   = [5, 5, 5]
origin = [0, -60, 0]

# The machine's
[errors]
file = "machine.errors.toml"
EXX = "linear 10 um"
[errors.EYX]
value = "3 um"

[error_span]
operation = "slot"

[[operation]]
name  = "slot"
kind  = "other"
lines = [6, 7]
makes = ["floor"]

[inspection]
plan = "floor.plan.toml"
decision = "iso14253"
uncertainty = { method = "linear" }
[inspection.cmm]
e0 = "0.5 um"
l_per_um = 600
seed = 4

[report]
part = "Plate"
part_number = "P1"
serial_number = "2"
order = "A7"
operator = "N. N."
date = "2026-11-23"
cmm = "number 5"

[controller]
time_law = false
servo_lag = true

[output]
report = false
mesh_pitch = 3
export = ["part.qif"]

[accuracy]
path_bound = "0.1 um"
)";
constexpr const char* kProgram =
    "G21 G90\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X-40 Y0 Z50\nG1 Z-5 F500\nG1 X40\nG0 Z60\nM5\nM30\n";
constexpr const char* kPlan = R"(title = "floor"
[probe]
ball_diameter = 2
[[feature]]
name = "floor"
kind = "plane"
point = [0, 0, -5]
axis = [0, 0, 1]
strategy = { u = [4, 0, 0], v = [0, 20, 0], columns = 3, rows = 3 }
extent = { u = [6, 0, 0], v = [0, 30, 0] }
[[characteristic]]
name = "flatness"
kind = "flatness"
feature = "floor"
tolerance = "10 um"
)";

// A tetrahedron.
std::string body(double x) {
  const double at[4][3] = {{x, 0, 0}, {x + 5, 0, 0}, {x, 5, 0}, {x, 0, 5}};
  std::ostringstream text;
  for (const auto& v : at) text << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  text << "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  return text.str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Lines of the one that the other does not have.
std::vector<std::string> only_in(const std::string& text, const std::string& other) {
  const std::vector<std::string> lines = lines_of(other);
  const std::multiset<std::string> known(lines.begin(), lines.end());
  std::vector<std::string> rest;
  for (const std::string& line : lines_of(text)) {
    if (!known.contains(line)) rest.push_back(line);
  }
  return rest;
}

class CompensateSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  void write_piece(const std::string& job) const {
    write("piece/job.toml", job);
    write("piece/part.nc", kProgram);
    write("piece/floor.plan.toml", kPlan);
    write("piece/vise.obj", body(20));
    write("piece/library.toml",
          "[tool.1]\ntype = \"flat\"\ndiameter = 10\nlength = 100\nflute_length = 30\n");
    write("piece/machine.errors.toml",
          "title = \"a\"\nmachine = \"three-axis\"\n[errors]\nEZZ = \"1 um\"\n");
  }
};

TEST_F(CompensateSystem, Attack2_1_KeepsEveryDocumentedKeyOfTheJob) {
  const std::string job = kJob;
  write_piece(job);
  const Outcome made = run("compensate piece/job.toml --out made/new");
  ASSERT_EQ(made.exit_code, 0) << made.err << made.out;
  const std::string written = read(folder_ / "made/new/job.toml");
  EXPECT_EQ(
      only_in(job, written),
      (std::vector<std::string>{
          "title   = \"a plate\"            # of aluminium", "tools   = \"library.toml\"",
          "file   = \"vise.obj\"", "file = \"machine.errors.toml\"", "EXX = \"linear 10 um\"",
          "[errors.EYX]", "value = \"3 um\"", "lines = [6, 7]", "plan = \"floor.plan.toml\""}));
  std::vector<std::string> changed = only_in(written, job);
  ASSERT_EQ(changed.size(), 6U) << written;
  EXPECT_TRUE(changed[0].starts_with("# Made by Frustum ")) << changed[0];
  changed.erase(changed.begin());
  EXPECT_EQ(changed[0], "title   = \"a plate, compensated\"            # of aluminium");
  EXPECT_EQ(changed[1], "tools   = \"../../piece/library.toml\"");
  EXPECT_EQ(changed[2], "file   = \"../../piece/vise.obj\"");
  EXPECT_EQ(changed[4], "plan = \"part.plan.toml\"");
  EXPECT_EQ(read(folder_ / "made/new/part.plan.toml"), kPlan);
  const Outcome loaded = run("cmm made/new/job.toml --quiet");
  EXPECT_LE(loaded.exit_code, 1) << loaded.err;
  const Outcome cut = run("run made/new/job.toml --out result --quiet");
  EXPECT_LE(cut.exit_code, 1) << cut.err;
}

// Whoever documents a key adds it above.
TEST_F(CompensateSystem, Attack2_1_TheJobAboveHasEveryDocumentedKey) {
  const std::string page = read(fs::path(FRUSTUM_SOURCE_DIR) / "docs/how-it-works.md");
  const auto from = page.find("## A job file"), to = page.find("\n## ", from);
  ASSERT_NE(from, std::string::npos);
  std::size_t keys = 0;
  for (const std::string& line : lines_of(page.substr(from, to - from))) {
    if (!line.starts_with("| `")) continue;
    // The first column; names begin where a letter does.
    const std::string cell = line.substr(2, line.find(" | ") - 2);
    std::string word;
    for (const char c : cell + ' ') {
      if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' ||
          (!word.empty() && std::isdigit(static_cast<unsigned char>(c)) != 0)) {
        word += c;
        continue;
      }
      if (word.size() > 1) {
        // Keys of tools are those of their type, in the library here.
        const bool of_tool = line.starts_with("| `tool.N");
        EXPECT_TRUE(of_tool || std::string(kJob).find(word) != std::string::npos) << word;
        ++keys;
      }
      word.clear();
    }
  }
  EXPECT_GT(keys, 30U);
}

TEST_F(CompensateSystem, Attack2_1_AFixtureInTheWayIsFoundAfterwardsToo) {
  std::string job = kJob;
  job.replace(job.find("shape  = \"mesh\"\nfile   = \"vise.obj\""), 35,
              "shape  = \"box\"\nsize = [60, 60, 60]");
  write_piece(job);
  const auto meets = [&](const std::string& file) {
    const Outcome checked = run("check --job " + file);
    EXPECT_EQ(checked.exit_code, 1) << checked.err;
    return checked.out.find("vise meets") != std::string::npos;
  };
  EXPECT_TRUE(meets("piece/job.toml"));
  ASSERT_EQ(run("compensate piece/job.toml --out new").exit_code, 0);
  EXPECT_TRUE(meets("new/job.toml"));
}

TEST_F(CompensateSystem, Attack2_1_MeshesOfBlankAndNominalShapeAreFound) {
  write_piece(
      "title = \"a body\"\nmachine = \"three-axis\"\nprogram.file = \"part.nc\"\n"
      "tools = \"library.toml\"\nblank = { shape = \"mesh\", file = \"body.obj\" }\n"
      "nominal.file = \"body.obj\"\nerrors.EXX = \"linear 10 um\"\n");
  write("piece/body.obj", body(0));
  const Outcome made = run("compensate piece/job.toml --out new");
  if (made.err.find("without CGAL") != std::string::npos) GTEST_SKIP() << made.err;
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string written = read(folder_ / "new/job.toml");
  EXPECT_NE(written.find("program.dialect = \"fanuc\"\n"), std::string::npos) << written;
  EXPECT_EQ(written.find("EXX"), std::string::npos) << written;
  const Outcome loaded = run("cmm new/job.toml --quiet");
  EXPECT_LE(loaded.exit_code, 1) << loaded.err;
}

}  // namespace
}  // namespace frustum
