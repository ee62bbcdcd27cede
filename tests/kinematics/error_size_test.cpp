#include "kinematics/errors/error_size.hpp"

#include <gmock/gmock.h>

#include "kinematics/errors/error_assignment.hpp"

namespace frustum::kinematics {
namespace {

Machine machine() {
  return *Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
}

std::vector<std::string> told(const std::vector<std::string>& written,
                              std::initializer_list<double> xs, const AxisSpans& spans = {}) {
  std::vector<ErrorEntry> entries;
  for (const std::string& text : written) {
    auto entry = parse_error(text);
    if (!entry) return {to_string(entry.error().front())};
    entries.push_back(*std::move(entry));
  }
  const auto errors = resolve(machine(), entries, spans);
  if (!errors) return {to_string(errors.error().front())};
  std::vector<AxisPositions> places;
  for (const double x : xs) {
    places.emplace_back();
    places.back()[AxisLetter::X] = x;
  }
  std::vector<std::string> all;
  for (const Diagnostic& d : oversize_errors(machine(), *errors, places)) {
    all.push_back(to_string(d));
  }
  return all;
}

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

TEST(ErrorSize, Fault2_21_LargeErrorsAreToldAndLargerOnesRefused) {
  EXPECT_THAT(told({"EXX=linear 10um over 0mm..200mm", "EX0C=0.9mm"}, {0.0, 200.0}), IsEmpty());
  EXPECT_THAT(told({"EX0C=1.2mm"}, {0.0}),
              ElementsAre(StartsWith("warning: error EX0C is 1.2 mm")));
  EXPECT_THAT(told({"EXX=linear 10um over 0mm..1mm"}, {0.0, -250.0}),
              ElementsAre(StartsWith("warning: error EXX is -2.5 mm at X = -250 mm")));
  EXPECT_THAT(told({"EBX=linear 1mrad over 0mm..1mm"}, {0.0, 150.0}),
              ElementsAre(StartsWith("error: error EBX is 150 mrad at X = 150 mm")));
  EXPECT_THAT(told({"EX0C=1e12um"}, {0.0}),
              ElementsAre(StartsWith("error: error EX0C is 1e+09 mm")));
  // Between the ends of the blocks too.
  EXPECT_THAT(told({"EXX=tent 2mm at 100mm over 90mm..110mm"}, {0.0, 200.0}),
              ElementsAre(StartsWith("warning: error EXX is 2 mm at X = 100 mm")));
  EXPECT_THAT(told({"EXX=reversal 3mm"}, {0.0, 10.0}),
              ElementsAre(StartsWith("warning: error EXX is ")));
}

TEST(ErrorSize, Fault2_21_APolynomialIsHeldBeyondItsSpan) {
  // 1 + t + t^2 + t^3 mm over 10 mm: 4 mm at the upper end, wherever the axis goes then.
  EXPECT_THAT(told({"EXX=polynomial 1mm 1mm 1mm 1mm over 0mm..10mm"}, {0.0, 400.0}),
              ElementsAre(StartsWith("warning: error EXX is 4 mm at X = ")));
}

TEST(ErrorSize, Fault2_28_ZeroNeedsNoUnit) {
  EXPECT_THAT(told({"EX0C=0", "EB0C=0"}, {0.0}), IsEmpty());
  EXPECT_THAT(told({"EX0C=3"}, {0.0}), ElementsAre(StartsWith("error: ")));
}

TEST(ErrorSize, Fault2_61_AShapeOverHardlyAnyTravelIsRefused) {
  const AxisSpans hardly{{AxisLetter::Z, {100.0, 100.0 + 1.3e-6}}};
  EXPECT_THAT(told({"EXZ=linear 1um"}, {0.0}, hardly),
              ElementsAre(StartsWith("error: error EXZ = linear 1um: Z travels only 1.3e-06 mm")));
  EXPECT_THAT(told({"EXZ=linear 1um over 0mm..100mm"}, {0.0}, hardly), IsEmpty());
}

}  // namespace
}  // namespace frustum::kinematics
