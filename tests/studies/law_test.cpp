#include "studies/law.hpp"

#include <gtest/gtest.h>

namespace frustum::studies {
TEST(Law, X) { EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-13); }
}  // namespace frustum::studies
