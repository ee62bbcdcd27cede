// Findings that are known: a baseline takes them away, and nothing else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "lint/baseline.hpp"
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
    CheckedFile checked{file, "fanuc", "", true, check_program(program, {}), {}};
    checked.lines = source_lines(program, checked.report.findings);
    return checked;
  }
  void write(const CheckedFile& checked) const {
    write_text(Baseline::text_of({&checked, 1}, file_));
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
        "{\"frustum_baseline\": 1, \"findings\": [{\"id\": 5}]}"}) {
    write_text(text);
    EXPECT_FALSE(Baseline::read(file_)) << text;
  }
  EXPECT_FALSE(Baseline::read(file_.string() + ".not-there"));
}

}  // namespace
}  // namespace frustum::lint
