// The characteristics of a plan in a QIF document: definition, nominal, item and measurement of
// each.
//
// Units: mm and deg, as the document states; combinedUncertainty is the standard uncertainty (k =
// 1), half of the expanded uncertainty. The parameter of a form whose plan states
// one is the Description of its item. Errors: none; a kind that QIF has no
// characteristic for is written as one of its general ones.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "report/exchange/qif_features.hpp"
#include "report/exchange/qif_node.hpp"

namespace frustum::report::qif {

// By the name of the characteristic.
using CharacteristicIds = std::map<std::string, int>;

// <Characteristics>, a child of the root, and the datums that it refers to; `device` measures,
// where one is known.
[[nodiscard]] CharacteristicIds add_characteristics(pugi::xml_node root,
                                                    const metrology::InspectionPlan& plan,
                                                    const metrology::Measurement& measurement,
                                                    int standard, std::optional<int> device,
                                                    Ids& ids, const FeatureIds& features);

// <MeasuredCharacteristics>
void add_measured_characteristics(pugi::xml_node results, const metrology::InspectionPlan& plan,
                                  const metrology::Measurement& measurement, Ids& ids,
                                  const FeatureIds& features, const CharacteristicIds& items);

}  // namespace frustum::report::qif
