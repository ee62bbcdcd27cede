// The datums of a plan in a QIF document: definitions, and the reference frames that tolerances
// name.
//
// Model  : one frame for each datum that a characteristic names by itself, one for the plan's datum
//          system where it has two datums or three. Common axes of several features and best fits
//          are no frames of QIF: they are in the features of the item, or in attributes
// Units  : none
// Errors : none
// Source : QIF 3.0 (ISO 23952), IntermediatesPMI.xsd; ISO 5459
#pragma once

#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "metrology/plan/inspection_plan.hpp"
#include "report/exchange/qif_features.hpp"
#include "report/exchange/qif_node.hpp"

namespace frustum::report::qif {

// <DatumDefinitions> and <DatumReferenceFrames>, children of the root after <FileUnits>.
class Datums {
 public:
  Datums(pugi::xml_node root, const metrology::InspectionPlan& plan, Ids& ids,
         const FeatureIds& features);

  // Of the tolerance's datums; nothing where it has none that QIF can name.
  [[nodiscard]] std::optional<int> frame_of(const metrology::PlannedCharacteristic& planned) const;

 private:
  using Names = std::vector<std::string>;

  [[nodiscard]] Names datums_of(const metrology::PlannedCharacteristic& planned) const;
  int definition_of(const std::string& feature);
  void add_frame(const Names& datums);

  const metrology::InspectionPlan& plan_;
  Ids& ids_;
  const FeatureIds& features_;
  pugi::xml_node definitions_{};
  pugi::xml_node reference_frames_{};
  std::map<std::string, int> definition_ids_{};
  std::map<Names, int> frame_ids_{};
};

}  // namespace frustum::report::qif
