// Calibrations by touches and by R-tests look at what their readings leave over.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "tests/app/motion_commands.hpp"

namespace frustum {
namespace {

class CalibrationResiduals : public MotionCommands {
 protected:
  // The touches of a virtual calibration.
  void touch(const std::string& more) const {
    const Outcome outcome =
        run("motion touch --machine ac-probe --errors ibaraki-position-dependent --out t --quiet " +
            more);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  // What a calibration says with the touch of a row moved.
  json traced_with(std::size_t row, const std::array<double, 3>& mm,
                   const std::string& more) const {
    std::istringstream in(read(folder_ / "t/touches.csv"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    std::vector<std::string> cells;
    std::istringstream cell_text(lines.at(row + 1));
    for (std::string cell; std::getline(cell_text, cell, ',');) cells.push_back(cell);
    for (std::size_t k = 0; k < 3; ++k) {
      cells.at(3 + k) = fmt::format("{:.9f}", std::stod(cells.at(3 + k)) + mm.at(k));
    }
    lines.at(row + 1) = fmt::format("{}", fmt::join(cells, ","));
    write("off.csv", fmt::format("{}\n", fmt::join(lines, "\n")));
    return document("trace off.csv --machine ac-probe " + more);
  }
  void chase(const std::string& folder, const std::string& ball, const std::string& more) const {
    const Outcome outcome =
        run(fmt::format("motion chase --machine ac-probe --errors ibaraki-position-dependent "
                        "--ball={} --at maps --out {} --quiet {}",
                        ball, folder, more));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

constexpr const char* kBalls = " --balls \"100,0,60;-80,90,40;-20,-110,80\" --machine ac-probe";

TEST_F(CalibrationResiduals, NoiseIsAllThatRightTouchesLeave) {
  const json doc =
      document("touch --machine ac-probe --errors ibaraki-position-dependent --noise 0.35um");
  const json& left = doc["residuals"];
  EXPECT_EQ(left["degrees_of_freedom"], 66);
  EXPECT_NEAR(left["expected_rms_um"].get<double>(), 0.175 * std::sqrt(66.0 / 219.0), 1e-12);
  // 66 degrees of freedom: the root of chi-square over them has a standard deviation of 0.087.
  EXPECT_NEAR(left["rms_um"].get<double>() / left["expected_rms_um"].get<double>(), 1.0, 0.35);
  EXPECT_EQ(left["consistent"], "yes");
  EXPECT_TRUE(left["suspects"].empty());
  EXPECT_EQ(left["residual_um"].size(), 219U);
  EXPECT_EQ(left["sd_um"].size(), 219U);
  EXPECT_TRUE(doc["diagnostics"].empty());
  const json exact = document("touch --machine ac-probe --errors ibaraki-position-dependent");
  // Second order.
  EXPECT_LT(exact["residuals"]["rms_um"].get<double>(), 2e-4);
  EXPECT_TRUE(exact["residuals"]["probability"].is_null());
  EXPECT_TRUE(exact["residuals"]["sd_um"].empty());
}

// The touch that is 0.9 mm off is named, at zero and elsewhere, whether noise is stated or not.
TEST_F(CalibrationResiduals, ATouchThatIsOffIsNamed) {
  touch("--noise 0.35um --seed 3");
  struct Case {
    std::size_t row;
    std::array<double, 3> off;  // 0.9 mm along the normal
    const char* name;
  };
  for (const Case& each :
       {Case{0, {0.9, 0.0, 0.0}, "point 0 (+X of column 1) at A = 0 deg, C = 0 deg"},
        Case{15, {-0.45, -0.779423, 0.0}, "point 1 (-X of column 1) at A = 0 deg, C = 60 deg"}}) {
    for (const char* noise : {"", "--noise 0.35um"}) {
      const json doc = traced_with(each.row, each.off, noise);
      ASSERT_FALSE(doc.is_null());
      const json& left = doc["residuals"];
      EXPECT_EQ(left["consistent"], "no");
      ASSERT_EQ(left["suspects"].size(), 1U) << left["suspects"];
      EXPECT_NE(left["suspects"][0].get<std::string>().find(each.name), std::string::npos)
          << left["suspects"];
      ASSERT_EQ(doc["diagnostics"].size(), 1U);
      EXPECT_EQ(doc["diagnostics"][0]["id"], "reading-suspect");
      EXPECT_EQ(doc["diagnostics"][0]["severity"], "warning");
    }
  }
  const json fine = traced_with(0, {0.0, 0.0, 0.0}, "--noise 0.35um");
  EXPECT_EQ(fine["residuals"]["consistent"], "yes");
  // Three tops give height and tilts of a pose, and one side is touched at zero alone: nothing
  // checks them, and that is said.
  EXPECT_EQ(fine["unchecked"],
            json::array({"point 4 (top of column 1)", "point 9 (top of column 2)",
                         "point 13 (-Y of column 3)", "point 14 (top of column 3)"}));
  EXPECT_EQ(traced_with(4, {0.0, 0.0, 0.9}, "--noise 0.35um")["residuals"]["consistent"], "yes");
  // On the page and for a terminal, too.
  traced_with(0, {0.9, 0.0, 0.0}, "--noise 0.35um --out page");
  const std::string page = read(folder_ / "page/motion.html");
  EXPECT_NE(page.find("+X of column 1"), std::string::npos);
  EXPECT_NE(page.find("What is left over of the touches"), std::string::npos);
  const Outcome text = run("motion trace off.csv --machine ac-probe --noise 0.35um");
  EXPECT_NE(text.err.find("is off by"), std::string::npos) << text.err;
  EXPECT_NE(text.out.find("left over of the touches"), std::string::npos) << text.out;
}

// Squareness is none of the errors of A and C: what it leaves is said, and no touch is blamed.
TEST_F(CalibrationResiduals, ErrorsOfLinearAxesAreSaid) {
  const json doc = document(
      "touch --machine ac-probe --errors ibaraki-position-dependent --error EC0Y=10urad --noise "
      "0.35um");
  EXPECT_EQ(doc["residuals"]["consistent"], "no");
  EXPECT_TRUE(doc["residuals"]["suspects"].empty()) << doc["residuals"]["suspects"];
  ASSERT_EQ(doc["diagnostics"].size(), 1U);
  EXPECT_EQ(doc["diagnostics"][0]["id"], "readings-disagree");
}

TEST_F(CalibrationResiduals, ExchangedBallsAreNamed) {
  chase("b1", "100,0,60", "--noise 0.2um --seed 1");
  chase("b2", "-80,90,40", "--noise 0.2um --seed 2");
  chase("b3", "-20,-110,80", "--noise 0.2um --seed 3");
  const std::string right = "trace b1/trace.csv b2/trace.csv b3/trace.csv";
  const json fine = document(right + kBalls + " --noise 0.2um");
  EXPECT_EQ(fine["residuals"]["degrees_of_freedom"], 69);
  EXPECT_EQ(fine["residuals"]["consistent"], "yes") << fine["residuals"]["rms_um"];
  EXPECT_TRUE(fine["diagnostics"].empty());
  for (const char* noise : {"", " --noise 0.2um"}) {
    const json doc =
        document(std::string("trace b2/trace.csv b1/trace.csv b3/trace.csv") + kBalls + noise);
    EXPECT_EQ(doc["residuals"]["consistent"], "no");
    ASSERT_EQ(doc["diagnostics"].size(), 1U);
    EXPECT_EQ(doc["diagnostics"][0]["id"], "balls-exchanged");
    EXPECT_EQ(doc["residuals"]["suspects"],
              json::array({"ball 1 (b2/trace.csv)", "ball 2 (b1/trace.csv)"}));
  }
  // One reading of one pose, x by 50 um.
  std::string trace = read(folder_ / "b3/trace.csv"), changed;
  std::istringstream in(trace);
  std::size_t row = 0;
  for (std::string line; std::getline(in, line); ++row) {
    if (row == 9) {
      const auto last = line.rfind(','), before = line.rfind(',', last - 1);
      line = line.substr(0, before + 1) +
             fmt::format("{:.6f}", std::stod(line.substr(before + 1)) + 50.0) + line.substr(last);
    }
    changed += line + "\n";
  }
  write("b3/trace.csv", changed);
  const json doc = document(right + kBalls + " --noise 0.2um");
  ASSERT_EQ(doc["diagnostics"].size(), 1U);
  EXPECT_EQ(doc["diagnostics"][0]["id"], "reading-suspect");
  // The ninth pose: the second position of A, the third of C.
  EXPECT_EQ(doc["residuals"]["suspects"][0], "ball 3 (b3/trace.csv) at A = -30 deg, C = 120 deg");
}

}  // namespace
}  // namespace frustum
