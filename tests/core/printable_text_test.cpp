// What a terminal would obey is written out.
#include "core/printable_text.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/diagnostic.hpp"

namespace frustum {
namespace {

TEST(PrintableText, WritesControlCharactersOut) {
  EXPECT_EQ(printable("a\x1B[31mb\n\r\x7F"), "a\\x1B[31mb\\x0A\\x0D\\x7F");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\x9B31m");
}

TEST(PrintableText, LeavesTextAndTabs) {
  EXPECT_EQ(printable("G1\tX1 \xC3\xBC \xFF"), "G1\tX1 \xC3\xBC \xFF");
}

TEST(PrintableText, IsWhatDiagnosticsArePrintedIn) {
  Diagnostic wrong = error("malformed-option"_id, "id \x1B[2J");
  wrong.file = "a\nb.nc";
  std::ostringstream out;
  print(out, {wrong});
  EXPECT_EQ(out.str(), "a\\x0Ab.nc: error: id \\x1B[2J\n");
}

}  // namespace
}  // namespace frustum
