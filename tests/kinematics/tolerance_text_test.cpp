// Tolerances, triangular laws and random fields as people write them.
#include <gtest/gtest.h>

#include <cmath>

#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_draw.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

Distribution distribution_of(const std::string& text) {
  const auto read = parse_distribution(text);
  EXPECT_TRUE(read) << text;
  return read ? *read : Distribution{};
}

TEST(ToleranceText, IsReadAsTheLawThatIsWrittenElseAsTheOneGiven) {
  const Distribution plain = distribution_of("nominal 17urad tolerance 4urad");
  EXPECT_EQ(plain.kind, Distribution::Kind::tolerance);
  const Distribution uniform = plain.read_as(ToleranceReading::uniform);
  EXPECT_EQ(uniform.kind, Distribution::Kind::uniform);
  EXPECT_NEAR(uniform.lo, 13e-6, 1e-20);
  EXPECT_NEAR(uniform.hi, 21e-6, 1e-20);
  EXPECT_NEAR(plain.read_as(ToleranceReading::normal_2sd).deviation, 2e-6, 1e-20);
  EXPECT_FALSE(plain.read_as(ToleranceReading::normal_3sd).limit);
  const Distribution cut = plain.read_as(ToleranceReading::normal_3sd_cut);
  EXPECT_NEAR(cut.deviation, 4e-6 / 3.0, 1e-20);
  EXPECT_NEAR(*cut.limit, 4e-6, 1e-20);
  EXPECT_EQ(distribution_of("nominal 0um tolerance 3um as triangular")
                .read_as(ToleranceReading::uniform)
                .kind,
            Distribution::Kind::triangular);
  // A written law is never read otherwise.
  EXPECT_EQ(distribution_of("uniform -1um..1um").read_as(ToleranceReading::normal_3sd).kind,
            Distribution::Kind::uniform);
}

TEST(ToleranceText, IsWrittenAsItIsRead) {
  for (const char* text :
       {"linear nominal 2um tolerance 3um as normal-3sd-cut", "harmonic 2 triangular -1um..3um",
        "field 3um correlation 40mm kernel matern32 over 0mm..200mm"}) {
    const auto entry = parse_error(std::string("EXX=") + text);
    ASSERT_TRUE(entry) << text << to_string(entry.error().front());
    const std::string again = written(entry->terms);
    const auto twice = parse_error("EXX=" + again);
    ASSERT_TRUE(twice) << again;
    EXPECT_EQ(written(twice->terms), again);
  }
}

TEST(ToleranceText, MistakesAreNamed) {
  for (const auto& [text, what] :
       {std::pair{"EXX=nominal 2um", "'nominal' needs its tolerance"},
        std::pair{"EXX=nominal 2um tolerance -1um", "the tolerance must be above 0"},
        std::pair{"EXX=nominal 2um tolerance 1urad", "different units"},
        std::pair{"EXX=nominal 2um tolerance 1um as normal", "'normal' is no reading"},
        std::pair{"EXX=field 3um", "needs its correlation length"},
        std::pair{"EXX=field uniform 0um..3um correlation 4mm", "its standard deviation"},
        std::pair{"EXX=field 3um correlation 4mm kernel flat", "'flat' is no kernel"}}) {
    const auto entry = parse_error(text);
    ASSERT_FALSE(entry) << text;
    EXPECT_NE(entry.error().front().message.find(what), std::string::npos)
        << entry.error().front().message;
  }
}

TEST(ToleranceText, DrawsStayWithinAndScatterAsTheLawDoes) {
  const RandomKey key{7, 0, RandomPurpose::error_amount};
  const Distribution triangular = distribution_of("triangular -2um..4um");
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 20000;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double x = drawn_from(triangular, key, i) * 1e3;
    EXPECT_GE(x, -2.0);
    EXPECT_LE(x, 4.0);
    sum += x;
    squares += (x - 1.0) * (x - 1.0);
  }
  // Variance 36 / 24 = 1.5; four standard errors.
  EXPECT_NEAR(sum / kDraws, 1.0, 4.0 * std::sqrt(1.5 / kDraws));
  EXPECT_NEAR(squares / kDraws, 1.5, 4.0 * 1.5 * std::sqrt(1.4 / kDraws));
}

TEST(ToleranceText, AFieldIsRefusedWhereNobodyDrawsIt) {
  const auto entry = parse_error("EXX=field 3um correlation 40mm");
  ASSERT_TRUE(entry);
  const auto resolved = resolve(shipped("three-axis"), {&*entry, 1});
  ASSERT_FALSE(resolved);
  EXPECT_NE(resolved.error().front().message.find("drawn by a study"), std::string::npos);
}

}  // namespace
}  // namespace frustum::kinematics
