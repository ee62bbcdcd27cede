// Circles of two linear axes: G, F, D and the signature of every case that was computed apart.
#include "instruments/circle_evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>

#include "core/random.hpp"
#include "instruments/approach.hpp"
#include "instruments/circle_test.hpp"
#include "instruments/readings.hpp"
#include "instruments/sample_angles.hpp"
#include "instruments/signature.hpp"
#include "tests/instruments/motion_numbers.hpp"

namespace frustum::instruments {
namespace {

using kinematics::ForwardChain;
using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::shipped;

const std::vector<double>& full_turn() {
  static const std::vector<double> kAngles = midpoints(0.0, 360.0 * kRadPerDeg, kSamplesOfATurn);
  return kAngles;
}

// Both runs of a circle on a machine with errors.
std::vector<CircleTrace> traces_of(const Machine& machine, const GeometricErrors& errors,
                                   CircleTest circle, const SetupErrors& setup) {
  std::vector<CircleTrace> traces;
  for (const Sense sense : kSenses) {
    circle.sense = sense;
    const auto test = circle_test(machine, circle);
    EXPECT_TRUE(test);
    if (!test) continue;
    traces.push_back({sense, circle.angles,
                      bar_readings(ForwardChain(machine, errors, circle.tool_length),
                                   with_approach(*test, errors), setup)});
  }
  return traces;
}

double unit_of(SignatureTerm term) {
  return term == SignatureTerm::square ? kUradPerRad : kUmPerMm;
}

void expect_signature(const Signature& found, const json& numbers, double within,
                      const std::string& what) {
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const auto term = static_cast<SignatureTerm>(k);
    const std::string name(text_of(term).name);
    EXPECT_NEAR(found[term] * unit_of(term), numbers[name].get<double>(), within) << what << name;
  }
}

void expect_values(const CircleValues& values, const json& numbers, const std::string& what) {
  const auto near = [&](const char* name, double value, double within) {
    if (numbers.contains(name)) {
      EXPECT_NEAR(value * kUmPerMm, numbers[name].get<double>(), within) << what << name;
    }
  };
  constexpr double kRange = 1.1e-6, kZone = 1.1e-6;
  near("G_ccw_ls", values.ccw->g_least_squares, kRange);
  near("G_cw_ls", values.cw->g_least_squares, kRange);
  near("G_bi_ls", values.g_bi_least_squares, kRange);
  near("G_ccw_mz", values.ccw->g_minimum_zone, kZone);
  near("G_bi_mz", values.g_bi_minimum_zone, kZone);
  near("D_mean_radial", values.d_mean_radial, kRange);
  near("F_ccw_max", values.ccw->f_max, kRange);
  near("F_ccw_min", values.ccw->f_min, kRange);
  near("F_cw_max", values.cw->f_max, kRange);
  near("F_cw_min", values.cw->f_min, kRange);
  if (numbers.contains("centre_bi")) {
    EXPECT_NEAR(values.both.x * kUmPerMm, numbers["centre_bi"][0].get<double>(), kRange) << what;
    EXPECT_NEAR(values.both.y * kUmPerMm, numbers["centre_bi"][1].get<double>(), kRange) << what;
  }
}

TEST(CircleEvaluationReference, FourteenCircles) {
  int held = 0;
  for (const json& numbers : motion_numbers()["plane"]) {
    const std::string what = numbers["name"].get<std::string>() + " ";
    const Machine machine = shipped(numbers["machine"]);
    const double length = numbers["bar_mm"];
    const auto traces = traces_of(machine, errors_of(machine, error_texts(numbers["errors"])),
                                  {.plane = *plane_named(numbers["plane"].get<std::string>()),
                                   .length = length,
                                   .centre = vector_of(numbers["centre_mm"]),
                                   .angles = full_turn(),
                                   .tool_length = tool_length_of(machine)},
                                  setup_of(numbers["setup_um"]));
    for (const auto& [degrees, um] : numbers["ccw_um_at_deg"].items()) {
      const auto index = static_cast<std::size_t>(std::lround(std::stod(degrees) * 10.0 - 0.5));
      EXPECT_NEAR(traces[0].deviation[index] * kUmPerMm, um.get<double>(), 1.1e-6)
          << what << degrees;
    }
    const auto values = circle_values(traces);
    ASSERT_TRUE(values) << what;
    expect_values(*values, numbers, what);
    const auto found = signature(traces, length);
    ASSERT_TRUE(found) << what;
    expect_signature(*found, numbers["signature"], 1.1e-6, what);
    EXPECT_NEAR(found->residual_rms * kUmPerMm, numbers["residual_rms"].get<double>(), 1.1e-6);
    for (const Contribution& each : contributions(traces, *found, length)) {
      std::string name = each.term ? std::string(text_of(*each.term).name) : "residual";
      if (name == "square_urad") name = "square";
      EXPECT_NEAR(each.width * kUmPerMm, numbers["contribution_um"][name].get<double>(), 1.1e-6)
          << what << name;
    }
    ++held;
  }
  EXPECT_EQ(held, 14);
}

// The text of a machine file with another servo gain of an axis.
std::string with_gain(std::string text, const std::string& axis, double gain) {
  const auto at = text.find("servo_gain", text.find("[axis." + axis + "]"));
  text.replace(at, text.find('\n', at) - at, "servo_gain = " + std::to_string(gain));
  return text;
}

TEST(CircleEvaluationReference, ServoLagOfUnequalGains) {
  std::ifstream file(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  for (const json& numbers : motion_numbers()["servo_lag"]) {
    const std::string changed =
        with_gain(with_gain(text, "X", numbers["gain_1_s"][0]), "Y", numbers["gain_1_s"][1]);
    const auto machine = Machine::read(changed, "lag.toml");
    ASSERT_TRUE(machine) << to_string(machine.error().front());
    const double length = numbers["radius_mm"];
    const auto traces = traces_of(*machine, {},
                                  {.length = length,
                                   .centre = {0.0, 0.0, 150.0},
                                   .angles = full_turn(),
                                   .feed = numbers["feed_mm_min"].get<double>() / 60.0},
                                  {});
    const auto values = circle_values(traces);
    ASSERT_TRUE(values);
    expect_values(*values, numbers, "lag ");
    const auto found = signature(traces, length);
    ASSERT_TRUE(found);
    expect_signature(*found, numbers["signature"], 1.1e-6, "lag ");
    EXPECT_NEAR(found->residual_rms * kUmPerMm, numbers["residual_rms"].get<double>(), 1.1e-6);
  }
}

// One reading a degree, both directions, noise of 1 um.
TEST(CircleEvaluationReference, WhatPartialArcsTell) {
  for (const auto& [arc, numbers] : motion_numbers()["arc_noise_sd_per_um"].items()) {
    std::smatch limits;
    ASSERT_TRUE(std::regex_match(arc, limits, std::regex(R"((-?\d+)\.\.(-?\d+))")));
    const double from = std::stod(limits[1]), to = std::stod(limits[2]);
    const auto angles = midpoints(from * kRadPerDeg, to * kRadPerDeg, static_cast<int>(to - from));
    std::vector<CircleTrace> traces;
    for (const Sense sense : kSenses) {
      traces.push_back({sense, angles, std::vector<double>(angles.size(), 0.0)});
    }
    const auto found = signature(traces, 150.0);
    ASSERT_TRUE(found) << arc;
    for (std::size_t k = 0; k < kSignatureTerms; ++k) {
      const auto term = static_cast<SignatureTerm>(k);
      const std::string name(text_of(term).name);
      // For noise of 1 um: um, or urad.
      const double sd = found->sd_per_noise[k] * unit_of(term) / kUmPerMm;
      EXPECT_NEAR(sd, numbers[name].get<double>(), 6e-6 * std::max(1.0, sd)) << arc << name;
    }
  }
}

TEST(CircleEvaluationReference, PublishedSquarenessGoesRound) {
  const Machine machine = shipped("dvf5000");
  for (const json& numbers : motion_numbers()["published_squareness"]) {
    std::vector<std::string> texts;
    for (const auto& [name, value] : numbers["published_urad"].items()) {
      texts.push_back(name + "=" + value.dump() + "urad");
    }
    const GeometricErrors errors = errors_of(machine, texts);
    kinematics::AxisPositions middle;
    middle[kinematics::AxisLetter::Z] = -240.0;
    const Vec3 centre = nominal_pose(machine, middle, 150.0).translation;
    for (const Plane plane : kPlanes) {
      const json& of_plane = numbers[std::string(name_of(plane))];
      const auto traces = traces_of(machine, errors,
                                    {.plane = plane,
                                     .length = 150.0,
                                     .centre = centre,
                                     .angles = full_turn(),
                                     .tool_length = 150.0},
                                    {});
      const auto values = circle_values(traces);
      ASSERT_TRUE(values);
      // Where the circle was is not in the file: that changes what is of second order.
      EXPECT_NEAR(values->ccw->g_least_squares * kUmPerMm, of_plane["G_ls"].get<double>(), 2e-3)
          << name_of(plane);
      const auto found = signature(traces, 150.0);
      ASSERT_TRUE(found);
      const double sin2 = -0.5 * (*found)[SignatureTerm::square] * 150.0;
      EXPECT_NEAR(sin2 * kUmPerMm, of_plane["sin2_um"].get<double>(), 1e-3) << name_of(plane);
    }
  }
}

// One direction alone: servo mismatch is not told from squareness.
TEST(CircleEvaluation, OneRunDoesNotTellServoFromSquareness) {
  const Machine machine = shipped("zx-yac");
  auto traces =
      traces_of(machine, errors_of(machine, {"EC0Y=30urad"}),
                {.length = 150.0, .centre = {0.0, 0.0, 150.0}, .angles = full_turn()}, {});
  traces.pop_back();
  const auto found = signature(traces, 150.0);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->both_senses);
  EXPECT_EQ((*found)[SignatureTerm::servo], 0.0);
  EXPECT_EQ(found->sd_per_noise[static_cast<std::size_t>(SignatureTerm::servo)], 0.0);
  EXPECT_NEAR((*found)[SignatureTerm::square] * kUradPerRad, 30.0, 1e-4);
  const auto values = circle_values(traces);
  ASSERT_TRUE(values);
  EXPECT_FALSE(values->cw);
}

TEST(CircleEvaluation, ShortArcsAndFewSamplesAreRefused) {
  const std::vector<double> few{0.0, 1.0};
  EXPECT_EQ(least_squares_circle({few, few}).error().front().id.text(), "too-few-samples");
  const auto angles = midpoints(0.0, 1e-5, 20);
  const std::vector<double> zero(20, 0.0);
  EXPECT_EQ(least_squares_circle({angles, zero}).error().front().id.text(), "arc-too-short");
  const std::vector<CircleTrace> traces{{Sense::ccw, midpoints(0.0, 0.05, 20), zero}};
  EXPECT_EQ(signature(traces, 150.0).error().front().id.text(), "arc-too-short");
}

TEST(CircleEvaluation, CirclesThatCannotBeRunAreRefused) {
  const Machine machine = shipped("iwf-bc");
  const auto refused = [&](const CircleTest& circle) {
    const auto test = circle_test(machine, circle);
    return test ? std::string("accepted") : std::string(test.error().front().id.text());
  };
  EXPECT_EQ(refused({.length = 900.0, .angles = full_turn()}), "axis-overtravel");
  EXPECT_EQ(refused({.length = 0.0, .angles = full_turn()}), "out-of-range");
  EXPECT_EQ(refused({.length = 150.0}), "no-samples");
  // Two samples within travel, the arc between them beyond it.
  EXPECT_EQ(refused({.length = 300.0,
                     .centre = {150.0, 0.0, 0.0},
                     .angles = {-80.0 * kRadPerDeg, 80.0 * kRadPerDeg}}),
            "axis-overtravel");
}

// The terms of a random circle come back, on full circles and arcs.
TEST(SignatureLaws, ItsTermsComeBack) {
  const RandomKey key{.seed = 24, .purpose = RandomPurpose::test_data};
  for (std::uint64_t n = 0; n < 50; ++n) {
    const double from = -180.0 * uniform(key, 40 * n),
                 arc = 120.0 + 240.0 * uniform(key, 40 * n + 1);
    const auto angles = midpoints(from * kRadPerDeg, (from + arc) * kRadPerDeg, 721);
    std::array<double, kSignatureTerms> x{};
    for (std::size_t k = 0; k < kSignatureTerms; ++k) x[k] = 0.01 * normal(key, 40 * n + 2 + k);
    x[4] *= 1e-2;  // square, rad
    std::vector<CircleTrace> traces;
    for (const Sense sense : kSenses) {
      CircleTrace trace{.sense = sense, .angle = angles};
      const double w = sign_of(sense);
      for (const double phi : angles) {
        const double c = std::cos(phi), s = std::sin(phi);
        const double head1 = s > 0.0 ? -w : w, head2 = c > 0.0 ? w : -w;
        trace.deviation.push_back(x[0] + x[1] * c + x[2] * s + x[3] * std::cos(2.0 * phi) -
                                  0.5 * x[4] * 150.0 * std::sin(2.0 * phi) +
                                  0.5 * w * x[5] * std::sin(2.0 * phi) - 0.5 * x[6] * head1 * c -
                                  0.5 * x[7] * head2 * s);
      }
      traces.push_back(std::move(trace));
    }
    const auto found = signature(traces, 150.0);
    ASSERT_TRUE(found);
    for (std::size_t k = 0; k < kSignatureTerms; ++k) {
      EXPECT_NEAR(found->value[k], x[k], 1e-11 * (k == 4 ? 0.01 : 1.0)) << arc << " " << k;
    }
  }
}

// 95 % intervals hold in 94 to 96 %: noise of the bar on both runs of a circle.
TEST(SignatureLaws, IntervalsHoldAsOftenAsTheySay) {
  const auto angles = midpoints(-20.0 * kRadPerDeg, 200.0 * kRadPerDeg, 110);
  const RandomKey key{.seed = 5, .purpose = RandomPurpose::test_data};
  constexpr int kDraws = 4000;
  constexpr double kNoise = 1e-3;
  int held = 0;
  double squares = 0.0;
  std::array<double, kSignatureTerms> expected{};
  for (int n = 0; n < kDraws; ++n) {
    std::vector<CircleTrace> traces;
    for (const Sense sense : kSenses) {
      CircleTrace trace{sense, angles, {}};
      for (std::size_t i = 0; i < angles.size(); ++i) {
        const auto index =
            static_cast<std::uint64_t>(n) * 1000 + (sense == Sense::ccw ? 0U : 500U) + i;
        trace.deviation.push_back(kNoise * normal(key, index));
      }
      traces.push_back(std::move(trace));
    }
    const auto found = signature(traces, 150.0);
    ASSERT_TRUE(found);
    expected = found->sd_per_noise;
    const double scale = (*found)[SignatureTerm::scale];
    squares += scale * scale;
    // 212 degrees of freedom: Student's 97.5 % is 1.971.
    const auto at = static_cast<std::size_t>(SignatureTerm::scale);
    if (std::abs(scale) <= 1.971 * found->sd[at]) ++held;
  }
  const double share = static_cast<double>(held) / kDraws;
  EXPECT_GT(share, 0.94);
  EXPECT_LT(share, 0.96);
  const double sd = std::sqrt(squares / kDraws);
  EXPECT_NEAR(sd / (kNoise * expected[static_cast<std::size_t>(SignatureTerm::scale)]), 1.0, 0.05);
}

// The minimum zone of random traces against circles moved at random: none is narrower.
TEST(MinimumZoneLaws, NoCircleHasANarrowerZone) {
  const RandomKey key{.seed = 9, .purpose = RandomPurpose::test_data};
  for (std::uint64_t n = 0; n < 20; ++n) {
    const auto angles = midpoints(0.0, (90.0 + 270.0 * uniform(key, 5000 * n)) * kRadPerDeg, 360);
    std::vector<double> deviation;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      deviation.push_back(1e-3 * normal(key, 5000 * n + 1 + i));
    }
    const PolarSamples samples{angles, deviation};
    const auto zone = minimum_zone(samples);
    ASSERT_TRUE(zone);
    const auto start = least_squares_circle(samples);
    EXPECT_LE(*zone, range_about(samples, *start).width());
    double narrowest = 1.0;
    for (std::uint64_t k = 0; k < 2000; ++k) {
      const double step = 1e-3 * uniform(key, 5000 * n + 1000);
      const PolarCircle moved{0.0, start->x + step * normal(key, 5000 * n + 1001 + 2 * k),
                              start->y + step * normal(key, 5000 * n + 1002 + 2 * k)};
      narrowest = std::min(narrowest, range_about(samples, moved).width());
    }
    EXPECT_GE(narrowest, *zone * (1.0 - 1e-12));
  }
}

}  // namespace
}  // namespace frustum::instruments
