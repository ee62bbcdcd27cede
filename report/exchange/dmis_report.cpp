#include "report/exchange/dmis_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/units.hpp"
#include "metrology/plan/plan_names.hpp"
#include "report/exchange/dmis_text.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

using metrology::CharacteristicResult;
using metrology::InspectionPlan;
using metrology::MeasuredFeature;
using metrology::PlannedFeature;

// How DMIS says a kind of characteristic.
enum class Said { zone, to_datum, size };
struct DmisRow {
  std::string_view kind;
  std::string_view word;
  Said said;
};
constexpr std::array kDmisRows{DmisRow{"roundness", "CIRLTY", Said::zone},
                               DmisRow{"cylindricity", "CYLCTY", Said::zone},
                               DmisRow{"flatness", "FLAT", Said::zone},
                               DmisRow{"straightness", "STRGHT", Said::zone},
                               DmisRow{"axis_straightness", "STRGHT", Said::zone},
                               DmisRow{"perpendicularity", "PERP", Said::to_datum},
                               DmisRow{"parallelism", "PARLEL", Said::to_datum},
                               DmisRow{"angularity", "ANGLR", Said::to_datum},
                               DmisRow{"position", "POS,3D", Said::to_datum},
                               DmisRow{"concentricity", "CONCEN", Said::to_datum},
                               DmisRow{"coaxiality", "CONCEN", Said::to_datum},
                               DmisRow{"symmetry", "SYM", Said::to_datum},
                               DmisRow{"circular_run_out", "CRNOUT", Said::to_datum},
                               DmisRow{"total_run_out", "TRNOUT", Said::to_datum},
                               DmisRow{"diameter", "DIAM", Said::size},
                               DmisRow{"radius", "RAD", Said::size}};

const DmisRow* dmis_row(std::string_view kind) {
  const auto* const row = std::ranges::find(kDmisRows, kind, &DmisRow::kind);
  return row == kDmisRows.end() ? nullptr : row;
}

// 0.1 nm in mm, and what double precision has of a direction.
std::string coordinate(double value) { return fixed_text(value, 7); }
std::string triple(const Vec3& v) {
  return coordinate(v.x()) + "," + coordinate(v.y()) + "," + coordinate(v.z());
}
std::string direction(const Vec3& v) {
  return fixed_text(v.x(), 9) + "," + fixed_text(v.y(), 9) + "," + fixed_text(v.z(), 9);
}

// A measured element's numbers by name.
Vec3 vector_of(const MeasuredFeature& feature, const char* name, const Vec3& otherwise) {
  const auto at = feature.parameters.find(name);
  if (at == feature.parameters.end() || at->second.size() != 3) return otherwise;
  return {at->second[0], at->second[1], at->second[2]};
}
double number_of(const MeasuredFeature& feature, const char* name, double otherwise) {
  const auto at = feature.parameters.find(name);
  return at == feature.parameters.end() || at->second.size() != 1 ? otherwise : at->second[0];
}

// What both F() and FA() are made of.
struct Element {
  metrology::FeatureKind kind = metrology::FeatureKind::plane;
  bool inner = false;
  Vec3 point = Vec3::Zero(), axis = Vec3::UnitZ(), normal = Vec3::UnitZ();
  double radius = 0.0;  // of a cone: across the axis at `point`
  double half_angle = 0.0;
};

Element planned_element(const PlannedFeature& planned) {
  return {planned.kind,
          planned.side == metrology::Side::inside,
          planned.point,
          planned.axis.norm() > 0.0 ? Vec3(planned.axis.normalized()) : Vec3(Vec3::UnitZ()),
          planned.normal.norm() > 0.0 ? Vec3(planned.normal.normalized()) : Vec3(Vec3::UnitZ()),
          planned.radius,
          planned.half_angle};
}

Element measured_element(const PlannedFeature& planned, const MeasuredFeature& measured) {
  Element element = planned_element(planned);
  element.point = vector_of(measured, "point", element.point);
  element.axis = vector_of(measured, "axis", element.axis);
  element.half_angle = number_of(measured, "half_angle", element.half_angle);
  const double radius = number_of(measured, "radius", element.radius);
  // A fitted cone holds the orthogonal distance.
  const bool is_cone = element.kind == metrology::FeatureKind::cone;
  const bool is_fitted = measured.parameters.contains("radius");
  element.radius = is_cone && is_fitted ? radius / std::cos(element.half_angle) : radius;
  return element;
}

std::optional<std::string> feature_text(const Element& e) {
  using enum metrology::FeatureKind;
  const std::string side = e.inner ? "INNER" : "OUTER";
  switch (e.kind) {
    case plane:
      return "PLANE,CART," + triple(e.point) + "," + direction(e.axis);
    case circle:
      return fmt::format("CIRCLE,{},CART,{},{},{}", side, triple(e.point), direction(e.axis),
                         coordinate(2.0 * e.radius));
    case cylinder:
      return fmt::format("CYLNDR,{},CART,{},{},{}", side, triple(e.point), direction(e.axis),
                         coordinate(2.0 * e.radius));
    case cone: {
      // The axis of the plan points to growing radius, that of DMIS from the apex too.
      const Vec3 apex = e.point - e.axis * (e.radius / std::tan(e.half_angle));
      return fmt::format("CONE,{},CART,{},{},{}", side, triple(apex), direction(e.axis),
                         fixed_text(2.0 * e.half_angle * kDegPerRad, 9));
    }
    case sphere:
      return fmt::format("SPHERE,{},CART,{},{}", side, triple(e.point), coordinate(2.0 * e.radius));
    case line:
      return fmt::format("LINE,UNBND,CART,{},{},{}", triple(e.point), direction(e.axis),
                         direction(e.normal));
    case point:
      return "POINT,CART," + triple(e.point) + "," + direction(e.axis);
    case ruled:
      break;
  }
  return std::nullopt;
}

class DmisFile {
 public:
  DmisFile(const RunReport& report, const InspectionPlan& plan)
      : report_(report), plan_(plan), datums_(datum_names(report), feature_names(report)) {}

  std::string text() {
    const std::string title = quoted(report_.title);
    const std::string kept =
        shortened_to(title, kDmisColumns - std::string_view("FILNAM/'',05.3").size());
    statement(fmt::format("FILNAM/'{}',05.3", kept));
    if (kept != title) comment(report_.title);
    comment("Made by Frustum " + report_.version);
    for (const Fact& fact : stated(report_.evidence.header)) {
      comment(fact.label + ": " + fact.value);
    }
    statement("UNITS/MM,ANGDEC");
    for (const MeasuredFeature& measured : report_.measurement.features) name(measured);
    for (const MeasuredFeature& measured : report_.measurement.features) write(measured);
    write_others();
    statement("ENDFIL");
    return std::move(text_);
  }

 private:
  // Features that characteristics name as datums, in the order of the file.
  static std::vector<std::string> datum_names(const RunReport& report) {
    std::vector<std::string> names;
    for (const CharacteristicResult& c : report.measurement.characteristics) {
      const DmisRow* row = dmis_row(c.kind);
      if (row == nullptr || row->said != Said::to_datum) continue;
      for (std::size_t k = 1; k < c.features.size(); ++k) names.push_back(c.features[k]);
    }
    return names;
  }

  static std::vector<std::string> feature_names(const RunReport& report) {
    std::vector<std::string> names;
    for (const MeasuredFeature& measured : report.measurement.features) {
      names.push_back(measured.name);
    }
    return names;
  }

  static std::string quoted(const std::string& text) {
    std::string plain = readable_text(text);
    std::ranges::replace(plain, '\'', ' ');
    return plain;
  }

  void comment(const std::string& content) { text_ += dmis_comment(readable_text(content)); }
  void statement(const std::string& whole) { text_ += dmis_statement(whole); }

  [[nodiscard]] const PlannedFeature* planned(const std::string& name) const {
    const auto at = std::ranges::find(plan_.features, name, &PlannedFeature::name);
    return at == plan_.features.end() ? nullptr : &*at;
  }

  void name(const MeasuredFeature& measured) {
    labels_of_features_[measured.name] = labels_.of(measured.name);
  }

  struct Statements {
    std::string labels{};
    std::vector<std::string> lines{};
  };

  void write(const MeasuredFeature& measured) {
    const PlannedFeature* feature = planned(measured.name);
    const std::string& label = labels_of_features_[measured.name];
    const auto nominal =
        feature == nullptr ? std::nullopt : feature_text(planned_element(*feature));
    if (!nominal) {
      comment(fmt::format("{}: DMIS has no such feature ({})", measured.name, measured.kind));
      return write_points(measured, label);
    }
    const auto actual = feature_text(measured_element(*feature, measured));
    Statements planned_side, measured_side;
    std::set<std::string> needed;
    for (const CharacteristicResult& c : report_.measurement.characteristics) {
      if (!c.features.empty() && c.features.front() == measured.name) {
        add(c, planned_side, measured_side, needed);
      }
    }
    text_ += "\n";
    for (const std::string& each : needed) define_datum(each);
    comment(measured.name + ", nominal");
    statement(fmt::format("OUTPUT/F({}){}", label, planned_side.labels));
    statement(fmt::format("F({})=FEAT/{}", label, *nominal));
    for (const std::string& line : planned_side.lines) statement(line);
    comment(measured.name + ", actual");
    statement(fmt::format("OUTPUT/FA({}){}", label, measured_side.labels));
    statement(fmt::format("FA({})=FEAT/{}", label, *actual));
    for (const std::string& line : measured_side.lines) statement(line);
    write_points(measured, label);
  }

  void add(const CharacteristicResult& c, Statements& planned_side, Statements& measured_side,
           std::set<std::string>& needed) {
    const DmisRow* row = dmis_row(c.kind);
    if (row == nullptr || !std::isfinite(c.value)) {
      others_.push_back(&c);
      return;
    }
    const std::string label = labels_.of(c.name);
    const auto mm = [&](double value) {
      return coordinate(metrology::internal_value(value, c.unit));
    };
    const std::string verdict = outcome_of(c) == Outcome::pass ? "INTOL" : "OUTOL";
    std::string datums;
    for (std::size_t k = 1; row->said == Said::to_datum && k < c.features.size(); ++k) {
      datums += fmt::format(",DAT({})", datums_.of(c.features[k]));
      needed.insert(c.features[k]);
    }
    if (!datums.empty()) datums = ",RFS" + datums;
    planned_side.labels += fmt::format(",T({})", label);
    measured_side.labels += fmt::format(",TA({})", label);
    if (row->said == Said::size) {
      planned_side.lines.push_back(
          fmt::format("T({})=TOL/{},{},{}", label, row->word, mm(-c.tolerance), mm(c.tolerance)));
      measured_side.lines.push_back(
          fmt::format("TA({})=TOL/{},{},{}", label, row->word, mm(deviation_of(c)), verdict));
      return;
    }
    planned_side.lines.push_back(
        fmt::format("T({})=TOL/{},{}{}", label, row->word, mm(c.tolerance), datums));
    measured_side.lines.push_back(
        fmt::format("TA({})=TOL/{},{},{}{}", label, row->word, mm(c.value), verdict, datums));
  }

  void define_datum(const std::string& feature) {
    const auto label = labels_of_features_.find(feature);
    if (label == labels_of_features_.end() || !defined_.insert(feature).second) return;
    const std::string letters = datums_.of(feature);
    if (letters != feature) comment(fmt::format("datum {}: {}", letters, feature));
    statement(fmt::format("DATDEF/FA({}),DAT({})", label->second, letters));
  }

  void write_points(const MeasuredFeature& measured, const std::string& label) {
    if (measured.points.empty()) return;
    comment(fmt::format("{}, points", measured.name));
    std::size_t number = 0;
    for (const metrology::MeasuredPoint& p : measured.points) {
      ++number;
      if (!p.point.allFinite()) continue;
      const Vec3 normal = p.normal.norm() > 0.0 ? p.normal : Vec3(Vec3::UnitZ());
      statement(fmt::format("FA({})=FEAT/POINT,CART,{},{}", labels_.of_point(label, number),
                            triple(p.point), direction(normal)));
    }
  }

  // What has no statement of its own, and what belongs to no feature that was measured.
  void write_others() {
    if (others_.empty()) return;
    text_ += "\n";
    for (const CharacteristicResult* c : others_) {
      comment(fmt::format("{} ({}): {} {}, tolerance {}, {}", c->name, c->kind,
                          value_text(c->value, c->unit), c->unit, value_text(c->tolerance, c->unit),
                          name_of(outcome_of(*c))));
    }
  }

  const RunReport& report_;
  const InspectionPlan& plan_;
  std::string text_{};
  DmisLabels labels_{};
  std::map<std::string, std::string> labels_of_features_{};
  DmisDatums datums_;
  std::set<std::string> defined_{};
  std::vector<const CharacteristicResult*> others_{};
};

}  // namespace

std::string dmis_report(const RunReport& report, const InspectionPlan& plan) {
  return DmisFile(report, plan).text();
}

}  // namespace frustum::report
