#include "core/units.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <charconv>
#include <concepts>
#include <numbers>
#include <string>

namespace frustum {
namespace {

template <typename A, typename B>
concept Addable = requires(A a, B b) {
  a + b;
};
static_assert(Addable<Mm, Mm>);
static_assert(!Addable<Mm, Rad>);
static_assert(!Addable<Mm, double>);

struct Case {
  const char* text;
  double value;
  UnitKind kind;
};

class ParseQuantity : public testing::TestWithParam<Case> {};

TEST_P(ParseQuantity, ReadsEveryUnitPeopleWrite) {
  const auto parsed = parse_quantity(GetParam().text);
  ASSERT_TRUE(parsed) << GetParam().text;
  EXPECT_DOUBLE_EQ(parsed->value, GetParam().value) << GetParam().text;
  EXPECT_EQ(parsed->kind, GetParam().kind) << GetParam().text;
}

constexpr double kDegree = std::numbers::pi / 180.0;
INSTANTIATE_TEST_SUITE_P(
    Texts, ParseQuantity,
    testing::Values(
        Case{"2 mm", 2.0, UnitKind::length}, Case{"10 um", 0.01, UnitKind::length},
        Case{"10um", 0.01, UnitKind::length}, Case{"10 \u00b5m", 0.01, UnitKind::length},
        Case{"10 \u03bcm", 0.01, UnitKind::length}, Case{"250 nm", 250e-6, UnitKind::length},
        Case{"1.5 m", 1500, UnitKind::length}, Case{"1e-3 in", 0.0254, UnitKind::length},
        Case{"1e-3 inch", 0.0254, UnitKind::length}, Case{"2inch", 50.8, UnitKind::length},
        Case{"-0.5 mm", -0.5, UnitKind::length}, Case{"+0.5mm", 0.5, UnitKind::length},
        Case{"  3\tmm  ", 3.0, UnitKind::length}, Case{".5 mm", 0.5, UnitKind::length},
        Case{"1 rad", 1.0, UnitKind::angle}, Case{"2 mrad", 0.002, UnitKind::angle},
        Case{"30 urad", 30e-6, UnitKind::angle}, Case{"30 \u00b5rad", 30e-6, UnitKind::angle},
        Case{"30 \u03bcrad", 30e-6, UnitKind::angle}, Case{"15 deg", 15 * kDegree, UnitKind::angle},
        Case{"7.2 arcsec", 7.2 * kDegree / 3600, UnitKind::angle}, Case{"7", 7.0, UnitKind::none},
        Case{"-1e2", -100.0, UnitKind::none}, Case{"0", 0.0, UnitKind::none}));

class ParseQuantityRefuses : public testing::TestWithParam<const char*> {};

TEST_P(ParseQuantityRefuses, WhatIsNoQuantity) {
  const auto parsed = parse_quantity(GetParam());
  ASSERT_FALSE(parsed) << GetParam();
  const Diagnostic& diagnostic = parsed.error().front();
  EXPECT_NE(diagnostic.message.find(std::string("'") + GetParam() + "'"), std::string::npos)
      << diagnostic.message;
  EXPECT_FALSE(diagnostic.hint.empty());
}

INSTANTIATE_TEST_SUITE_P(Texts, ParseQuantityRefuses,
                         testing::Values("", "   ", "mm", "ten mm", "1,5 mm", "nan mm", "inf um",
                                         "1e400 mm", "1e305 m", "+-5 um", "--5 um", "10 MM",
                                         "10 furlong", "10 um mm", "0x10 mm", "10 mm/min"));

TEST(ParseQuantity, NamesTheUnitsItKnows) {
  const auto parsed = parse_quantity("10 furlong");
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.error().front().message, "unknown unit 'furlong' in '10 furlong'");
  EXPECT_EQ(parsed.error().front().hint,
            "lengths: mm um nm m in; angles: deg rad mrad urad arcsec");
}

TEST(ParseLength, RefusesAnglesAndBareNumbers) {
  EXPECT_DOUBLE_EQ(parse_length("10 um").value().value, 0.01);
  EXPECT_FALSE(parse_length("10 urad"));
  EXPECT_FALSE(parse_length("10"));
  EXPECT_FALSE(parse_length("x"));
}

TEST(ParseAngle, RefusesLengthsAndBareNumbers) {
  EXPECT_DOUBLE_EQ(parse_angle("30 urad").value().value, 30e-6);
  EXPECT_FALSE(parse_angle("30 um"));
  EXPECT_FALSE(parse_angle("30"));
  EXPECT_FALSE(parse_angle("x"));
}

TEST(Quantity, ComputesWithinItsDimension) {
  constexpr Mm sum = 1.5_mm + 500.0_um;
  static_assert(sum.value == 2.0);
  static_assert((sum - 0.5_mm).value == 1.5);
  static_assert((-sum).value == -2.0);
  static_assert((2.0 * sum).value == 4.0 && (sum * 2.0).value == 4.0 && (sum / 2.0).value == 1.0);
  static_assert(sum / 0.5_mm == 4.0);
  static_assert(1.0_um < 1.0_mm);
  EXPECT_DOUBLE_EQ((180.0_deg).value, std::numbers::pi);
  EXPECT_DOUBLE_EQ((1.0_urad).value, 1e-6);
}

RC_GTEST_PROP(QuantityLaws, EveryDoubleSurvivesBeingWrittenInMillimetres, (double value)) {
  RC_PRE(std::abs(value) < 1e300);
  char digits[64];
  const auto written = std::to_chars(digits, digits + sizeof digits, value);
  const std::string text(digits, written.ptr);
  const auto parsed = parse_length(text + " mm");
  RC_ASSERT(parsed.has_value());
  RC_ASSERT(parsed->value == value);
}

}  // namespace
}  // namespace frustum
