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

TEST(ShortenedText, Fault2_31_CutsLongNumbersAndWords) {
  const std::string digits(200, '1');
  EXPECT_EQ(shortened("at [" + digits + ".000] mm"),
            "at [" + std::string(20, '1') + "... (200 characters).000] mm");
  EXPECT_EQ(shortened(std::string(40, '1') + " is left"), std::string(40, '1') + " is left");
  EXPECT_EQ(shortened("/" + std::string(299, 'p')), "/" + std::string(299, 'p'));
  EXPECT_EQ(shortened("word " + std::string(5000000, 'x')),
            "word " + std::string(40, 'x') + "... (5000000 characters)");
  // Between characters, not within one.
  EXPECT_EQ(shortened("x" + std::string(39, 'y') + "\u00e4" + std::string(300, 'z')),
            "x" + std::string(39, 'y') + "... (342 characters)");
  EXPECT_EQ(error("wrong"_id, digits, digits).hint, std::string(20, '1') + "... (200 characters)");
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
