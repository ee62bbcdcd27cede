// What is read from pipes, and output that cannot be written.
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

class StreamsSystem : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::ofstream(folder_ / "part.nc") << "G0 X1 Y2\nM30\n";
  }
  // The program's motions, however it is read.
  void expect_motions(const std::string& line) const {
    const Outcome outcome = shell(line);
    EXPECT_EQ(outcome.exit_code, 0) << line << outcome.err;
    EXPECT_NE(outcome.out.find("\"type\":\"traverse\""), std::string::npos) << line << outcome.out;
  }
};

TEST_F(StreamsSystem, Fault2_01_PipesAreRead) {
  const std::string parse = "frustum parse --dialect fanuc --canon ";
  expect_motions("cat part.nc | " + parse + "-");
  expect_motions("cat part.nc | " + parse + "/dev/stdin");
  expect_motions(parse + "- < part.nc");
  expect_motions(parse + "/dev/stdin < part.nc");
  expect_motions("mkfifo pipe; cat part.nc > pipe & " + parse +
                 "pipe; code=$?; kill $! 2>/dev/null; exit $code");
}

TEST_F(StreamsSystem, Fault2_01_ALongPipeIsReadWhole) {
  const Outcome outcome = shell(
      "{ echo G90; i=0; while [ $i -lt 20000 ]; do echo \"G0 X$i Y2 Z3 (block number $i)\"; "
      "i=$((i+1)); done; echo M30; } | frustum parse - --dialect fanuc --canon | tail -2 | head "
      "-1");
  EXPECT_NE(outcome.out.find("\"X\":19999"), std::string::npos) << outcome.out << outcome.err;
}

TEST_F(StreamsSystem, Fault2_01_AClosedInputIsNoEmptyProgram) {
  const Outcome outcome = shell("frustum parse - --canon <&-");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("standard input"), std::string::npos) << outcome.err;
  // What needs no input goes without.
  EXPECT_EQ(shell("frustum check part.nc --quiet <&-").exit_code, 0);
}

TEST_F(StreamsSystem, Fault2_02_OutputThatIsLostIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  for (const char* command :
       {"parse part.nc --canon", "check part.nc", "check part.nc --json", "check --list",
        "machines", "errors iwf-bc", "--help", "pose --machine iwf-bc --axes X=1 --json"}) {
    const Outcome outcome = shell(std::string("frustum ") + command + " > /dev/full");
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_NE(outcome.err.find("No space left on device"), std::string::npos)
        << command << outcome.err;
  }
  const Outcome closed = shell("frustum parse part.nc --canon >&-");
  EXPECT_EQ(closed.exit_code, 2);
  EXPECT_NE(closed.err.find("standard output"), std::string::npos) << closed.err;
}

TEST_F(StreamsSystem, Fault2_02_FilesThatCannotBeWrittenAreErrors) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  for (const char* command :
       {"check part.nc --sarif /dev/full", "check part.nc --baseline /dev/full --write-baseline",
        "post part.nc --machine three-axis --to fanuc -o /dev/full"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 2) << command << outcome.out;
    EXPECT_NE(outcome.err.find("No space left on device"), std::string::npos)
        << command << outcome.err;
  }
  EXPECT_FALSE(fs::is_regular_file("/dev/full")) << "the device is as it was";
}

TEST_F(StreamsSystem, DevicesAreWrittenAsTheyAre) {
  const Outcome outcome = shell("frustum check part.nc --quiet --sarif /dev/stdout | head -c 1");
  EXPECT_EQ(outcome.out, "{") << outcome.err;
}

}  // namespace
}  // namespace frustum
