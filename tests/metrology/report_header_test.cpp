#include "metrology/plan/report_header.hpp"

#include <gtest/gtest.h>

#include "metrology/plan/inspection_plan.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

Diagnostics faults_of(const std::string& keys) {
  const auto plan = parse_plan(to_toml(test_part::plan()) + "\n[report]\n" + keys, "p.toml");
  return plan ? Diagnostics{} : plan.error();
}

TEST(ReportHeader, Fault2_38_IsReadFromAPlanAndWrittenBack) {
  InspectionPlan plan = test_part::plan();
  plan.header = {.part = "Cone \"A\"",
                 .part_number = "NAS-979",
                 .serial_number = "0042",
                 .order = "4711",
                 .operated_by = "A. Example",
                 .date = "2024-02-29T23:59:59",
                 .cmm = "CMM 7, no. 12"};
  const auto read = parse_plan(to_toml(plan));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->header, plan.header);
}

TEST(ReportHeader, Fault2_38_RefusesWhatIsNoDateAndWhatIsMisspelt) {
  for (const char* date :
       {"2026-11-23", "2000-02-29", "2026-11-23T00:00:00", "2026-01-02T03:04:05Z",
        "2026-01-02T03:04:05+01:00", "2026-01-02T03:04:05-14:00"}) {
    EXPECT_TRUE(faults_of(std::string("date = \"") + date + '"').empty()) << date;
  }
  for (const char* date :
       {"23.11.2026", "2026-13-01", "2026-00-10", "2026-02-29", "2026-11-31", "2026-11-23T24:00:00",
        "2026-11-23 10:00:00", "today", "2026-11-23Z", "2026-11-23T10:00:00z",
        "2026-11-23T10:00:00+1", "2026-11-23T10:00:00+14:30"}) {
    const Diagnostics faults = faults_of(std::string("date = \"") + date + '"');
    ASSERT_EQ(faults.size(), 1U) << date;
    EXPECT_EQ(faults.front().key, "report.date");
    EXPECT_EQ(faults.front().id, "wrong-date"_id);
  }
  EXPECT_EQ(faults_of("part = \"\"").front().id, "empty-text"_id);
  const Diagnostics misspelt = faults_of("oprator = \"x\"");
  ASSERT_EQ(misspelt.size(), 1U);
  EXPECT_NE(misspelt.front().hint.find("operator"), std::string::npos);
}

TEST(ReportHeader, Fault2_38_AJobGoesBeforeItsPlanKeyByKey) {
  const ReportHeader job{.serial_number = "2"};
  const ReportHeader plan{.part = "Cone", .serial_number = "1"};
  EXPECT_EQ(joined(job, plan), (ReportHeader{.part = "Cone", .serial_number = "2"}));
}

}  // namespace
}  // namespace frustum::metrology
