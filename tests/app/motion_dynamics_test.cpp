// A ball bar on a machine whose masses and springs move the tip.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

constexpr const char* kCircle =
    "motion circle --machine iwf-bc --tool-length 150 --plane XY --length 50 --center 0,0,150 ";

class MotionDynamicsSystem : public CommandLine {};

TEST_F(MotionDynamicsSystem, TheBallBarReadsTheHarmonicSteadyState) {
  const json wanted = json::parse(
      read(fs::path(FRUSTUM_SOURCE_DIR) / "tests/data/dynamics.json"))["circle_spring_drives"];
  for (const char* method : {"quasi_static", "linear"}) {
    const Outcome outcome = run(std::string(kCircle) + "--feed 10000 --json --dynamics " + method);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json found = json::parse(outcome.out);
    EXPECT_EQ(found["dynamics"], method);
    for (const char* sense : {"ccw", "cw"}) {
      const std::vector<double> readings = found[std::string(sense) + "_um"];
      const double mean = std::accumulate(readings.begin(), readings.end(), 0.0) /
                          static_cast<double>(readings.size());
      const double range = found["evaluation"][std::string("G_") + sense + "_ls"];
      std::cout << method << ' ' << sense << ": mean " << mean << " um, G " << range << " um\n";
      EXPECT_NEAR(mean, wanted["mean_radial_um"].get<double>(), 0.05);
      EXPECT_NEAR(range, wanted["roundness_lsq_um"].get<double>(), 0.05);
    }
  }
}

TEST_F(MotionDynamicsSystem, OffReadsWhatItReadBefore) {
  const Outcome plain = run(std::string(kCircle) + "--feed 3000 --json");
  const Outcome off = run(std::string(kCircle) + "--feed 3000 --json --dynamics off");
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(plain.out, off.out);
}

TEST_F(MotionDynamicsSystem, RefusesWhatIsWrong) {
  const auto refusal = [&](const std::string& options) {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    return outcome.err;
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal(std::string(kCircle) + "--dynamics linear"), HasSubstr("needs --feed"));
  EXPECT_THAT(refusal(std::string(kCircle) + "--feed 1000 --dynamics lineer"), HasSubstr("linear"));
  EXPECT_THAT(refusal("motion circle --machine zx-yac --plane XY --length 50 --center 0,0,150 "
                      "--feed 1000 --dynamics linear"),
              HasSubstr("states no masses and springs"));
}

}  // namespace
}  // namespace frustum
