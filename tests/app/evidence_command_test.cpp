// What a report says about part, operator, files and rules: the head of a job and of its plan.
#include <nlohmann/json.hpp>

#include "core/sha256.hpp"
#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class EvidenceSystem : public CommandLine {
 protected:
  void write_piece() const {
    const Outcome made = run("program cone --machine iwf-bc --out piece --chord-tolerance 1");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    replace_in("piece/cone.plan.toml", "[probe]",
               "[report]\npart = \"Cone\"\nserial_number = \"1\"\n[probe]");
    replace_in("piece/job.toml", "[output]", "[report]\nserial_number = \"2\"\n[output]");
  }
};

TEST_F(EvidenceSystem, Fault2_38_AJobAndItsPlanAndTheirFilesAreInTheResult) {
  write_piece();
  const Outcome first = run("run piece/job.toml --out a --quiet --export a/r.qif --export a/r.dfq");
  ASSERT_LE(first.exit_code, 1) << first.err;
  const json evidence = json::parse(read(folder_ / "a/result.json"))["evidence"];
  EXPECT_EQ(evidence["part"], "Cone");
  EXPECT_EQ(evidence["serial_number"], "2");
  EXPECT_TRUE(evidence["date"].is_null());
  ASSERT_EQ(evidence["files"].size(), 4U);
  for (const auto& [role, file] :
       {std::pair{"program", "cone.nc"}, {"plan", "cone.plan.toml"}, {"job", "job.toml"}}) {
    bool found = false;
    for (const json& entry : evidence["files"]) {
      if (entry["role"] != role) continue;
      found = true;
      EXPECT_EQ(entry["name"], file);
      EXPECT_EQ(entry["sha256"], sha256(read(folder_ / "piece" / file)));
    }
    EXPECT_TRUE(found) << role;
  }
  // Nothing of the clock: the same again to the last byte.
  ASSERT_LE(run("run piece/job.toml --out b --quiet --export b/r.qif --export b/r.dfq").exit_code,
            1);
  EXPECT_EQ(read(folder_ / "a/r.qif"), read(folder_ / "b/r.qif"));
  EXPECT_EQ(read(folder_ / "a/r.dfq"), read(folder_ / "b/r.dfq"));
}

TEST_F(EvidenceSystem, Fault2_38_MeasuredPointsCarryTheHeadOfTheirPlan) {
  write_piece();
  ASSERT_LE(run("run piece/job.toml --out a --quiet").exit_code, 1);
  const Outcome told =
      run("measure --plan piece/cone.plan.toml --points a/points.csv --e0 1.8um --json");
  ASSERT_LE(told.exit_code, 1) << told.err;
  const json evidence = json::parse(told.out)["evidence"];
  EXPECT_EQ(evidence["serial_number"], "1");
  EXPECT_EQ(evidence["measuring"]["accuracy"],
            "E0 = 1.8 µm; how errors grow with length is not stated, no U contains it");
  EXPECT_EQ(evidence["files"][1]["sha256"], sha256(read(folder_ / "a/points.csv")));
}

TEST_F(EvidenceSystem, Fault2_38_AWrongDateIsToldWithItsLine) {
  write_piece();
  replace_in("piece/job.toml", "serial_number = \"2\"", "date = \"yesterday\"");
  const Outcome told = run("run piece/job.toml --out a");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_NE(told.err.find("report.date"), std::string::npos) << told.err;
}

}  // namespace
}  // namespace frustum
