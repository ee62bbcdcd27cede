// A plan as the elements of a QIF document state it, without the keys of plans that it may carry as
// attributes.
//
// Model  : items with their nominals and definitions, by id. Sizes and places are those of the
//          definitions and nominals, tolerances those of the definitions. A datum of a definition's
//          datum reference frame is a further feature of its characteristic, several are the plan's
//          datum system. Where to touch no QIF says: the strategies are placeholders
// Units  : mm and rad
// Errors : features, characteristics, tolerances, zones, material conditions that a plan does not
//          have, sizes whose target is not that of their feature: with line, column, element
// Source : QIF 3.0 (ISO 23952), Features.xsd, Characteristics.xsd, IntermediatesPMI.xsd
#pragma once

#include <pugixml.hpp>
#include <vector>

#include "core/result.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/points/qif_document.hpp"

namespace frustum::metrology {

struct QifStated {
  InspectionPlan plan{};
  std::vector<pugi::xml_node> features{};         // the item of each
  std::vector<pugi::xml_node> characteristics{};  // the item of each
};
[[nodiscard]] Result<QifStated> qif_stated(const QifDocument& document);

}  // namespace frustum::metrology
