#include "dynamics/identification.hpp"

#include <gmock/gmock.h>

#include "core/random.hpp"
#include "dynamics/response.hpp"
#include "tests/dynamics/machines.hpp"
#include "tests/law_count.hpp"

namespace frustum::dynamics {
namespace {

// The direct responses and one across, with noise on magnitude and phase.
std::vector<FrequencyResponse> measured_on(const DynamicModel& model,
                                           const kinematics::AxisPositions& q, double noise,
                                           std::uint32_t draw) {
  std::vector<FrequencyResponse> responses{
      {0, 0, {}, {}}, {1, 1, {}, {}}, {2, 2, {}, {}}, {2, 1, {}, {}}};
  const Structure s = structure_at(model, q, 150.0);
  const RandomKey key{.seed = 25, .draw = draw};
  std::uint64_t index = 0;
  for (double f = 20.0; f <= 160.0; f += 4.0) {
    const auto g = tip_compliance(harmonic_system(s, f));
    for (FrequencyResponse& r : responses) {
      const double real = noise * normal(key, index++), imaginary = noise * normal(key, index++);
      r.frequencies.push_back(f);
      r.compliance.push_back(g(r.motion, r.force) *
                             std::exp(std::complex<double>(real, imaginary)));
    }
  }
  return responses;
}

const std::vector<std::string> kNames{"mount.stiffness.horizontal", "mount.stiffness.z",
                                      "mount.damping", "Y.carriage.stiffness", "X.drive.stiffness"};

kinematics::AxisPositions home_position() {
  kinematics::AxisPositions q;
  q[kinematics::AxisLetter::Z] = 300.0;
  return q;
}

TEST(Identification, FindsFactorsExactlyWithoutNoise) {
  const DynamicModel model = model_named("iwf-bc");
  DynamicModel truth = model;
  const double factors[] = {0.7, 1.4, 2.0, 0.8, 1.3};
  for (std::size_t i = 0; i < kNames.size(); ++i) truth = with_factor(truth, kNames[i], factors[i]);
  const auto found = identify_parameters(model, home_position(), 150.0,
                                         measured_on(truth, home_position(), 0.0, 0), kNames);
  ASSERT_TRUE(found) << to_string(found.error().front());
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    EXPECT_NEAR(found->parameters[i].factor / factors[i], 1.0, 1e-8) << kNames[i];
  }
  EXPECT_TRUE(found->not_separated.empty());
  EXPECT_LT(found->noise, 1e-8);
}

TEST(IdentificationLaws, IntervalsHoldTheTruthInTwoHundredRepetitions) {
  const DynamicModel model = model_named("iwf-bc");
  int held = 0, all = 0;
  const auto repeats = proof::law_count<std::uint32_t>(20, 4);
  for (std::uint32_t machine = 0; machine < 10; ++machine) {
    DynamicModel truth = model;
    std::vector<double> factors;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      factors.push_back(std::exp(uniform({.seed = 7, .draw = machine}, i) - 0.5));
      truth = with_factor(truth, kNames[i], factors.back());
    }
    for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
      const auto found = identify_parameters(
          model, home_position(), 150.0,
          measured_on(truth, home_position(), 0.05, 100 * machine + repeat), kNames);
      ASSERT_TRUE(found);
      for (std::size_t i = 0; i < kNames.size(); ++i, ++all) {
        const auto& p = found->parameters[i];
        held += p.low <= factors[i] && factors[i] <= p.high ? 1 : 0;
      }
      EXPECT_NEAR(found->noise, 0.05, 0.012);
    }
  }
  const double share = static_cast<double>(held) / all;
  std::cout << "within their 95 % intervals: " << 100.0 * share << " % of " << all << '\n';
  EXPECT_GE(share, 0.90);
  EXPECT_LE(share, 0.98);
}

TEST(Identification, SaysWhatCannotBeSeparated) {
  // Far below the first mode the mounts move tool and workpiece alike.
  const std::vector<std::string> names{"mount.stiffness.z", "Z.drive.stiffness"};
  const DynamicModel model = model_named("iwf-bc");
  const Structure structure = structure_at(model, home_position(), 150.0);
  FrequencyResponse response{2, 2, {}, {}};
  for (const double share : {0.96, 1.05, 0.98, 1.01}) {
    response.frequencies.push_back(0.5 + 0.5 * static_cast<double>(response.frequencies.size()));
    response.compliance.push_back(
        share * tip_compliance(harmonic_system(structure, response.frequencies.back()))(2, 2));
  }
  const auto found =
      identify_parameters(model, home_position(), 150.0, std::vector{response}, names);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().front().message,
              testing::HasSubstr("show nothing of mount.stiffness.z"));
}

TEST(Identification, RefusesOverlapsControlsAndNothing) {
  const DynamicModel model = model_named("iwf-bc");
  auto measured = measured_on(model, home_position(), 0.0, 0);
  const auto refusal = [&](const DynamicModel& machine, const std::vector<std::string>& names) {
    const auto found = identify_parameters(machine, home_position(), 0.0, measured, names);
    EXPECT_FALSE(found);
    return found ? std::string() : found.error().front().message;
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal(model, {"mount.stiffness", "mount.stiffness.z"}), HasSubstr("same numbers"));
  EXPECT_THAT(refusal(model, {"mount.damping.horizontal", "mount.damping.x"}),
              HasSubstr("same numbers"));
  EXPECT_THAT(refusal(model, {"X.carriage.damping.normal", "X.carriage.damping"}),
              HasSubstr("same numbers"));
  EXPECT_THAT(refusal(model_named("iwf-bc", true), {"mount.stiffness"}), HasSubstr("controlled"));
  EXPECT_TRUE(identify_parameters(model, home_position(), 0.0, measured,
                                  {"mount.stiffness.horizontal", "mount.stiffness.z"}));
  measured.front().compliance[2] = 0.0;
  EXPECT_THAT(refusal(model, {"mount.stiffness"}), HasSubstr("has no phase"));
}

TEST(Identification, RefusesUnknownNamesAndTooFewLines) {
  const DynamicModel model = model_named("iwf-bc");
  const auto measured = measured_on(model, home_position(), 0.0, 0);
  const auto unknown =
      identify_parameters(model, home_position(), 150.0, measured, {"mount.stifness"});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().front().hint, testing::HasSubstr("mount.stiffness"));
  const std::vector<FrequencyResponse> one{{0, 0, {50.0}, {{1e-7, 0.0}}}};
  EXPECT_FALSE(identify_parameters(model, home_position(), 150.0, one,
                                   {"mount.stiffness", "mount.damping"}));
  EXPECT_FALSE(identify_parameters(model, home_position(), 150.0, measured,
                                   {"mount.stiffness", "mount.stiffness"}));
}

TEST(ResponseFiles, AreReadBackFromBothFormats) {
  const auto written = measured_on(model_named("iwf-bc"), home_position(), 0.0, 0);
  for (const std::string& text : {universal_file(written, "iwf-bc"), response_csv(written)}) {
    const auto read = read_responses(text, "frf");
    ASSERT_TRUE(read) << to_string(read.error().front());
    ASSERT_EQ(read->size(), written.size());
    for (std::size_t r = 0; r < written.size(); ++r) {
      EXPECT_EQ((*read)[r].name(), written[r].name());
      ASSERT_EQ((*read)[r].frequencies.size(), written[r].frequencies.size());
      for (std::size_t i = 0; i < written[r].frequencies.size(); ++i) {
        EXPECT_NEAR((*read)[r].frequencies[i], written[r].frequencies[i], 1e-9);
        EXPECT_LT(std::abs((*read)[r].compliance[i] - written[r].compliance[i]),
                  1e-11 * std::abs(written[r].compliance[i]));
      }
    }
  }
}

TEST(ResponseFiles, TakeAccelerancesOfSingleNumbersThatTouch) {
  const std::string text =
      "    -1\n    58\nhammer\nNONE\nNONE\nNONE\nNONE\n"
      "    4         0    0         0 TIP                1  -3 TIP                1   3\n"
      "         5         2         1  1.00000E+01  1.00000E+01  0.00000E+00\n"
      "        18    0    0    0 Frequency            Hz\n"
      "        12    0    0    0 Acceleration         m/s^2\n"
      "        13    0    0    0 Force                N\n"
      "         0    0    0    0 NONE                 NONE\n"
      "  1.00000E-03 -2.00000E-03 -3.00000E-03  4.00000D-03\n    -1\n";
  const auto read = read_responses(text, "frf.uff");
  ASSERT_TRUE(read) << to_string(read.error().front());
  const FrequencyResponse& r = read->front();
  EXPECT_EQ(r.name(), "Gzz");
  const double w = 2.0 * std::numbers::pi * 20.0;
  const std::complex<double> wanted = std::complex<double>(-3e-3, 4e-3) / (w * w);
  EXPECT_LT(std::abs(r.compliance[1] - wanted), 1e-18);
}

TEST(ResponseFiles, NameTheLineOfWhatIsWrong) {
  const struct {
    const char* text;
    int line;
    const char* told;
  } kBad[] = {{"frequency_hz,Gxx_re,Gxx_im\n1,2,x\n", 2, "'x' is not a number"},
              {"frequency_hz,Gxq_re,Gxq_im\n1,2,3\n", 1, "are no response"},
              {"f,Gxx_re,Gxx_im\n1,2,3\n", 1, "names no frequency"},
              {"frequency_hz,Gxx_re,Gxx_im\n1,2\n", 2, "2 cells, expected 3"},
              {"frequency_hz,Gxx_re,Gxx_im\n2,1,0\n1,1,0\n", 0, "does not rise"},
              {"", 0, "no frequency response"},
              {"    -1\n    58\n", 3, "ends too soon"}};
  for (const auto& bad : kBad) {
    const auto read = read_responses(bad.text, "frf.csv");
    ASSERT_FALSE(read) << bad.text;
    EXPECT_EQ(read.error().front().line, bad.line) << bad.text;
    EXPECT_THAT(read.error().front().message, testing::HasSubstr(bad.told));
  }
}

}  // namespace
}  // namespace frustum::dynamics
