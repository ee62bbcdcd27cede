// QIF against the schema of QIF 3.0, which is not kept here: FRUSTUM_QIF_SCHEMA names
// QIFDocument.xsd, xmllint validates. Without them the test is skipped and says so.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "core/spline_surface.hpp"
#include "metrology/plan/plan_names.hpp"
#include "report/exchange/qif_results.hpp"
#include "tests/metrology/measured_feature.hpp"

namespace frustum::report {
namespace {

namespace fs = std::filesystem;
using metrology::CharacteristicKind;
using metrology::FeatureKind;

metrology::PlannedFeature planned_as(FeatureKind kind) {
  using namespace metrology::measured;
  const std::string name(metrology::kFeatureNames.at(static_cast<std::size_t>(kind)));
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  if (kind == FeatureKind::plane) return plane(name, {0, 0, 5}, z, 20 * x, 10 * y);
  if (kind == FeatureKind::line) return line(name, {0, -20, 5}, x, -y);
  if (kind == FeatureKind::point) return point(name, {1, 2, 3}, z);
  if (kind == FeatureKind::ruled) {
    metrology::PlannedFeature ruled{.name = name, .kind = kind};
    const std::vector<Vec3> lower{{0, 0, 0}, {9, 0, 0}}, upper{{0, 0, 5}, {9, 1, 5}};
    ruled.net.surface = std::make_shared<const SplineSurface>(SplineSurface::ruled(lower, upper));
    ruled.strategy = metrology::SurfaceLineStrategy{};
    return ruled;
  }
  metrology::PlannedFeature round = cylinder(name, {0, 0, 40}, z, 20.0);
  round.kind = kind;
  if (kind == FeatureKind::cone) round.half_angle = 0.5;
  return round;
}

// Every kind of characteristic of every kind of feature, meaningful or not.
struct Documents {
  std::string results{};
  std::string plan{};
};
Documents documents_of_all_kinds() {
  metrology::InspectionPlan plan;
  plan.datum = metrology::DatumSystem{"plane", "cylinder", "line"};
  RunReport report;
  report.title = "every kind";
  for (std::size_t f = 0; f < metrology::kFeatureNames.size(); ++f) {
    plan.features.push_back(planned_as(static_cast<FeatureKind>(f)));
    metrology::MeasuredFeature measured;
    measured.name = plan.features.back().name;
    measured.kind = measured.name;
    measured.parameters = {
        {"point", {0, 0, 5}}, {"axis", {0, 0, 1}}, {"radius", {20.0}}, {"half_angle", {0.5}}};
    measured.points = {{Vec3(1, 2, 3), Vec3::UnitX(), 0.001, 0}, {Vec3(0.1, 2, -3e-32)}};
    measured.form = 1.4210854715202004e-14;
    report.measurement.features.push_back(std::move(measured));
  }
  for (const metrology::PlannedFeature& feature : plan.features) {
    for (std::size_t k = 0; k < metrology::kCharacteristicNames.size(); ++k) {
      const auto kind = static_cast<CharacteristicKind>(k);
      auto planned = metrology::measured::characteristic(kind, {feature.name, "plane"});
      planned.name = feature.name + " " + std::string(name_of(kind));
      planned.direction = {0, 3, 0};
      metrology::CharacteristicResult result;
      result.name = planned.name;
      result.kind = std::string(name_of(kind));
      result.value = 2.528618964906978e-10;  // more digits than some readers take
      result.unit = kind == CharacteristicKind::half_angle   ? "deg"
                    : kind == CharacteristicKind::line_angle ? "urad"
                                                             : "um";
      result.tolerance = 4.0;
      result.expanded_uncertainty = 0.5;
      if (kind == CharacteristicKind::half_angle || kind == CharacteristicKind::radius ||
          kind == CharacteristicKind::diameter || kind == CharacteristicKind::line_distance) {
        result.nominal = 1.0;
      }
      plan.characteristics.push_back(std::move(planned));
      report.measurement.characteristics.push_back(std::move(result));
    }
  }
  // Of one feature: in the datum system.
  for (const CharacteristicKind kind :
       {CharacteristicKind::position, CharacteristicKind::surface_profile,
        CharacteristicKind::circular_run_out}) {
    auto planned = metrology::measured::characteristic(kind, {"cylinder"});
    planned.name = "alone " + std::string(name_of(kind));
    metrology::CharacteristicResult result;
    result.name = planned.name;
    result.kind = std::string(name_of(kind));
    result.unit = "um";
    result.tolerance = 4.0;
    plan.characteristics.push_back(std::move(planned));
    report.measurement.characteristics.push_back(std::move(result));
  }
  return {qif_results(report, plan), qif_plan(plan)};
}

TEST(QifSchemaReference, Fault2_54_EveryKindIsQif30) {
  const char* schema = std::getenv("FRUSTUM_QIF_SCHEMA");  // NOLINT(concurrency-mt-unsafe)
  if (schema == nullptr || std::system("command -v xmllint >/dev/null") != 0) {
    GTEST_SKIP() << "no schema: set FRUSTUM_QIF_SCHEMA to QIFDocument.xsd and install xmllint";
  }
  const Documents documents = documents_of_all_kinds();
  for (const std::string& text : {documents.results, documents.plan}) {
    const fs::path file = fs::path(testing::TempDir()) / "frustum_every_kind.qif";
    std::ofstream(file) << text;
    const std::string command =
        "xmllint --noout --schema '" + std::string(schema) + "' '" + file.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
}

TEST(QifSchema, Fault2_54_TheLinesOfAProfileLieInAPlane) {
  const std::string text = documents_of_all_kinds().results;
  std::size_t profiles = 0;
  for (auto at = text.find("<LineProfileCharacteristicNominal "); at != std::string::npos;
       at = text.find("<LineProfileCharacteristicNominal ", at + 1)) {
    ++profiles;
    const auto end = text.find("</LineProfileCharacteristicNominal>", at);
    EXPECT_LT(text.find("<Vector>", at), end);
  }
  EXPECT_EQ(profiles, metrology::kFeatureNames.size());
}

}  // namespace
}  // namespace frustum::report
