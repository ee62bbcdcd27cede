// Where errors come from: distributions, error files, CSV, calibration files, volumetric grids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/toml_document.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_draw.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/errors/error_table.hpp"
#include "kinematics/errors/measured_errors.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

class FileOf {
 public:
  FileOf(const std::string& name, const std::string& text)
      : path_(fs::path(testing::TempDir()) / ("frustum_" + name)) {
    std::ofstream(path_) << text;
  }
  ~FileOf() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  FileOf(const FileOf&) = delete;
  FileOf& operator=(const FileOf&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

double amount_of(const std::string& text, std::uint64_t seed, std::uint32_t index = 0) {
  const auto entry = parse_error(text);
  if (!entry) ADD_FAILURE() << entry.error().front().message;
  return draw(std::vector{*entry}, seed, index).front().terms.front().amount.value;
}

TEST(ErrorDraw, RefusesADistributionThatHasNotBeenDrawnAndSaysHow) {
  const auto entry = *parse_error("EXX=linear uniform -10um..10um");
  const auto errors = resolve(shipped("iwf-bc"), std::vector{entry});
  ASSERT_FALSE(errors);
  EXPECT_EQ(errors.error().front().message,
            "error EXX = linear uniform -10um..10um: the amount is a distribution and has not been "
            "drawn");
  EXPECT_EQ(errors.error().front().hint,
            "draw it: --draw SEED, or error_draw = { seed = 1 } in the job");
  EXPECT_TRUE(resolve(shipped("iwf-bc"), draw(std::vector{entry}, 1)));
}

TEST(ErrorDraw, ADrawDependsOnSeedIndexAndNameButNotOnCompany) {
  const std::string text = "EXX=linear uniform -10um..10um";
  EXPECT_EQ(amount_of(text, 7), amount_of(text, 7));
  EXPECT_NE(amount_of(text, 7), amount_of(text, 8));
  EXPECT_NE(amount_of(text, 7), amount_of(text, 7, 1));
  const std::vector entries{*parse_error("EYX=uniform -10um..10um"), *parse_error(text)};
  const auto both = draw(entries, 7);
  EXPECT_EQ(both[1].terms.front().amount.value, amount_of(text, 7));
  EXPECT_NE(both[0].terms.front().amount.value, both[1].terms.front().amount.value);
  EXPECT_TRUE(both[1].written.starts_with("linear ")) << both[1].written;
}

TEST(ErrorDraw, DrawsHaveTheMomentsOfTheirDistribution) {
  const int n = 20000;
  const auto moments = [&](const std::string& text) {
    double sum = 0.0, squares = 0.0, largest = 0.0;
    for (int k = 0; k < n; ++k) {
      const double x = amount_of(text, 3, static_cast<std::uint32_t>(k)) * kUradPerRad;
      sum += x;
      squares += x * x;
      largest = std::max(largest, std::abs(x));
    }
    const double mean = sum / n;
    return std::array{mean, std::sqrt(squares / n - mean * mean), largest};
  };
  // Four standard errors of 20000 draws.
  const auto normal = moments("EBX=normal 3urad sd 5urad");
  EXPECT_NEAR(normal[0], 3.0, 4 * 5 / std::sqrt(n));
  EXPECT_NEAR(normal[1], 5.0, 4 * 5 / std::sqrt(2.0 * n));
  const auto limited = moments("EBX=normal 0urad sd 5urad limit 5urad");
  EXPECT_LE(limited[2], 5.0);
  EXPECT_NEAR(limited[1], 5.0 * 0.5396, 0.03);  // of a normal law cut at one sigma
  const auto even = moments("EBX=uniform -6urad..6urad");
  EXPECT_NEAR(even[1], 6 / std::sqrt(3.0), 0.06);
  EXPECT_LE(even[2], 6.0);
}

TEST(ErrorDraw, NamedQuantitiesAreSharedBetweenErrors) {
  const auto document = TomlDocument::parse(R"toml([errors]
drawn = { a = "normal 0um sd 2um", zeta = "uniform 0deg..360deg" }
EXC = "harmonic 1 a phase -zeta over 0deg..360deg"
EYC = "harmonic 1 -0.5*a phase zeta-90deg over 0deg..360deg"
EXB = "a*cos(zeta)"
EZB = "a*sin(zeta)"
)toml",
                                            "errors.toml");
  ASSERT_TRUE(document);
  const ErrorList list = read_errors(document->root().table("errors"));
  EXPECT_FALSE(has_error(document->finish()));
  const auto drawn = draw(list.entries, 11);
  const auto amount = [&](const std::string& name) -> const ErrorShape& {
    return std::find_if(drawn.begin(), drawn.end(),
                        [&](const ErrorEntry& e) { return e.name == name; })
        ->terms.front();
  };
  const double a = amount("EXC").amount.value, zeta = -amount("EXC").phase.value;
  EXPECT_NE(a, 0.0);
  EXPECT_DOUBLE_EQ(amount("EYC").amount.value, -0.5 * a);
  EXPECT_NEAR(amount("EYC").phase.value, zeta - pi / 2, 1e-15);
  EXPECT_NEAR(amount("EXB").amount.value, a * std::cos(zeta), 1e-18);
  EXPECT_NEAR(amount("EZB").amount.value, a * std::sin(zeta), 1e-18);
}

TEST(ErrorDraw, DistributionsNameWhatIsWrong) {
  const auto problem = [](const std::string& text) {
    const auto parsed = parse_error("EXX=" + text);
    return parsed ? "accepted" : parsed.error().front().message;
  };
  EXPECT_EQ(problem("uniform 10um..-10um"),
            "error EXX = uniform 10um..-10um: 'uniform 10um..-10um' is not a range such as "
            "-10um..10um");
  EXPECT_EQ(problem("normal 0um"),
            "error EXX = normal 0um: 'normal' needs its standard deviation: normal 0um sd 5um");
  EXPECT_EQ(problem("normal 0um sd -1um"),
            "error EXX = normal 0um sd -1um: the standard deviation must be above 0");
  EXPECT_EQ(problem("normal 0um sd 5um limit 0.1um"),
            "error EXX = normal 0um sd 5um limit 0.1um: the limit must be at least a tenth of sd");
  EXPECT_EQ(problem("harmonic 1 a1"),
            "error EXX = harmonic 1 a1: 'a1' is neither a number with a unit nor a drawn quantity");
}

TEST(MeasuredErrors, ReadsSeveralColumnsOfACsv) {
  const FileOf csv("x.csv", "# laser\nX_mm,EXX_um,EBX_urad\n-100,1,-2\n0,0,0\n100, 3.5 ,4\n");
  const auto entries = read_error_csv(csv.path());
  ASSERT_TRUE(entries) << to_string(entries.error().front());
  ASSERT_EQ(entries->size(), 2u);
  EXPECT_EQ(entries->at(0).name, "EXX");
  EXPECT_EQ(entries->at(0).written, "table of 3 points");
  const auto errors = resolve(shipped("iwf-bc"), *entries);
  ASSERT_TRUE(errors);
  AxisState at;
  at.q[AxisLetter::X] = 50.0;
  EXPECT_NEAR((*errors)[AxisLetter::X].component[0](AxisLetter::X, at), 1.75e-3, 1e-15);
  EXPECT_NEAR((*errors)[AxisLetter::X].component[4](AxisLetter::X, at), 2e-6, 1e-18);
}

TEST(MeasuredErrors, NameFileLineAndColumnOfAMistake) {
  const auto problem = [](const std::string& text) {
    const FileOf csv("bad.csv", text);
    const auto read = read_error_csv(csv.path());
    if (read) return std::string("accepted");
    const Diagnostic& d = read.error().front();
    return std::to_string(d.line) + ":" + std::to_string(d.column) + " " + d.message;
  };
  EXPECT_EQ(problem("X_mm,EXX\n0,0\n1,1\n"), "1:6 column 'EXX' has no unit");
  EXPECT_EQ(problem("X_mm,EXX_miles\n0,0\n"), "1:6 column 'EXX_miles': unknown unit 'miles'");
  EXPECT_EQ(problem("X_mm,EXX_urad\n0,0\n1,1\n"), "1:6 EXX must be a length");
  EXPECT_EQ(problem("X_mm,EQX_um\n0,0\n1,1\n"), "1:6 unknown error name 'EQX'");
  EXPECT_EQ(problem("X_mm,EXY_um\n0,0\n1,1\n"), "1:6 EXY is no function of X");
  EXPECT_EQ(problem("X_deg,EXX_um\n0,0\n1,1\n"), "1:1 the position of X must be a length");
  EXPECT_EQ(problem("X_mm,EXX_um\n0,0\n10,1\n10,2\n"), "4:1 the positions do not increase");
  EXPECT_EQ(problem("X_mm,EXX_um\n0,0\n10, 1x\n"), "3:5 '1x' is not a number");
  EXPECT_EQ(problem("X_mm,EXX_um\n0,0\n10\n"), "3:1 1 value in a row, 2 columns in the header");
  EXPECT_EQ(problem(""), "1:0 the file has no header");
}

TEST(MeasuredErrors, ReadsACalibrationFile) {
  const FileOf file("calibration.txt", R"(// values in mm or rad
[B0C]
VALUE = 0.000018
[EXX]
Gridpoints = {
-200.0 -0.004
   0.0  0.0   // middle
 200.0  0.005
}
[EXC]
Gridpoints = {
0 0
360 0.002
}
)");
  const auto entries = read_calibration(file.path());
  ASSERT_TRUE(entries) << to_string(entries.error().front());
  const auto errors = resolve(shipped("iwf-bc"), *entries);
  ASSERT_TRUE(errors) << to_string(errors.error().front());
  EXPECT_DOUBLE_EQ((*errors)[AxisLetter::C].location[4], 18e-6);
  AxisState at;
  at.q[AxisLetter::X] = 100.0;
  at.q[AxisLetter::C] = pi;
  EXPECT_NEAR((*errors)[AxisLetter::X].component[0](AxisLetter::X, at), 2.5e-3, 1e-15);
  EXPECT_NEAR((*errors)[AxisLetter::C].component[0](AxisLetter::C, at), 1e-3, 1e-15);
}

TEST(MeasuredErrors, CalibrationFilesNameLineAndColumn) {
  const auto problem = [](const std::string& text) {
    const FileOf file("bad.txt", text);
    const auto read = read_calibration(file.path());
    if (read) return std::string("accepted");
    const Diagnostic& d = read.error().front();
    return std::to_string(d.line) + ":" + std::to_string(d.column) + " " + d.message;
  };
  EXPECT_EQ(problem("[EQQ]\n"), "1:2 unknown error name 'EQQ'");
  EXPECT_EQ(problem("[EXX]\nVALUE = x\n"), "2:9 'x' is not a number");
  EXPECT_EQ(problem("[EXX]\n[EYX]\n"), "1:1 [EXX] is empty");
  EXPECT_EQ(problem("[EXX]\nGridpoints = {\n1 0\n0 0\n}\n"), "4:1 the positions do not increase");
  EXPECT_EQ(problem("[EXX]\nGridpoints = {\n1 0\n2 0\n"), "4:0 the grid points are not closed");
  EXPECT_EQ(problem("VALUE = 1\n"), "1:1 'VALUE = 1' is in no section");
  EXPECT_EQ(problem("[EXX]\nVALUE =\n"), "2:8 '' is not a number");
}

TEST(VolumetricGrid, IsTrilinearAndHeldAtItsFaces) {
  std::string text = "x_mm,y_mm,z_mm,dx_um,dy_um,dz_um,dc_urad\n";
  const auto exact = [](double x, double y, double z) {
    return Vec3(1 + 0.1 * x, x * y * 1e-3, z - 0.02 * x * z);
  };
  for (const double z : {200.0, -50.0}) {  // any order of rows
    for (const double y : {-100.0, 0.0, 100.0}) {
      for (const double x : {0.0, 300.0}) {
        const Vec3 d = exact(x, y, z);
        text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "," +
                std::to_string(d.x()) + "," + std::to_string(d.y()) + "," + std::to_string(d.z()) +
                ",5\n";
      }
    }
  }
  const FileOf csv("grid.csv", text);
  const auto grid = VolumetricGrid::load(csv.path());
  ASSERT_TRUE(grid) << to_string(grid.error().front());
  EXPECT_EQ(grid->size(), (std::array<std::size_t, 3>{2, 3, 2}));
  AxisPositions q;
  q[AxisLetter::X] = 70.0;
  q[AxisLetter::Y] = -33.0;
  q[AxisLetter::Z] = 12.0;
  EXPECT_LT((grid->at(q).shift * kUmPerMm - exact(70, -33, 12)).norm(), 1e-9);
  EXPECT_NEAR(grid->at(q).turn.z(), 5e-6, 1e-15);
  q[AxisLetter::X] = 1e4;
  EXPECT_LT((grid->at(q).shift * kUmPerMm - exact(300, -33, 12)).norm(), 1e-9);
}

TEST(VolumetricGrid, NamesWhatIsWrong) {
  const auto problem = [](const std::string& text) {
    const FileOf csv("bad_grid.csv", text);
    const auto read = VolumetricGrid::load(csv.path());
    if (read) return std::string("accepted");
    const Diagnostic& d = read.error().front();
    return std::to_string(d.line) + ":" + std::to_string(d.column) + " " + d.message;
  };
  const std::string head = "x_mm,y_mm,z_mm,dx_um,dy_um,dz_um\n";
  EXPECT_EQ(problem("x_mm,y_mm,z_mm,dx_um,dy_um\n0,0,0,0,0\n"), "1:0 column 'dz' is missing");
  EXPECT_EQ(problem("x_mm,y_mm,z_mm,dx_um,dy_um,dz_um,q_mm\n"), "1:34 unknown column 'q'");
  EXPECT_EQ(problem(head + "0,0,0,0,0,0\n1,0,0,0,0,0\n"), "0:0 the grid has 1 position(s) along y");
  EXPECT_EQ(problem(head + "0,0,0,0,0,0\n1,1,1,0,0,0\n0,0,0,0,0,0\n"),
            "4:1 the point of line 2 again");
  EXPECT_EQ(problem(head + "0,0,0,0,0,0\n1,1,1,0,0,0\n"),
            "0:0 the grid has no point at x 0, y 0, z 1 mm");
}

TEST(VolumetricGrid, AddsUpInSumsOfErrors) {
  const auto grid = std::make_shared<const VolumetricGrid>(
      std::array<std::vector<double>, 3>{{{0, 1}, {0, 1}, {0, 1}}},
      std::vector<GridErrors>(8, {Vec3(1, 2, 3), Vec3(4, 5, 6)}));
  GeometricErrors errors;
  EXPECT_FALSE(errors.has_grid());
  errors.add_grid(grid, 1.0);
  const GeometricErrors sum = errors.plus(errors, -0.25);
  EXPECT_TRUE(sum.has_grid());
  EXPECT_LT((sum.grid_at({}).shift - 0.75 * Vec3(1, 2, 3)).norm(), 1e-15);
  EXPECT_LT((sum.grid_at({}).turn - 0.75 * Vec3(4, 5, 6)).norm(), 1e-15);
}

// What the grid says of a machine with X, Y, Z on the tool side, its straightness errors say as
// well.
TEST(VolumetricGrid, MovesTheToolAgainstTheBed) {
  const Machine machine = shipped("dvf5000");
  const GridErrors everywhere{Vec3(0.01, -0.02, 0.03), Vec3(20e-6, -30e-6, 40e-6)};
  GeometricErrors errors;
  errors.add_grid(std::make_shared<const VolumetricGrid>(
                      std::array<std::vector<double>, 3>{{{0, 1}, {0, 1}, {0, 1}}},
                      std::vector<GridErrors>(8, everywhere)),
                  1.0);
  // The last linear axis of its tool chain, in bed orientation at Z's origin.
  const auto same =
      resolve(machine, std::vector{*parse_error("EXZ=10um"), *parse_error("EYZ=-20um"),
                                   *parse_error("EZZ=30um"), *parse_error("EAZ=20urad"),
                                   *parse_error("EBZ=-30urad"), *parse_error("ECZ=40urad")});
  AxisPositions q;
  q[AxisLetter::X] = 50.0;
  q[AxisLetter::Y] = -70.0;
  q[AxisLetter::Z] = -100.0;
  q[AxisLetter::B] = 0.5;
  q[AxisLetter::C] = 1.0;
  const Pose by_grid = actual_pose(machine, errors, q, 150.0);
  const Pose by_axis = actual_pose(machine, *same, q, 150.0);
  EXPECT_LT((by_grid.translation - by_axis.translation).norm(), 1e-10);
  EXPECT_LT((by_grid.rotation - by_axis.rotation).norm(), 1e-13);
  const Pose nominal = nominal_pose(machine, q, 150.0);
  const PoseDisplacement linear = first_order_displacement(machine, errors, q, 150.0);
  // 1e-5 mm: second order, with margin, of 50 urad over a lever of 1 m.
  EXPECT_LT((by_grid.translation - nominal.translation - linear.tip).norm(), 1e-5);
}

std::string shipped_errors(const std::string& name) {
  return std::string(FRUSTUM_SOURCE_DIR) + "/machines/errors/" + name + ".toml";
}

ErrorList shipped_list(const std::string& name) {
  auto list = load_error_file(shipped_errors(name));
  if (list) return *std::move(list);
  ADD_FAILURE() << to_string(list.error().front());
  return {};
}

TEST(ErrorFile, EveryShippedFileLoadsFitsItsMachineAndResolves) {
  int files = 0;
  for (const auto& item :
       fs::directory_iterator(std::string(FRUSTUM_SOURCE_DIR) + "/machines/errors")) {
    if (item.path().extension() != ".toml") continue;
    ++files;
    const auto list = load_error_file(item.path());
    ASSERT_TRUE(list) << to_string(list.error().front());
    ASSERT_EQ(list->files.size(), 1u);
    EXPECT_FALSE(list->files.front().source.empty()) << item.path();
    const Machine machine = shipped(list->files.front().machine);
    EXPECT_EQ(list->files.front().structure, machine.structure());
    EXPECT_FALSE(mismatch(list->files.front(), machine));
    const auto errors = resolve(machine, draw(list->entries, 1));
    EXPECT_TRUE(errors) << to_string(errors.error().front());
  }
  EXPECT_EQ(files, 5);
}

TEST(ErrorFile, HoldsTheNumberOfErrorsOfItsSource) {
  const auto terms_of = [](const std::string& name) {
    const ErrorList list = shipped_list(name);
    std::size_t terms = 0;
    for (const ErrorEntry& entry : list.entries) terms += entry.terms.size();
    return terms;
  };
  EXPECT_EQ(terms_of("bossoni-cone-limits"), 91u);
  EXPECT_EQ(shipped_list("jang-general-tolerances").entries.size(), 37u);
  EXPECT_EQ(shipped_list("jang-key-tolerances").entries.size(), 37u);
  EXPECT_EQ(shipped_list("ibaraki-position-dependent").entries.size(), 12u);
}

TEST(ErrorFile, ToleranceDrawsHaveTheirMeansAndSpread) {
  const auto list = shipped_list("jang-key-tolerances");
  const auto exx = std::find_if(list.entries.begin(), list.entries.end(),
                                [](const ErrorEntry& e) { return e.name == "exX"; });
  double sum = 0.0, squares = 0.0;
  const int n = 4000;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double x = draw(std::vector{*exx}, 5, k).front().terms.front().amount.value * kUradPerRad;
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, -8.0, 4 * 2 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n - sum / n * sum / n), 2.0, 0.1);
}

// Equations (1)-(7) written out beside the file.
TEST(ErrorFileReference, HongEquations1To7) {
  const auto list = shipped_list("hong-component-errors");
  const Machine machine = shipped("iwf-bc");
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const auto drawn = draw(list.entries, seed);
    const GeometricErrors errors = *resolve(machine, drawn);
    const auto terms = [&](const std::string& name) {
      return std::find_if(drawn.begin(), drawn.end(), [&](const auto& e) { return e.name == name; })
          ->terms;
    };
    const auto clamped = [](double q, double lo, double hi) {
      return std::clamp(q, lo, hi) * pi / 180;
    };
    const auto value = [&](AxisLetter axis, std::size_t d, double b, double c) {
      AxisState at;
      at.q[AxisLetter::B] = b * pi / 180;
      at.q[AxisLetter::C] = c * pi / 180;
      return errors[axis].component[d](axis, at);
    };
    const double m = terms("EZC")[0].amount.value, n = terms("EZC")[1].amount.value;
    const double at = terms("EZC")[1].peak.value;
    const auto exc = terms("EXC"), eyc = terms("EYC");
    const double a1 = exc[0].amount.value, zeta = -exc[0].phase.value;
    const double along_x = exc[1].amount.value, along_y = eyc[1].amount.value;
    const double break_c = exc[1].peak.value;
    const double a7 = exc[2].amount.value, zeta7 = -exc[2].phase.value;
    for (const double c_deg : {-360.0, -300.0, -123.0, -20.0, 0.0}) {
      const double c = clamped(c_deg, -360, 0), turn = 2 * pi;
      const double eq1 = c <= at ? m + (n - m) * (c + turn) / (at + turn) : m + (n - m) * c / at;
      EXPECT_NEAR(value(AxisLetter::C, 2, -30, c_deg), eq1, 1e-15);
      const double b_deg = -30;
      const double growth = 0.5 + std::abs(b_deg / 45.0);
      const double ramp = c <= break_c ? (c + turn) / (break_c + turn) : c / break_c;
      // Co-rotating with the table: by -C in its stator.
      const double x = a1 * std::cos(zeta - c) + along_x * ramp + a7 * growth * std::cos(zeta7 - c);
      const double y = a1 * std::sin(zeta - c) + along_y * ramp + a7 * growth * std::sin(zeta7 - c);
      EXPECT_NEAR(value(AxisLetter::C, 0, b_deg, c_deg), x, 1e-14);
      EXPECT_NEAR(value(AxisLetter::C, 1, b_deg, c_deg), y, 1e-14);
    }
    // (2) alone, with what (3) and (5), (6) add to EZB taken off.
    const auto ezb = terms("EZB");
    const double gm = ezb[0].amount.value, gn = ezb[1].amount.value;
    EXPECT_DOUBLE_EQ(ezb[2].amount.value, -gm);
    std::vector<ErrorEntry> gravity{{.name = "EZB", .terms = {ezb[0], ezb[1], ezb[2]}}};
    const GeometricErrors of_gravity = *resolve(machine, gravity);
    for (const double b : {-90.0, -36.0, 0.0, 45.0, 90.0}) {
      AxisState state;
      state.q[AxisLetter::B] = b * pi / 180;
      EXPECT_NEAR(of_gravity[AxisLetter::B].component[2](AxisLetter::B, state),
                  gn + (gm - gn) * std::abs(b) / 90.0, 1e-15);
    }
  }
}

TEST(ErrorFile, OfAnotherMachineIsRefusedWithTheAxis) {
  const auto list = shipped_list("ibaraki-position-dependent");
  const auto problem = mismatch(list.files.front(), shipped("iwf-bc"));
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->message,
            "the errors are written for ac-probe (t-(C)-Z-X-b-Y-A-C-w); machine iwf-bc "
            "(t-(C)-Z-Y-b-X-B-C-w) carries X on the other side");
  EXPECT_FALSE(mismatch(list.files.front(), shipped("zx-yac")));
}

TEST(ErrorFile, AMisspeltKeyIsNamedWithItsLine) {
  const FileOf file("errors.toml",
                    "title = \"t\"\nmachine = \"iwf-bc\"\n[errors]\nEXX = \"1 um\"\n"
                    "EYX = { linear = \"1 um\", spam = 3 }\n");
  const auto list = load_error_file(file.path());
  ASSERT_FALSE(list);
  EXPECT_EQ(list.error().front().line, 5);
  EXPECT_EQ(list.error().front().key, "errors.EYX.spam");
}

TEST(ErrorFile, ProblemsOfItsErrorsNameTheFile) {
  const FileOf file("errors.toml",
                    "title = \"t\"\nmachine = \"iwf-bc\"\n[errors]\nEXA = \"1 um\"\n");
  const auto list = load_error_file(file.path());
  ASSERT_TRUE(list);
  const auto errors = resolve(shipped("iwf-bc"), list->entries);
  ASSERT_FALSE(errors);
  EXPECT_EQ(errors.error().front().file, file.path().string());
  EXPECT_EQ(errors.error().front().key, "errors.EXA");
}

}  // namespace
}  // namespace frustum::kinematics
