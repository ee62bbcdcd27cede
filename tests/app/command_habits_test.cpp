// What all commands share: their output folder, how they refuse, and what they say meanwhile.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

class CommandHabitsSystem : public CommandLine {
 protected:
  void write_piece(const std::string& more = "") const {
    const Outcome made =
        run("program cone --machine iwf-bc --chord-tolerance 50 --out piece " + more);
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
};

TEST_F(CommandHabitsSystem, Fault2_32_ARunIntoAFolderThatAnotherWritesToIsRefused) {
  write_piece();
  fs::create_directories(folder_ / "out");
  const int other = open((folder_ / "out").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_GE(other, 0);
  ASSERT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
  const Outcome refused = run("run piece/job.toml --out out --json");
  close(other);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("out: error: another run is writing to this folder"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(nlohmann::json::parse(refused.out)["diagnostics"][0]["id"], "output-in-use");
}

TEST_F(CommandHabitsSystem, Fault2_32_AnExportInTheFolderIsOneOfTheSet) {
  write_piece();
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out/notes.txt") << "of the user";
  std::ofstream(folder_ / "out/points.csv") << "of an older run";
  const Outcome done = run("run piece/job.toml --out out --export out/part.csv --quiet");
  EXPECT_NE(done.exit_code, 2) << done.err;
  EXPECT_EQ(read(folder_ / "out/notes.txt"), "of the user");
  EXPECT_NE(read(folder_ / "out/part.csv").find("cone.equivalent_form"), std::string::npos);
  EXPECT_EQ(read(folder_ / "out/points.csv").rfind("feature,", 0), 0U);
}

TEST_F(CommandHabitsSystem, Fault2_43_AFolderThatCannotBeIsRefusedBeforeTheWork) {
  write_piece();
  std::ofstream(folder_ / "file") << "";
  for (const char* command :
       {"run piece/job.toml --out file", "run piece/job.toml --out file/out",
        "sensitivity piece/job.toml --out file", "compensate piece/job.toml --out file",
        "volumetric iwf-bc --grid 100 --out file/out", "program cone --machine iwf-bc --out file",
        "post piece/cone.nc --job piece/job.toml --to sinumerik -o no/cone.mpf",
        "cut piece/job.toml --mesh no/part.stl", "cut piece/job.toml --picture no/part.png",
        "cut piece/job.toml --removal no/part.csv"}) {
    const Outcome refused = run(command);
    EXPECT_EQ(refused.exit_code, 2) << command;
    EXPECT_NE(refused.err.find("cannot"), std::string::npos) << command << ": " << refused.err;
    EXPECT_EQ(refused.out, "") << command;
  }
}

}  // namespace
}  // namespace frustum
