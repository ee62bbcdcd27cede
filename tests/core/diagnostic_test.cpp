#include "core/diagnostic.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace frustum {
namespace {

TEST(Diagnostic, PrintsPlaceMessageAndHintInTheFormEditorsJumpTo) {
  const Diagnostic diagnostic{.file = "part.nc",
                              .line = 12,
                              .column = 7,
                              .message = "G1 without a feed rate",
                              .hint = "give F once before the first cutting move"};
  EXPECT_EQ(to_string(diagnostic),
            "part.nc:12:7: error: G1 without a feed rate (hint: give F once before the first "
            "cutting move)");
}

TEST(Diagnostic, LeavesOutWhatIsUnknown) {
  EXPECT_EQ(to_string(error("no machine")), "error: no machine");
  EXPECT_EQ(to_string(Diagnostic{.file = "a.toml", .message = "m"}), "a.toml: error: m");
  EXPECT_EQ(to_string(Diagnostic{.file = "a.toml", .line = 3, .message = "m"}),
            "a.toml:3: error: m");
  // A column without a line places nothing.
  EXPECT_EQ(to_string(Diagnostic{.file = "a.toml", .column = 3, .message = "m"}),
            "a.toml: error: m");
}

TEST(Diagnostic, NamesTheKeyBeforeTheMessage) {
  const Diagnostic diagnostic{
      .file = "job.toml", .line = 4, .key = "tool.1.diameter", .message = "this key is missing"};
  EXPECT_EQ(to_string(diagnostic), "job.toml:4: error: tool.1.diameter: this key is missing");
}

TEST(Diagnostic, KnowsItsSeverity) {
  EXPECT_EQ(to_string(Severity::note), "note");
  EXPECT_EQ(to_string(Severity::warning), "warning");
  EXPECT_EQ(to_string(Severity::error), "error");
  EXPECT_EQ(error("m", "h").severity, Severity::error);
  EXPECT_EQ(warning("m", "h").severity, Severity::warning);
  EXPECT_EQ(warning("m", "h").hint, "h");
}

TEST(Diagnostics, HoldAnErrorOnlyWhenOneIsAmongThem) {
  EXPECT_FALSE(has_error({}));
  EXPECT_FALSE(has_error({warning("w"), Diagnostic{.severity = Severity::note}}));
  EXPECT_TRUE(has_error({warning("w"), error("e")}));
}

TEST(Diagnostics, PrintOneALine) {
  std::ostringstream out;
  print(out, {warning("first"), error("second")});
  EXPECT_EQ(out.str(), "warning: first\nerror: second\n");
}

}  // namespace
}  // namespace frustum
