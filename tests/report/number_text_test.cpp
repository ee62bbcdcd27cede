#include "report/number_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace frustum::report {
namespace {

TEST(NumberText, GivesDeviationsTheirSignAndNoNominal) {
  metrology::CharacteristicResult c;
  c.unit = "um";
  c.value = 1.5;
  EXPECT_EQ(result_text(c), "1.500");
  EXPECT_EQ(nominal_text(c), "");
  c.nominal = 1.25;
  EXPECT_EQ(result_text(c), "1.500");
  EXPECT_EQ(nominal_text(c), "1.250");
  c.nominal = 0.0;
  EXPECT_EQ(result_text(c), "+1.500");
  EXPECT_EQ(nominal_text(c), "");
  c.value = -1.5;
  EXPECT_EQ(result_text(c), "-1.500");
  c.value = -1e-9;
  EXPECT_EQ(result_text(c), "0.000");
  c.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(result_text(c), "-");
}

TEST(NumberText, GivesEachUnitItsDecimals) {
  EXPECT_EQ(value_text(1.23456, "um"), "1.235");
  EXPECT_EQ(value_text(44.999999, "deg"), "45.00000");
  EXPECT_EQ(value_text(12.0, "mm"), "12.0000");
  EXPECT_EQ(value_text(-0.0001, "um"), "0.000");
  EXPECT_EQ(value_text(std::numeric_limits<double>::quiet_NaN(), "um"), "-");
}

TEST(NumberText, SaysTimesAsPeopleDo) {
  EXPECT_EQ(duration_text(4.2), "4.20 s");
  EXPECT_EQ(duration_text(59.999), "1 min 00.0 s");
  EXPECT_EQ(duration_text(723.44), "12 min 03.4 s");
  EXPECT_EQ(duration_text(3599.97), "1 h 00 min");
  EXPECT_EQ(duration_text(7500.0), "2 h 05 min");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(NumberText, GivesUncertaintiesTwoDigits) {
  EXPECT_EQ(uncertainty_text(0.4), "0.40");
  EXPECT_EQ(uncertainty_text(0.0123), "0.012");
  EXPECT_EQ(uncertainty_text(123.0), "123");
  EXPECT_EQ(uncertainty_text(0.0), "0");
}

TEST(NumberText, RoundsScalesUpToOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_up_125(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_up_125(0.0011), 0.002);
  EXPECT_DOUBLE_EQ(round_up_125(3.0), 5.0);
  EXPECT_DOUBLE_EQ(round_up_125(0.07), 0.1);
  EXPECT_DOUBLE_EQ(round_up_125(0.0), 1.0);
}

TEST(NumberText, MeasuresTheShareOfATolerance) {
  metrology::CharacteristicResult c;
  c.value = 44.99;
  c.nominal = 45.0;
  c.tolerance = 0.02;
  ASSERT_TRUE(used_share(c));
  EXPECT_NEAR(*used_share(c), 0.5, 1e-9);
  c.tolerance = 0.0;
  EXPECT_FALSE(used_share(c));
}

}  // namespace
}  // namespace frustum::report
