// frustum study: the same samples however they were made, on disk as others read them.
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "tests/app/command_line.hpp"
#include "tests/law_count.hpp"

namespace frustum {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class StudySamplesSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  // A pose of a machine: draws cost next to nothing.
  void write_pose_study(const std::string& more = {}) const {
    write("pose.toml",
          "target = \"volumetric\"\nmachine = \"iwf-bc\"\naxes = \"X=100,Y=-50,Z=200,B=-30,C=40\"\n"
          "tool_length = 150\nkeep = [\"characteristics\", \"amounts\"]\n" +
              more +
              "[errors]\nEXX = \"linear uniform -10um..10um\"\nEB0C = \"uniform "
              "-20urad..20urad\"\nEC0Y = \"normal 0urad sd 5urad\"\nEYX = \"harmonic 2 uniform "
              "0um..3um phase uniform 0deg..360deg\"\n[limits]\n\"volumetric.error\" = \"9 um\"\n");
  }
  // Everything that must not depend on how a study was run.
  std::map<std::string, std::string> results_in(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      if (!entry.is_regular_file() || entry.path().filename() == "run.json") continue;
      files[fs::relative(entry.path(), folder_ / folder).string()] = read(entry.path());
    }
    return files;
  }
  bool has(const std::string& command) const { return shell(command).exit_code == 0; }
};

TEST_F(StudySamplesSystem, AreTheSameForAnyThreads) {
  write_pose_study();
  for (const char* threads : {"1", "2", "8"}) {
    const Outcome outcome = run(std::string("study pose.toml --samples 3000 --quiet --csv ") +
                                threads + ".csv --out t" + threads + " --threads " + threads);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  const auto expected = results_in("t1");
  EXPECT_TRUE(expected.contains("samples/part-000000.h5"));
  EXPECT_TRUE(expected.contains("report.html"));
  EXPECT_EQ(results_in("t2"), expected);
  EXPECT_EQ(results_in("t8"), expected);
  EXPECT_EQ(read(folder_ / "1.csv"), read(folder_ / "8.csv"));
}

TEST_F(StudySamplesSystem, AreTheSameMergedFromParts) {
  write_pose_study();
  const std::string study = "study pose.toml --quiet --samples 132000 ";
  ASSERT_EQ(run(study + "--out whole").exit_code, 0);
  for (const char* part : {"1", "2", "3"}) {
    const Outcome outcome = run(study + "--part " + part + "/3 --out p" + part);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  const Outcome merged = run(study + "--out merged --merge p1 p2 p3");
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(results_in("merged"), results_in("whole"));
  ASSERT_EQ(run(study + "--part 1/1 --out one").exit_code, 0);
  EXPECT_EQ(results_in("one"), results_in("whole"));
  const Outcome missing = run(study + "--out few --merge p1 p3");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("missing"));
}

TEST_F(StudySamplesSystem, AreTheSameForAnyRanks) {
  if (!has("command -v mpirun")) GTEST_SKIP() << "there is no mpirun";
  write_pose_study();
  const std::string study = " study pose.toml --quiet --samples 70000 ";
  ASSERT_EQ(run(study + "--out r0").exit_code, 0);
  const auto expected = results_in("r0");
  for (const char* ranks : {"1", "2", "3", "7"}) {
    const Outcome outcome = shell(std::string("mpirun --allow-run-as-root --oversubscribe -n ") +
                                  ranks + " " FRUSTUM_PROGRAM + study + "--out r" + ranks);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(results_in(std::string("r") + ranks), expected) << ranks << " ranks";
  }
}

TEST_F(StudySamplesSystem, GrowAndShrinkWithResume) {
  write_pose_study();
  ASSERT_EQ(run("study pose.toml --quiet --samples 2500 --out few").exit_code, 0);
  ASSERT_EQ(run("study pose.toml --quiet --samples 9000 --out many").exit_code, 0);
  const auto few = results_in("few"), many = results_in("many");
  ASSERT_EQ(run("study pose.toml --quiet --samples 9000 --out few --resume").exit_code, 0);
  EXPECT_EQ(results_in("few"), many);
  ASSERT_EQ(run("study pose.toml --quiet --samples 2500 --out many --resume").exit_code, 0);
  EXPECT_EQ(results_in("many"), few);
  const Outcome other = run("study pose.toml --quiet --seed 2 --samples 9000 --out few --resume");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("another study"));
  EXPECT_EQ(results_in("few"), many) << "nothing was lost";
}

TEST_F(StudySamplesSystem, SurviveAnInterruption) {
  write_pose_study("engine = \"full\"\n");
  ASSERT_EQ(run("study pose.toml --quiet --samples 30000 --out whole").exit_code, 0);
  // The signal comes once the run has said how long it will take, whenever that is.
  const Outcome ended =
      shell("'" FRUSTUM_PROGRAM
            "' study pose.toml --samples 4000000000 --seed 1 --out cut 2>said & run=$!;"
            " until grep -q 'to come' said || ! kill -0 $run; do sleep 0.02; done;"
            " kill -INT $run; wait $run; code=$?; cat said >&2; exit $code");
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("--resume goes on"));
  // Hours: said before it starts.
  EXPECT_THAT(ended.err, testing::ContainsRegex("about [0-9.]+ (min|h) to come \\(4000000000 "
                                                "draws, engine full\\)"));
  EXPECT_FALSE(fs::exists(folder_ / "cut" / "result.json"));
  ASSERT_EQ(run("study pose.toml --quiet --samples 30000 --out cut --resume").exit_code, 0);
  EXPECT_EQ(results_in("cut"), results_in("whole"));
}

// Kills at random moments; what is on disk afterwards is whole, and a resumed study is the same.
TEST_F(StudySamplesSystem, AreTheSameAfterKills) {
  write_pose_study();
  const std::string study = " study pose.toml --quiet --samples 200000 ";
  ASSERT_EQ(run(study + "--out whole").exit_code, 0);
  const auto expected = results_in("whole");
  const auto kills = proof::law_count<std::uint32_t>(30, 3);
  for (std::uint32_t i = 0; i < kills; ++i) {
    const double seconds = 0.05 + 0.6 * uniform({.seed = 5, .draw = i}, 0);
    const Outcome killed = shell("timeout -s KILL " + std::to_string(seconds) +
                                 " " FRUSTUM_PROGRAM + study + "--resume --out killed");
    ASSERT_TRUE(killed.exit_code == 137 || killed.exit_code == 0) << killed.err;
  }
  ASSERT_EQ(run(study + "--resume --out killed").exit_code, 0);
  EXPECT_EQ(results_in("killed"), expected);
}

TEST_F(StudySamplesSystem, SurviveAFullDisk) {
  write_pose_study();
  const std::string study = "study pose.toml --quiet --samples 40000 ";
  ASSERT_EQ(run(study + "--out whole").exit_code, 0);
  // No file may grow beyond 200 KiB, as when the disk is full.
  const Outcome full = shell("(trap '' XFSZ; ulimit -f 200; frustum " + study + "--out full)");
  EXPECT_EQ(full.exit_code, 2) << full.err;
  EXPECT_THAT(full.err, HasSubstr("samples"));
  ASSERT_EQ(run(study + "--out full --resume").exit_code, 0);
  EXPECT_EQ(results_in("full"), results_in("whole"));
}

TEST_F(StudySamplesSystem, OpenInH5py) {
  // Debian's package is for Debian's Python, which may not be the first one.
  std::string python;
  for (const char* each : {"python3", "/usr/bin/python3"}) {
    if (python.empty() && has(std::string(each) + " -c 'import h5py'")) python = each;
  }
  if (python.empty()) GTEST_SKIP() << "there is no h5py (scripts/setup --with-h5py)";
  write_pose_study();
  ASSERT_EQ(run("study pose.toml --quiet --samples 500 --csv all.csv --out o").exit_code, 0);
  write("check.py", R"(import csv, h5py, json
f = h5py.File('o/samples/part-000000.h5')
rows = list(csv.DictReader(open('all.csv')))
assert f.attrs['seed'] == 1 and f.attrs['first_draw'] == 0, dict(f.attrs)
assert len(f.attrs['frustum.study']) == 64
assert f['draw'].dtype == 'int64' and f['draw'][7] == 7
for name, unit in (('characteristics/volumetric.error', 'um'), ('amounts/EB0C/0', 'urad'),
                   ('amounts/EXX/0', 'um'), ('phases/EYX/0', 'deg')):
    d = f[name]
    got = d.attrs['unit']
    assert (got.decode() if isinstance(got, bytes) else got) == unit, (name, got)
    assert d.dtype == 'float64' and [float(r[name]) for r in rows] == list(d[:]), name
p = f['pass/volumetric.error']
assert p.dtype == 'uint8'
k = json.load(open('o/result.json'))['characteristics'][0]['conform']['k']
assert int(p[:].sum()) == k, (int(p[:].sum()), k)
)");
  const Outcome checked = shell(python + " check.py");
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

}  // namespace
}  // namespace frustum
