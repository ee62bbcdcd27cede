// Every file that has a place for it says which version of Frustum made it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class VersionSystem : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    const Outcome piece = run("program cone --machine iwf-bc --out piece --quiet");
    ASSERT_EQ(piece.exit_code, 0) << piece.err;
  }
  void expect_made(const std::string& command, const std::vector<std::string>& files) const {
    const Outcome outcome = run(command + " --quiet");
    EXPECT_LE(outcome.exit_code, 1) << command << ": " << outcome.err;
    for (const std::string& file : files) {
      EXPECT_THAT(read(folder_ / file), HasSubstr("Frustum " + version())) << command;
    }
  }
  std::string version() const {
    static const std::string kVersion =
        json::parse(run("machines --json").out)[0].value("version", "none");
    return kVersion;
  }
};

TEST_F(VersionSystem, IsInEveryListAndTableOfKeys) {
  EXPECT_THAT(run("--version").out, HasSubstr(version()));
  for (const json& machine : json::parse(run("machines --json").out)) {
    EXPECT_EQ(machine.value("version", ""), version());
  }
  for (const char* file : {"piece/job.toml", "piece/cone.plan.toml"}) {
    EXPECT_TRUE(read(folder_ / file).starts_with("# Made by Frustum " + version() + "\n")) << file;
  }
  expect_made("compensate piece/job.toml --error EXX=\"linear 10um\" --out better",
              {"better/job.toml"});
  expect_made(
      "motion circle --machine iwf-bc --plane XY --length 100 --center=0,0,100 --out circle",
      {"circle/test.toml", "circle/motion.html"});
}

TEST_F(VersionSystem, IsInEveryFormatOfResultsAndDrawings) {
  expect_made(
      "run piece/job.toml --out out --export r.qif --export r.dmo --export r.dxf --export r.svg "
      "--export r.dfq --export r.xml",
      {"out/report.html", "r.dmo", "r.dxf", "r.svg"});
  for (const char* file : {"r.qif", "r.dfq", "r.xml"}) {
    EXPECT_THAT(read(folder_ / file), HasSubstr(version())) << file;
  }
  EXPECT_THAT(read(folder_ / "r.xml"),
              HasSubstr("<property name=\"frustum.version\" value=\"" + version() + "\""));
  EXPECT_TRUE(read(folder_ / "r.dxf").starts_with("999\nMade by Frustum " + version() + "\n"));
  EXPECT_THAT(read(folder_ / "r.svg"), HasSubstr("<desc>Made by Frustum"));
  expect_made("tools piece/job.toml --drawing t.dxf", {"t.dxf"});
  expect_made("tools piece/job.toml --drawing t.svg", {"t.svg"});
}

TEST_F(VersionSystem, IsInEveryMesh) {
  for (const char* ending : {"stl", "ply", "obj", "vtp"}) {
    const std::string file = std::string("m.") + ending;
    expect_made("cut piece/job.toml --pitch 6 --mesh " + file, {file});
  }
}

TEST_F(VersionSystem, IsInEveryPage) {
  expect_made("view piece/job.toml --snapshots 0 --out view", {"view/view.html"});
  expect_made("volumetric iwf-bc --grid 2 --out volume", {"volume/volumetric.html"});
  expect_made("sensitivity piece/job.toml --out table", {"table/sensitivity.html"});
  fs::create_symlink(fs::path(FRUSTUM_SOURCE_DIR) / "examples", folder_ / "examples");
  expect_made("history examples/history --out history", {"history/history.html"});
  expect_made("dynamics iwf-bc --axes Z=300 --frf 20:60 --out shaken",
              {"shaken/report.html", "shaken/frf.uff"});
}

}  // namespace
}  // namespace frustum
