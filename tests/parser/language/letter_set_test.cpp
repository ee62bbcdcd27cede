#include "parser/language/letter_set.hpp"

#include <gtest/gtest.h>

namespace frustum::parser {
namespace {

TEST(LetterSet, HasItsLettersAndNoOther) {
  const LetterSet set("AZaz");
  for (const char letter : {'A', 'Z', 'a', 'z'}) EXPECT_TRUE(set.has(letter));
  for (const char letter : {'B', 'Y', 'b', 'y'}) EXPECT_FALSE(set.has(letter));
  EXPECT_EQ(set.first(), 'A');
  EXPECT_EQ(set.without(LetterSet("AZ")).first(), 'a');
}

TEST(LetterSet, HasNoCharacterThatIsNoLetter) {
  const LetterSet set(kAxisWords);
  for (int code = -128; code < 128; ++code) {
    const auto character = static_cast<char>(code);
    if (code >= 'A' && code <= 'Z') continue;
    EXPECT_FALSE(set.has(character)) << code;
  }
}

TEST(LetterSet, AddingWhatIsNoLetterChangesNothing) {
  LetterSet set;
  for (const char character : {'@', '0', '-', ' ', '\0', '\x7f', '\xff', '\x80'}) {
    set.add(character);
    EXPECT_TRUE(set.empty()) << static_cast<int>(character);
  }
}

}  // namespace
}  // namespace frustum::parser
