#include "core/spelling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace frustum {
namespace {

const std::vector<std::string>& keys() {
  static const std::vector<std::string> kKeys{"diameter", "length", "radius_error", "type"};
  return kKeys;
}

TEST(NearestWord, ForgivesAThirdOfTheLetters) {
  EXPECT_EQ(nearest_word("diametr", keys()), "diameter");
  EXPECT_EQ(nearest_word("diamtr", keys()), "diameter");
  EXPECT_EQ(nearest_word("lenght", keys()), "length");
  EXPECT_EQ(nearest_word("radius_eror", keys()), "radius_error");
}

TEST(NearestWord, CountsLettersThatChangedPlacesOnce) {
  EXPECT_EQ(nearest_word("axse", std::vector<std::string>{"axes"}), "axes");
  EXPECT_EQ(nearest_word("form", std::vector<std::string>{"bore"}), std::nullopt);
}

TEST(NearestWord, IgnoresCase) {
  EXPECT_EQ(nearest_word("DIAMETER", keys()), "diameter");
  EXPECT_EQ(nearest_word("ex0c", std::vector<std::string>{"EX0B", "EX0C"}), "EX0C");
}

TEST(NearestWord, TakesTheNearestAndAmongEqualsTheFirst) {
  EXPECT_EQ(nearest_word("EX0C", std::vector<std::string>{"EX0B", "EX0C"}), "EX0C");
  EXPECT_EQ(nearest_word("EX0D", std::vector<std::string>{"EX0B", "EX0C"}), "EX0B");
}

TEST(NearestWord, KeepsSilentWhenNothingResemblesTheWord) {
  EXPECT_FALSE(nearest_word("colour", keys()));
  EXPECT_FALSE(nearest_word("", std::vector<std::string>{"X", "Y"}));
  EXPECT_FALSE(nearest_word("diameter", {}));
}

TEST(Suggestion, AsksOrListsWhatIsKnown) {
  EXPECT_EQ(suggestion("typ", keys()), "did you mean type?");
  EXPECT_EQ(suggestion("colour", keys()), "known: diameter, length, radius_error, type");
  EXPECT_EQ(suggestion("colour", {}), "");
}

TEST(Suggestion, ListsNoMoreThanPeopleRead) {
  const std::vector<std::string> many(1000, "Z");
  const std::string text = suggestion("colour", many);
  EXPECT_TRUE(text.starts_with("known: Z, Z, ")) << text;
  EXPECT_TRUE(text.ends_with("Z, Z and 960 more")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), 'Z'), 40);
}

}  // namespace
}  // namespace frustum
