// The tolerance of a characteristic as a QIF document states it.
//
// Units  : mm and rad
// Errors : limits that are not as far to either side, a target that is not that of the feature, a
//          material condition, a zone or anything else in a definition that a plan does not have:
//          with line, column, element
// Source : QIF 3.0 (ISO 23952), Characteristics.xsd
#pragma once

#include <pugixml.hpp>

#include "metrology/plan/inspection_plan.hpp"
#include "metrology/plan/qif/qif_elements.hpp"
#include "metrology/plan/qif/qif_kinds.hpp"

namespace frustum::metrology {

struct QifCharacteristic {
  QifKind kind;
  pugi::xml_node nominal{};
  pugi::xml_node definition{};
  const PlannedFeature* feature = nullptr;  // the toleranced one; null where it is not known
};

// Sets tolerance and direction of `c`.
void take_qif_tolerance(QifElements& elements, const QifCharacteristic& stated,
                        PlannedCharacteristic& c);

}  // namespace frustum::metrology
