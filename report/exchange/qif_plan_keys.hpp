// What a QIF document has no elements for of a plan, or not to the last bit, as attributes.
//
// Model  : AttributeStr "plan.KEY" of the document, of the items of features and of those of
//          characteristics; metrology/plan/qif/qif_plan.hpp reads them
// Units  : as in a plan file
// Errors : none
#pragma once

#include <pugixml.hpp>

#include "metrology/plan/inspection_plan.hpp"
#include "report/exchange/qif_characteristics.hpp"
#include "report/exchange/qif_features.hpp"

namespace frustum::report::qif {

// `root` holds all that states the plan.
void add_plan_keys(pugi::xml_node root, const metrology::InspectionPlan& plan,
                   const FeatureIds& features, const CharacteristicIds& characteristics);

}  // namespace frustum::report::qif
