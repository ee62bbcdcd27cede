// The chains of eight machines at once against the chain of each.
#include "trials/population/lane_chain.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/random.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_draw.hpp"
#include "kinematics/model/chain.hpp"
#include "trials/population/lane_kernel.hpp"

namespace frustum::trials {
namespace {

using kinematics::AxisState;
using kinematics::ErrorEntry;
using kinematics::Machine;

constexpr RandomKey kKey{.seed = 11};

// Every error that the machine accepts, all drawn; component errors with a slope and a wave.
std::vector<ErrorEntry> every_error_drawn(const Machine& machine, const std::string& size) {
  std::vector<ErrorEntry> entries;
  for (const kinematics::ErrorName& name : machine.error_names()) {
    const std::string amount = "uniform -" + size +
                               (is_rotation(name.direction) ? "urad.." : "um..") + size +
                               (is_rotation(name.direction) ? "urad" : "um");
    std::string text = name.text() + "=" + amount;
    if (!name.location) {
      text += " + linear " + amount + " + harmonic 2 " + amount +
              " phase uniform 0deg..360deg + reversal " + amount;
    }
    entries.push_back(*kinematics::parse_error(text));
  }
  return entries;
}

AxisState somewhere(const Machine& machine, std::uint64_t place) {
  AxisState state;
  for (const kinematics::Joint& joint : machine.joints()) {
    const auto index = 100 * place + static_cast<std::uint64_t>(joint.letter);
    const double share = uniform(kKey, index);
    state.q[joint.letter] = joint.travel.lo + share * joint.travel.width();
    state.heading[joint.letter] = uniform(kKey, index + 50) < 0.5 ? -1.0 : 1.0;
  }
  return state;
}

struct Poses {
  std::vector<std::uint32_t> places{};
  std::vector<LanePose> poses{};
};

Vec3 lane_of(const LaneVec3& v, std::size_t lane) {
  return {v.x.of[lane], v.y.of[lane], v.z.of[lane]};
}

// mm: of the tip, and of a point 100 mm up the axis.
double worst_difference(const Machine& machine, const std::string& size) {
  const auto entries = every_error_drawn(machine, size);
  const auto laws = PopulationLaws::of(machine, entries, kinematics::AxisSpans{});
  EXPECT_TRUE(laws) << machine.name();
  if (!laws) return 1.0;
  const Pose table_from_workpiece{rotation_y(0.4) * rotation_x(-0.2), Vec3(30.0, -20.0, 80.0)};
  LaneChain chain(machine, *laws, table_from_workpiece);
  constexpr double kLength = 120.0;
  std::vector<AxisState> states;
  Poses found;
  for (std::uint64_t i = 0; i < 20; ++i) {
    states.push_back(somewhere(machine, i));
    found.places.push_back(chain.add(states.back(), kLength));
  }
  found.poses.resize(chain.size());
  std::vector<std::vector<ErrorEntry>> drawn;
  std::vector<Weights> weights;
  for (std::uint32_t d = 0; d < 5; ++d) {
    drawn.push_back(kinematics::draw(entries, 3, d));
    weights.push_back(laws->weights(drawn.back()));
  }
  chain.find(chain.machines(weights), found.places, found.poses);
  double worst = 0.0;
  for (std::size_t d = 0; d < drawn.size(); ++d) {
    const auto errors = *kinematics::resolve(machine, drawn[d]);
    const kinematics::ForwardChain one(machine, errors, kLength);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto pose =
          kinematics::tool_pose(table_from_workpiece.inverse() * one.table_from_tool(states[i]));
      worst = std::max({worst, (lane_of(found.poses[i].tip, d) - pose.tip).norm(),
                        100.0 * (lane_of(found.poses[i].axis, d) - pose.axis).norm()});
    }
  }
  return worst;
}

TEST(LaneChain, IsTheChainOfEachMachineOnAllShippedOnes) {
  int machines = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(FRUSTUM_SOURCE_DIR) + "/machines")) {
    if (file.path().extension() != ".toml") continue;
    const auto machine = Machine::load(file.path().string());
    if (!machine || machine->error_names().empty()) continue;
    ++machines;
    // 1e-12 mm: rounding of some forty products of half a metre.
    EXPECT_LT(worst_difference(*machine, "20"), 2e-12) << file.path();
  }
  EXPECT_GT(machines, 5);
}

// The series of small rotations ends at 0.01 rad.
TEST(LaneChain, TurnsByLargeErrorsToo) {
  const auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  EXPECT_LT(worst_difference(*machine, "9000"), 1e-11);
}

TEST(LaneChain, HasTheSameBitsWhateverTheRegisters) {
  const auto machine = *Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  const auto entries = every_error_drawn(machine, "30");
  const auto laws = *PopulationLaws::of(machine, entries, kinematics::AxisSpans{});
  LaneChain chain(machine, laws, Pose{});
  std::vector<std::uint32_t> places;
  for (std::uint64_t i = 0; i < 40; ++i) places.push_back(chain.add(somewhere(machine, i), 100.0));
  std::vector<Weights> weights;
  for (std::uint32_t d = 0; d < 8; ++d) {
    weights.push_back(laws.weights(kinematics::draw(entries, 4, d)));
  }
  const LaneMachines machines = chain.machines(weights);
  std::vector<LanePose> any(chain.size()), widest(chain.size());
  find_poses(chain.tables(), machines, places, any, Registers::any);
  find_poses(chain.tables(), machines, places, widest, Registers::widest);
  for (std::size_t i = 0; i < any.size(); ++i) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      EXPECT_EQ(lane_of(any[i].tip, lane), lane_of(widest[i].tip, lane));
      EXPECT_EQ(lane_of(any[i].axis, lane), lane_of(widest[i].axis, lane));
    }
  }
}

}  // namespace
}  // namespace frustum::trials
