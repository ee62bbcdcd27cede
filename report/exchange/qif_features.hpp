// The features of a plan in a QIF document: definition, nominal, item and measurement of each, and
// the points.
//
// Units: mm and deg, as the document states. Errors: none; a kind of feature that QIF has no
// element for is left out, and so are points that are not finite.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "report/exchange/qif_node.hpp"

namespace frustum::report::qif {

// What other parts of the document refer to, by the name of the feature.
struct FeatureIds {
  std::map<std::string, int> nominals{};
  std::map<std::string, int> items{};
  std::map<std::string, int> measurements{};
};

// <Features>, a child of the root; fills in nominals and items.
void add_features(pugi::xml_node root, const metrology::InspectionPlan& plan, Ids& ids,
                  FeatureIds& features);

// <MeasuredFeatures> and <MeasuredPointSets>; fills in the measurements.
void add_measured_features(pugi::xml_node results, const metrology::InspectionPlan& plan,
                           const metrology::Measurement& measurement, Ids& ids,
                           FeatureIds& features);

}  // namespace frustum::report::qif
