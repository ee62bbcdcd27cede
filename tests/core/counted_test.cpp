#include "core/counted.hpp"

#include <gtest/gtest.h>

namespace frustum {
namespace {

TEST(Counted, OneIsNotMany) {
  EXPECT_EQ(counted(0, "run"), "0 runs");
  EXPECT_EQ(counted(1, "run"), "1 run");
  EXPECT_EQ(counted(12, "run"), "12 runs");
  EXPECT_EQ(counted(1, "vertex", "vertices"), "1 vertex");
  EXPECT_EQ(counted(2, "vertex", "vertices"), "2 vertices");
}

}  // namespace
}  // namespace frustum
