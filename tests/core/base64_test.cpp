#include "core/base64.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace frustum {
namespace {

TEST(Base64, PadsToGroupsOfFour) {
  const std::vector<unsigned char> text = {'f', 'o', 'o', 'b', 'a'};
  EXPECT_EQ(base64(text), "Zm9vYmE=");
  EXPECT_EQ(base64(std::span(text).first(4)), "Zm9vYg==");
  EXPECT_EQ(base64(std::span(text).first(3)), "Zm9v");
  EXPECT_EQ(base64({}), "");
}

}  // namespace
}  // namespace frustum
