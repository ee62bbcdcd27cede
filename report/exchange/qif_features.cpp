#include "report/exchange/qif_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "core/units.hpp"
#include "metrology/plan/strategy.hpp"
#include "report/number_text.hpp"

namespace frustum::report::qif {
namespace {

using metrology::InspectionPlan;
using metrology::MeasuredFeature;
using metrology::PlannedFeature;
using pugi::xml_node;

// A measured element, read from the names of its parameters.
class Measured {
 public:
  explicit Measured(const MeasuredFeature& feature) : feature_(feature) {}
  [[nodiscard]] Vec3 vector(const char* name) const {
    const auto found = feature_.parameters.find(name);
    if (found == feature_.parameters.end() || found->second.size() != 3) return Vec3::Zero();
    return {found->second[0], found->second[1], found->second[2]};
  }
  [[nodiscard]] double number(const char* name) const {
    const auto found = feature_.parameters.find(name);
    return found == feature_.parameters.end() || found->second.empty() ? 0.0 : found->second[0];
  }
  [[nodiscard]] double form() const { return feature_.form; }

 private:
  const MeasuredFeature& feature_;
};

void add_side(xml_node node, const PlannedFeature& planned) {
  add_text(node, "InternalExternal",
           planned.side == metrology::Side::inside ? "INTERNAL" : "EXTERNAL");
}

void add_axis(xml_node node, const Vec3& point, const Vec3& direction) {
  const xml_node axis = add(node, "Axis");
  add_vector(axis, "AxisPoint", point);
  add_vector(axis, "Direction", direction);
}

// Where the feature begins along its axis.
Vec3 start_of(const PlannedFeature& planned) {
  return planned.point + metrology::axial_extent(planned).from * planned.axis.normalized();
}
double length_of(const PlannedFeature& planned) {
  const metrology::AxialExtent extent = metrology::axial_extent(planned);
  return extent.to - extent.from;
}
// The place on the measured axis that is nearest to the planned start.
Vec3 measured_start(const PlannedFeature& planned, const Measured& m) {
  const Vec3 axis = m.vector("axis");
  return m.vector("point") + (start_of(planned) - m.vector("point")).dot(axis) * axis;
}

void nothing(xml_node, const PlannedFeature&) {}

void round_definition(xml_node node, const PlannedFeature& planned) {
  add_side(node, planned);
  add_number(node, "Diameter", 2.0 * planned.radius);
}
void cylinder_definition(xml_node node, const PlannedFeature& planned) {
  round_definition(node, planned);
  if (length_of(planned) > 0.0) add_number(node, "Length", length_of(planned));
}
void cone_definition(xml_node node, const PlannedFeature& planned) {
  round_definition(node, planned);
  const metrology::AxialExtent extent = metrology::axial_extent(planned);
  add_number(node, "HalfAngle", planned.half_angle * kDegPerRad);
  add_number(node, "LargeEndDistance", extent.to);
  add_number(node, "SmallEndDistance", extent.from);
}

void plane_nominal(xml_node node, const PlannedFeature& planned) {
  add_vector(node, "Location", planned.point);
  add_vector(node, "Normal", planned.axis.normalized());
}
void sphere_nominal(xml_node node, const PlannedFeature& planned) {
  add_vector(node, "Location", planned.point);
}
void cylinder_nominal(xml_node node, const PlannedFeature& planned) {
  add_axis(node, start_of(planned), planned.axis.normalized());
}
void cone_nominal(xml_node node, const PlannedFeature& planned) {
  add_axis(node, planned.point, planned.axis.normalized());
}
void line_nominal(xml_node node, const PlannedFeature& planned) {
  add_vector(node, "Location", start_of(planned));
  add_vector(node, "Direction", planned.axis.normalized());
  add_number(node, "Length", length_of(planned));
  add_vector(node, "Normal", planned.normal.normalized());
}

void plane_measured(xml_node node, const PlannedFeature&, const Measured& m) {
  add_vector(node, "Location", m.vector("point"));
  add_vector(node, "Normal", m.vector("axis"));
  add_number(node, "Form", m.form());
}
void point_measured(xml_node node, const PlannedFeature&, const Measured& m) {
  add_vector(node, "Location", m.vector("point"));
}
void circle_measured(xml_node node, const PlannedFeature&, const Measured& m) {
  add_vector(node, "Location", m.vector("point"));
  add_vector(node, "Normal", m.vector("axis"));
  add_number(node, "Diameter", 2.0 * m.number("radius"));
  add_number(node, "Form", m.form());
}
void sphere_measured(xml_node node, const PlannedFeature&, const Measured& m) {
  add_vector(node, "Location", m.vector("point"));
  add_number(node, "Diameter", 2.0 * m.number("radius"));
  add_number(node, "Form", m.form());
}
void cylinder_measured(xml_node node, const PlannedFeature& planned, const Measured& m) {
  add_axis(node, measured_start(planned, m), m.vector("axis"));
  add_number(node, "Diameter", 2.0 * m.number("radius"));
  add_number(node, "Form", m.form());
}
void cone_measured(xml_node node, const PlannedFeature&, const Measured& m) {
  // The section across the axis; a fitted cone holds the orthogonal distance.
  const double section = m.number("radius") / std::cos(m.number("half_angle"));
  add_axis(node, m.vector("point"), m.vector("axis"));
  add_number(node, "Diameter", 2.0 * section);
  add_number(node, "HalfAngle", m.number("half_angle") * kDegPerRad);
  add_number(node, "Form", m.form());
}
void line_measured(xml_node node, const PlannedFeature& planned, const Measured& m) {
  add_vector(node, "Location", measured_start(planned, m));
  add_vector(node, "Direction", m.vector("axis"));
  add_number(node, "Form", m.form());
}

struct FeatureKindRow {
  std::string_view kind;  // as plans name it
  const char* stem;       // as QIF names it
  void (*definition)(xml_node, const PlannedFeature&);
  void (*nominal)(xml_node, const PlannedFeature&);
  void (*measured)(xml_node, const PlannedFeature&, const Measured&);
};
constexpr std::array kFeatureKinds{
    FeatureKindRow{"plane", "Plane", nothing, plane_nominal, plane_measured},
    FeatureKindRow{"cylinder", "Cylinder", cylinder_definition, cylinder_nominal,
                   cylinder_measured},
    FeatureKindRow{"cone", "Cone", cone_definition, cone_nominal, cone_measured},
    FeatureKindRow{"circle", "Circle", round_definition, plane_nominal, circle_measured},
    FeatureKindRow{"line", "Line", nothing, line_nominal, line_measured},
    FeatureKindRow{"sphere", "Sphere", round_definition, sphere_nominal, sphere_measured},
    FeatureKindRow{"point", "Point", nothing, plane_nominal, point_measured}};

const FeatureKindRow* row_of(const PlannedFeature& planned) {
  const auto kind = name_of(planned.kind);
  const auto* const row = std::find_if(kFeatureKinds.begin(), kFeatureKinds.end(),
                                       [&](const FeatureKindRow& r) { return r.kind == kind; });
  return row == kFeatureKinds.end() ? nullptr : &*row;
}

std::string name_of_feature(const FeatureKindRow& row, const char* aspect) {
  return std::string(row.stem) + "Feature" + aspect;
}

void add_points(xml_node sets, const MeasuredFeature& feature, int id) {
  std::string numbers;
  int count = 0;
  for (const metrology::MeasuredPoint& p : feature.points) {
    if (!p.point.allFinite()) continue;
    for (const double x : p.point) numbers += (numbers.empty() ? "" : " ") + xml_decimal(x);
    ++count;
  }
  xml_node set = add(sets, "MeasuredPointSet");
  set.append_attribute("count") = count;
  set.append_attribute("id") = id;
  add_text(set, "Points", numbers);
  add_text(set, "Compensated", "true");
}

}  // namespace

void add_features(xml_node root, const InspectionPlan& plan, Ids& ids, FeatureIds& features) {
  const xml_node all = add(root, "Features");
  const xml_node definitions = add(all, "FeatureDefinitions");
  const xml_node nominals = add(all, "FeatureNominals");
  const xml_node items = add(all, "FeatureItems");
  for (const PlannedFeature& planned : plan.features) {
    const FeatureKindRow* row = row_of(planned);
    if (row == nullptr) continue;
    const int definition = ids.next(), nominal = ids.next(), item = ids.next();
    row->definition(add_identified(definitions, name_of_feature(*row, "Definition"), definition),
                    planned);
    const xml_node nominal_node =
        add_identified(nominals, name_of_feature(*row, "Nominal"), nominal);
    add_reference(nominal_node, "FeatureDefinitionId", definition);
    row->nominal(nominal_node, planned);
    const xml_node item_node = add_identified(items, name_of_feature(*row, "Item"), item);
    add_reference(item_node, "FeatureNominalId", nominal);
    add_text(item_node, "FeatureName", planned.name);
    add(add(add(add(item_node, "DeterminationMode"), "Checked"), "CheckDetails"), "Measured");
    features.nominals[planned.name] = nominal;
    features.items[planned.name] = item;
  }
  for (const xml_node list : {definitions, nominals, items}) close_list(list);
  if (!all.first_child()) root.remove_child(all);
}

void add_measured_features(xml_node results, const InspectionPlan& plan,
                           const metrology::Measurement& measurement, Ids& ids,
                           FeatureIds& features) {
  const xml_node measured = add(results, "MeasuredFeatures");
  const xml_node point_sets = add(results, "MeasuredPointSets");
  std::unordered_map<std::string_view, const PlannedFeature*> planned_features;
  for (const PlannedFeature& planned : plan.features) {
    planned_features.try_emplace(planned.name, &planned);
  }
  for (const MeasuredFeature& feature : measurement.features) {
    const auto known = planned_features.find(feature.name);
    const PlannedFeature* planned = known == planned_features.end() ? nullptr : known->second;
    const FeatureKindRow* row = planned == nullptr ? nullptr : row_of(*planned);
    if (row == nullptr) continue;
    const int id = ids.next();
    const xml_node node = add_identified(measured, name_of_feature(*row, "Measurement"), id);
    add_reference(node, "FeatureItemId", features.items.at(feature.name));
    if (!feature.points.empty()) {
      const int points = ids.next();
      const xml_node list = add(node, "PointList");
      add_reference(list, "WholePointSetId", points);
      close_list(list);
      add_points(point_sets, feature, points);
    }
    add_algorithm(node, metrology::Criterion::least_squares);  // what `parameters` are of
    row->measured(node, *planned, Measured(feature));
    features.measurements[feature.name] = id;
  }
  close_list(measured);
  close_list(point_sets);
}

}  // namespace frustum::report::qif
