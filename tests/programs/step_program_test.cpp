// The NC text of one pattern, word by word. A change is meant when FRUSTUM_UPDATE_GOLDEN is set:
// then the file is written anew, to be reviewed as a difference.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "programs/step/step_pattern.hpp"

namespace frustum::programs {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(StepProgramGolden, WritesTheProgramOfPattern1aWordByWord) {
  const std::string root = FRUSTUM_SOURCE_DIR;
  const auto machine = kinematics::Machine::load(root + "/machines/zx-yac.toml");
  ASSERT_TRUE(machine);
  StepTest test;
  test.patterns = {"1-a"};
  const auto made = step_pattern(test, *machine);
  ASSERT_TRUE(made) << to_string(made.error().front());
  const std::string file = root + "/tests/programs/data/step-1-a.nc";
  if (std::getenv("FRUSTUM_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(file, std::ios::binary) << made->piece.program;
  }
  std::ostringstream golden;
  golden << std::ifstream(file, std::ios::binary).rdbuf();
  const auto expected = lines_of(golden.str()), found = lines_of(made->piece.program);
  ASSERT_GT(expected.size(), 50U);
  for (std::size_t i = 0; i < std::min(expected.size(), found.size()); ++i) {
    EXPECT_EQ(found[i], expected[i]) << "line " << i + 1;
  }
  EXPECT_EQ(made->piece.program, golden.str());
}

}  // namespace
}  // namespace frustum::programs
