// Findings that are known: a baseline takes them away, and nothing else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "lint/baseline.hpp"
#include "lint/fingerprints.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

namespace fs = std::filesystem;

class BaselineTest : public testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::path(testing::TempDir()) /
            (std::string("baseline_") +
             testing::UnitTest::GetInstance()->current_test_info()->name() + ".json");
  }
  void TearDown() override { fs::remove(file_); }

  CheckedFile checked_file(const std::string& text, const std::string& name = "part.nc") const {
    const std::string file = (file_.parent_path() / name).string();
    const parser::Program program{file, parser::Dialect::fanuc, parser::ProgramText(text), nullptr};
    CheckOptions options;
    options.run.control.unit = parser::LengthUnit::millimetre;
    options.most_places = std::numeric_limits<std::size_t>::max();
    CheckedFile checked{file, "fanuc", "", true, check_program(program, options), {}};
    checked.lines = source_lines(program, checked.report.findings);
    return checked;
  }
  void write(const CheckedFile& checked) const {
    const CheckedFile* const only = &checked;
    write_text(Baseline::text_of({&only, 1}, file_));
  }
  void write_text(const std::string& text) const { std::ofstream(file_) << text; }
  Baseline read() const {
    auto baseline = Baseline::read(file_);
    EXPECT_TRUE(baseline.has_value());
    return baseline ? *std::move(baseline) : Baseline();
  }
  static std::size_t errors_after(Baseline baseline, CheckedFile checked) {
    baseline.apply(checked);
    return checked.report.count(Severity::error);
  }

  // Of a check, those that count.
  static std::size_t left_after(Baseline baseline, CheckedFile checked, std::string_view id) {
    baseline.apply(checked);
    std::size_t left = 0;
    for (const Finding& finding : of(checked.report, id)) {
      left += finding.suppressed == Suppressed::no ? 1 : 0;
    }
    return left;
  }

  fs::path file_;
};

TEST_F(BaselineTest, TakesWhatItHasWhereverTheLinesAre) {
  write(checked_file("G0 X1\nN10 G999\nM30\n"));
  EXPECT_EQ(errors_after(read(), checked_file("G0 X1\nN10 G999\nM30\n")), 0U);
  EXPECT_EQ(errors_after(read(), checked_file("(a)\n(b)\nG0 X1\nN55 G999\nM30\n")), 0U);
}

TEST_F(BaselineTest, LeavesNewOnes) {
  write(checked_file("G0 X1\nG999\nM30\n"));
  EXPECT_EQ(errors_after(read(), checked_file("G0 X1\nG998\nM30\n")), 1U);
  EXPECT_EQ(errors_after(read(), checked_file("G0 X1\nG999\nM30\n", "other.nc")), 1U);
}

TEST_F(BaselineTest, OneMoreErrorOfTheSameWordsIsNew) {
  write(checked_file("G0 X1\nG999\nM30\n"));
  EXPECT_EQ(errors_after(read(), checked_file("G0 X1\nG999\nG999 X50\nG999 Y70\nM30\n")), 2U);
  EXPECT_EQ(errors_after(read(), checked_file("G0 X1\nG999\nG999\nM30\n")), 1U) << "a count";
}

TEST_F(BaselineTest, DeletingTheFirstLeavesTheOthersKnown) {
  write(checked_file("G0 X1\nG999 X1\nG999 X50\nM250 X1\nM250 X2\nM30\n"));
  const CheckedFile fewer = checked_file("G0 X1\nG999 X50\nM250 X2\nM30\n");
  EXPECT_EQ(errors_after(read(), fewer), 0U);
  EXPECT_EQ(left_after(read(), fewer, "builder-word"), 0U);
}

TEST_F(BaselineTest, AnotherLineOfAKnownWordIsNewAndALoopIsNot) {
  write(checked_file("G0 X1\nM250\nM30\n"));
  EXPECT_EQ(left_after(read(), checked_file("G0 X1\nM250\nM250\nM30\n"), "builder-word"), 1U);
  const char* loop = "#1=0\nWHILE [#1 LT 5] DO1\nM250\n#1=#1+1\nEND1\nM30\n";
  EXPECT_EQ(left_after(read(), checked_file(loop), "builder-word"), 0U);
}

TEST_F(BaselineTest, FurtherCutsWithTheSpindleOffAreNew) {
  const std::string head = "T1 M6\nG43 H1\nG0 X0 Y0 Z50\nF200\nG1 Z-1\n", end = "G0 Z60\nM30\n";
  write(checked_file(head + end));
  EXPECT_EQ(left_after(read(), checked_file(head + end), "spindle-off"), 0U);
  EXPECT_EQ(left_after(read(), checked_file(head + "X500\n" + end), "spindle-off"), 1U);
}

TEST_F(BaselineTest, SeesMoreThanAreListed) {
  const auto flood = [](int places) {
    std::string text = "T1 M6\nS1000 M3\nG43 H1\nG0 X0 Y0 Z50\nF200\n";
    for (int i = 0; i < places; ++i) text += "G2 X20.008 Y0 I10 J0\nG0 X0\n";
    return text + "G0 Z60\nM5\nM30\n";
  };
  write(checked_file(flood(150)));
  EXPECT_EQ(left_after(read(), checked_file(flood(150)), "arc-radii"), 0U);
  EXPECT_EQ(left_after(read(), checked_file(flood(152)), "arc-radii"), 2U);
}

TEST_F(BaselineTest, ASubprogramOfTwoCallersIsKnownOnce) {
  const CheckedFile one = checked_file("G0 X1\nG999\nM30\n");
  const CheckedFile* const both[] = {&one, &one};
  write_text(Baseline::text_of(both, file_));
  EXPECT_EQ(errors_after(read(), checked_file("G0 X1\nG999\nG999\nM30\n")), 1U);
}

TEST_F(BaselineTest, ReadsThoseThatNumberedTheirFingerprints) {
  const CheckedFile checked = checked_file("G0 X1\nG999\nM30\n");
  const std::string mark = fingerprint_of(checked.report.findings[0], checked.lines);
  write_text(
      "{\"frustum_baseline\": 1, \"findings\": [{\"file\": \"part.nc\", \"id\": "
      "\"program-error\", \"fingerprint\": \"" +
      mark + ":1\"}]}");
  EXPECT_EQ(errors_after(read(), checked), 0U);
}

TEST_F(BaselineTest, CountsWhatIsGone) {
  write(checked_file("G0 X1\nG999\nM30\n"));
  Baseline baseline = read();
  CheckedFile other = checked_file("G0 X1\nM30\n", "other.nc");
  baseline.apply(other);
  EXPECT_EQ(baseline.gone(), 0U) << "its file was not checked";
  CheckedFile mended = checked_file("G0 X1\nM30\n");
  baseline.apply(mended);
  EXPECT_EQ(baseline.gone(), 1U);
}

TEST_F(BaselineTest, RefusesWhatIsNone) {
  for (const char* text :
       {"", "[]", "{}", "{\"findings\": []}", "{\"frustum_baseline\": 2, \"findings\": []}",
        "{\"frustum_baseline\": 1, \"findings\": [{\"id\": 5}]}",
        "{\"frustum_baseline\": 1, \"findings\": [{\"file\": \"a\", \"id\": \"b\", "
        "\"fingerprint\": \"c\", \"count\": -1}]}"}) {
    write_text(text);
    EXPECT_FALSE(Baseline::read(file_)) << text;
  }
  EXPECT_FALSE(Baseline::read(file_.string() + ".not-there"));
}

}  // namespace
}  // namespace frustum::lint
