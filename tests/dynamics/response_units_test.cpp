#include "dynamics/response_units.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <numbers>

#include "dynamics/response_files.hpp"

namespace frustum::dynamics {
namespace {

TEST(ResponseUnits, AreReadAsProgramsWriteThem) {
  const struct {
    int type;
    const char* label;
    int order;
    double si;
  } kKnown[] = {{12, "m/s^2", 2, 1.0},
                {12, "(m/s\xc2\xb2)/N", 2, 1.0},
                {1, "(1/N)*(m/s^2)", 2, 1.0},
                {0, "mm/s2", 2, 1e-3},
                {12, "g", 2, 9.80665},
                {11, "MM/S", 1, 1e-3},
                {8, "\xb5m/N", 0, 1e-6},
                {8, "NONE", 0, 0.5},
                {8, "", 0, 0.5}};
  for (const auto& known : kKnown) {
    const auto unit = motion_unit(known.type, known.label, 0.5);
    ASSERT_TRUE(unit) << known.label;
    EXPECT_EQ(unit->order, known.order) << known.label;
    EXPECT_DOUBLE_EQ(unit->si, known.si) << known.label;
  }
  EXPECT_FALSE(motion_unit(12, "mm", 1.0));     // contradicts the type
  EXPECT_FALSE(motion_unit(12, "ft/s2", 1.0));  // unknown
  EXPECT_FALSE(motion_unit(1, "NONE", 1.0));    // says nothing
  EXPECT_FALSE(motion_unit(15, "Pa", 1.0));
  EXPECT_EQ(force_unit(13, "kN", 1.0), 1e3);
  EXPECT_EQ(force_unit(0, "NONE", 0.1), 0.1);
  EXPECT_FALSE(force_unit(13, "lbf", 1.0));
  EXPECT_FALSE(force_unit(12, "N", 1.0));
}

struct Dataset {
  int function = 4;
  int node = 7, motion = 1, force = 1;
  const char* ordinate = "        12    0    0    0 Acceleration         m/s^2";
  const char* denominator = "        13    0    0    0 Force                N";
};
std::string text_of(const Dataset& d) {
  char place[128];
  std::snprintf(place, sizeof place, "%5d%10d%5d%10d NONE      %10d%4d NONE      %10d%4d\n",
                d.function, 0, 0, 0, d.node, d.motion, 3, d.force);
  return "    -1\n    58\nhammer\nNONE\n26-Nov-26 10:00:00\nNONE\nNONE\n" + std::string(place) +
         "         5         2         1  1.00000E+01  1.00000E+01  0.00000E+00\n"
         "        18    0    0    0 Frequency            Hz\n" +
         d.ordinate + "\n" + d.denominator +
         "\n         0    0    0    0 NONE                 NONE\n"
         "  1.00000E-03 -2.00000E-03 -3.00000E-03  4.00000E-03\n    -1\n";
}
double size_at_20_hz(const std::string& text) {
  const auto read = read_responses(text, "hammer.uff");
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error().front()));
  return read ? std::abs(read->front().compliance[1]) : 0.0;
}

TEST(ResponseFiles, PassOverOtherFunctionsBesideTheResponses) {
  const std::string text = text_of({.function = 1}) + text_of({.function = 6}) +
                           text_of({.motion = 0}) + text_of({.motion = -5}) + text_of({}) +
                           text_of({.motion = 3}) +
                           "    -1\n    58b     1     2          11        8     0     0           "
                           "0           0\n    -1\n";
  const auto read = read_responses(text, "hammer.uff");
  ASSERT_TRUE(read) << to_string(read.error().front());
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ((*read)[1].name(), "Gzx");
}

TEST(ResponseFiles, CountWithTheUnitsOfLabelsOrOfTheFile) {
  const double w = 2.0 * std::numbers::pi * 20.0;
  EXPECT_NEAR(size_at_20_hz(text_of({})), 5e-3 / (w * w), 1e-18);
  EXPECT_NEAR(
      size_at_20_hz(text_of({.ordinate = "        12    0    0    0 Acceleration         g"})),
      9.80665 * 5e-3 / (w * w), 1e-17);
  EXPECT_NEAR(
      size_at_20_hz(text_of({.ordinate = "         8    0    0    0 Displacement         mm",
                             .denominator = "        13    0    0    0 Force                kN"})),
      5e-9, 1e-18);
  // Millimetres and millinewtons, without labels.
  const std::string units =
      "    -1\n   164\n         5mm (milli newton)           2\n"
      "  1.0000000000000000D+03  1.0000000000000000D+03  1.0000000000000000D+00\n"
      "  2.7315000000000000D+02\n    -1\n";
  const Dataset bare{.ordinate = "         8    0    0    0 NONE                 NONE",
                     .denominator = "        13    0    0    0 NONE                 NONE"};
  EXPECT_NEAR(size_at_20_hz(text_of(bare)), 5e-3, 1e-12);
  EXPECT_NEAR(size_at_20_hz(units + text_of(bare)), 5e-3, 1e-12);
  EXPECT_NEAR(size_at_20_hz(units + text_of({})), 5e-3 / (w * w), 1e-18);
}

TEST(ResponseFiles, RefuseWhatIsNotOneResponseOfTheTip) {
  const auto refusal = [](const std::string& text) {
    const auto read = read_responses(text, "hammer.uff");
    EXPECT_FALSE(read);
    return read ? std::string() : to_string(read.error().front());
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal(text_of({}) + text_of({.node = 8})),
              HasSubstr("Gxx is there twice, of the nodes 7 and 3 and of the nodes 8 and 3"));
  EXPECT_THAT(refusal(text_of({.function = 6}) + text_of({.function = 1})),
              HasSubstr("2 of another function"));
  EXPECT_THAT(refusal("    -1\n    58b     1     2\n"), HasSubstr("1 in binary"));
  EXPECT_THAT(
      refusal(text_of({.ordinate = "        12    0    0    0 Acceleration         ft/s2"})),
      HasSubstr("'ft/s2'"));
  EXPECT_THAT(refusal(text_of({.denominator = "        12    0    0    0 Acceleration         g"})),
              HasSubstr("no force"));
}

}  // namespace
}  // namespace frustum::dynamics
