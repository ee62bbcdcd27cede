#include "metrology/plan/qif/qif_tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace frustum::metrology {
namespace {

using pugi::xml_node;

// What a definition may hold; anything else would change what is to be measured.
constexpr std::array<std::string_view, 10> kKnown{
    "Attributes",        "Description",    "Name",      "CharacteristicDesignator",
    "Independency",      "ToleranceValue", "Tolerance", "DatumReferenceFrameId",
    "MaterialCondition", "ZoneShape"};

class ToleranceReader {
 public:
  ToleranceReader(QifElements& elements, const QifCharacteristic& stated, PlannedCharacteristic& c)
      : e_(elements), stated_(stated), c_(c) {}

  void read() {
    for (const xml_node child : stated_.definition.children()) {
      const std::string_view name = child.name();
      if (child.type() != pugi::node_element || std::ranges::find(kKnown, name) != kKnown.end()) {
        continue;
      }
      e_.note(child, "qif-plan"_id,
              fmt::format("of a {} is nothing that a plan has", stated_.definition.name()),
              "a definition with ToleranceValue or Tolerance is expected");
    }
    check_zone();
    const bool has_limits =
        stated_.kind.zone == QifZone::limits || stated_.kind.zone == QifZone::between;
    if (has_limits) {
      read_limits();
    } else {
      c_.tolerance = e_.positive_length(stated_.definition, "ToleranceValue");
    }
    if (stated_.kind.zone == QifZone::between && stated_.nominal.child("AnalysisVector")) {
      c_.direction = e_.direction(stated_.nominal, "AnalysisVector");
    }
  }

 private:
  void check_zone() {
    const xml_node condition = stated_.definition.child("MaterialCondition");
    const std::string material = qif_text(condition);
    if (condition && material != "NONE" && material != "REGARDLESS") {
      e_.note(condition, "qif-plan"_id, fmt::format("is {}", material),
              "NONE or REGARDLESS is expected: plans have no material condition");
    }
    const xml_node zone = stated_.definition.child("ZoneShape").first_child();
    const std::string_view name = zone.name();
    if (!zone) return;
    const PlannedFeature* of = stated_.feature;
    const bool planar = stated_.kind.zone == QifZone::orientation && of != nullptr &&
                        of->kind == FeatureKind::plane;
    const char* expected = planar ? "PlanarZone" : "DiametricalZone";
    if (name == expected) return;
    e_.note(zone, "qif-plan"_id, "is another zone than that of the characteristic",
            fmt::format("<{}> is expected", expected));
  }

  [[nodiscard]] double value(xml_node parent, const char* name) {
    return is_angle(c_.kind) ? e_.angle(parent, name) : e_.length(parent, name);
  }

  // The size of the feature in the nominal geometry; nothing for a deviation.
  [[nodiscard]] std::optional<double> size() const {
    const PlannedFeature* of = stated_.feature;
    if (of == nullptr || stated_.kind.zone == QifZone::between) return std::nullopt;
    if (c_.kind == CharacteristicKind::half_angle) return of->half_angle;
    return c_.kind == CharacteristicKind::diameter ? 2.0 * of->radius : of->radius;
  }

  void read_limits() {
    const xml_node limits = stated_.definition.child("Tolerance");
    if (!limits) {
      e_.note(stated_.definition, "missing-element"_id, "has no <Tolerance>",
              "MaxValue and MinValue about the nominal are expected");
      return;
    }
    double above = value(limits, "MaxValue"), below = value(limits, "MinValue");
    const double nominal = size().value_or(0.0);
    if (qif_text(limits.child("DefinedAsLimit")) == "true") {
      above -= nominal;
      below -= nominal;
    }
    c_.tolerance = above;
    // Digits that a writer rounds away, far below what is measured.
    constexpr double kRounding = 1e-9;
    if (!(above > 0.0) || std::abs(above + below) > kRounding) {
      e_.note(limits, "plan-value"_id,
              fmt::format("allows {:g} below and {:g} above the nominal", -below, above),
              "limits as far to either side are expected, greater than 0");
      c_.tolerance = 1.0;
    }
    const xml_node target = stated_.nominal.child("TargetValue");
    if (!target) return;
    const double wanted = value(stated_.nominal, "TargetValue");
    if (std::abs(wanted - nominal) <= kRounding) return;
    e_.note(target, "plan-value"_id, fmt::format("is {}", qif_text(target)),
            size()
                ? "the size of the nominal feature is expected"
                : "0 is expected: what is toleranced is the deviation from the nominal geometry");
  }

  QifElements& e_;
  const QifCharacteristic& stated_;
  PlannedCharacteristic& c_;
};

}  // namespace

void take_qif_tolerance(QifElements& elements, const QifCharacteristic& stated,
                        PlannedCharacteristic& c) {
  ToleranceReader(elements, stated, c).read();
}

}  // namespace frustum::metrology
