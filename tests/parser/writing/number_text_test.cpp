#include "parser/writing/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/random.hpp"

namespace frustum::parser {
namespace {

TEST(NcNumber, WritesNeitherExponentsNorNegativeZero) {
  EXPECT_EQ(fixed(12.0, 6), "12.");
  EXPECT_EQ(fixed(12.0, 6, WholeNumbers::without_point), "12");
  EXPECT_EQ(fixed(-0.0, 6), "0.");
  EXPECT_EQ(fixed(-4e-7, 6), "0.");
  EXPECT_EQ(fixed(-4e-7, 6, WholeNumbers::without_point), "0");
  EXPECT_EQ(fixed(1e-20, 6), "0.");
  EXPECT_EQ(fixed(-65.1234564, 6), "-65.123456");
  EXPECT_EQ(fixed(1e9, 3), "1000000000.");
  EXPECT_EQ(fixed(100.0, 0, WholeNumbers::without_point), "100");
  EXPECT_EQ(significant(500.0, 9), "500");
  EXPECT_EQ(significant(0.000123456789123, 9), "0.000123456789");
  EXPECT_EQ(significant(1234567.891234, 9), "1234567.89");
  EXPECT_EQ(significant(9.9999999999, 9), "10");
  EXPECT_EQ(significant(0.0, 9), "0");
}

TEST(NcNumberLaws, ReadsBackWithinHalfAUnitOfTheLastDecimal) {
  for (std::uint64_t k = 0; k < 10'000; ++k) {
    const double size = std::pow(10.0, 12.0 * uniform({.seed = 1}, 2 * k) - 8.0);
    const double value = size * (2.0 * uniform({.seed = 1}, 2 * k + 1) - 1.0);
    const std::string text = fixed(value, 6);
    EXPECT_EQ(text.find('e'), std::string::npos);
    EXPECT_NEAR(std::stod(text), value, 0.5e-6 * (1.0 + 1e-9) + 1e-15 * std::abs(value)) << text;
    EXPECT_NEAR(std::stod(significant(value, 9)), value, 5.01e-9 * std::abs(value));
  }
}

}  // namespace
}  // namespace frustum::parser
