#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

std::string problem_of(const std::string& text) {
  const auto entry = parse_error(text);
  if (!entry) return entry.error().front().message;
  const auto errors = resolve(shipped("iwf-bc"), std::vector{*entry});
  return errors ? "accepted" : errors.error().front().message;
}

double value_at(const std::string& text, double q, const AxisSpans& spans = {}) {
  const auto entry = parse_error(text);
  EXPECT_TRUE(entry) << text;
  const ErrorName name = *ErrorName::parse(entry->name);
  const auto errors = resolve(shipped("iwf-bc"), std::vector{*entry}, spans);
  EXPECT_TRUE(errors) << text;
  AxisPositions at;
  at[name.axis] = q;
  return (*errors)[name.axis].component[static_cast<std::size_t>(name.direction)](name.axis, at);
}

TEST(ErrorName, ReadsIsoNamesTheirShortFormsAndTheLetterO) {
  for (const char* text : {"EX0C", "X0C", "EXOC", "XOC"}) {
    ASSERT_TRUE(ErrorName::parse(text)) << text;
    EXPECT_EQ(ErrorName::parse(text)->text(), "EX0C");
  }
  EXPECT_EQ(ErrorName::parse("EAB")->meaning(), "tilt motion of B about A");
  EXPECT_EQ(ErrorName::parse("EXX")->meaning(), "positioning of X");
  EXPECT_EQ(ErrorName::parse("EZC")->meaning(), "axial motion of C in Z");
  EXPECT_EQ(ErrorName::parse("EB0C")->meaning(), "orientation of C about B");
  for (const char* text : {"", "E", "EX", "EXQ", "EX1C", "nonsense", "EXXX"}) {
    EXPECT_FALSE(ErrorName::parse(text)) << text;
  }
}

TEST(GeometricErrors, LayShapesOverTheirSpan) {
  const AxisSpans spans{{AxisLetter::X, {4.0, 104.0}}, {AxisLetter::B, {-1.3, -0.3}}};
  EXPECT_NEAR(value_at("EXX=linear 10um", 50.0, spans), 0.01 * 50.0 / 100.0, 1e-15);
  EXPECT_NEAR(value_at("EYX=harmonic 1 10um", 54.0, spans), 0.01, 1e-15);
  EXPECT_NEAR(value_at("EYX=harmonic 1 10um", 104.0, spans), 0.0, 1e-15);
  EXPECT_NEAR(value_at("EXB=harmonic 2 10um", -0.5, spans),
              0.01 * std::cos(4 * std::numbers::pi * 0.5), 1e-15);
  EXPECT_NEAR(value_at("EXX=linear 10um over 0mm..200mm zero 20mm", 120.0), 0.005, 1e-15);
  EXPECT_NEAR(value_at("EBX=30 urad", 77.0), 30e-6, 1e-18);
  EXPECT_NEAR(value_at("EXY=harmonic 1 10um over -50mm..50mm + -10um", 0.0), 0.0, 1e-15);
}

TEST(GeometricErrors, NameWhatIsWrong) {
  EXPECT_EQ(problem_of("EB0C"), "'EB0C' is not an error");
  EXPECT_EQ(problem_of("nonsense=1um"), "unknown error name 'nonsense' for machine iwf-bc");
  EXPECT_EQ(problem_of("EX0A=1um"),
            "error EX0A: machine iwf-bc (t-(C)-Z-Y-b-X-B-C-w) has no axis A");
  EXPECT_EQ(problem_of("EB0C=10um"), "error EB0C = 10um: expected an angle");
  EXPECT_EQ(problem_of("EXX=10urad"), "error EXX = 10urad: expected a length");
  EXPECT_EQ(problem_of("EXX=10"), "error EXX = 10: the amount has no unit");
  EXPECT_EQ(problem_of("EX0C=linear 10um"),
            "error EX0C = linear 10um: a location error is a constant");
  EXPECT_EQ(
      problem_of("EXX=harmonic 0 10um"),
      "error EXX = harmonic 0 10um: the order of a harmonic is a whole number from 1 to 1000");
  EXPECT_EQ(problem_of("EXX=harmonic 2.5 10um"),
            "error EXX = harmonic 2.5 10um: the order of a harmonic is a whole number from 1 to "
            "1000");
  EXPECT_EQ(problem_of("EXX=linear 10um over 5mm"),
            "error EXX = linear 10um over 5mm: 'over 5mm' is not a span such as 0mm..200mm");
  EXPECT_EQ(problem_of("EXX=linear 10um sideways"),
            "error EXX = linear 10um sideways: 'sideways' is not understood here");
  EXPECT_EQ(
      problem_of("EB0X=30urad"),
      "error EB0X: X is the primary reference axis; its orientation errors are zero by choice");
}

TEST(ErrorFunction, InterpolatesATableAndHoldsItsEnds) {
  const ErrorFunction f(
      {TableTerm::of({{0.0, 1.0}, {10.0, 3.0}, {20.0, -1.0}}, TableKind::linear, false)});
  const auto at = [&](double x) {
    AxisPositions q;
    q[AxisLetter::X] = x;
    return f(AxisLetter::X, q);
  };
  EXPECT_DOUBLE_EQ(at(-5.0), 1.0);
  EXPECT_DOUBLE_EQ(at(5.0), 2.0);
  EXPECT_DOUBLE_EQ(at(15.0), 1.0);
  EXPECT_DOUBLE_EQ(at(99.0), -1.0);
}

}  // namespace
}  // namespace frustum::kinematics
