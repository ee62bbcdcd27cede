#include "report/exchange/qif_datums.hpp"

#include <algorithm>
#include <array>

#include "metrology/plan/qif/qif_kinds.hpp"

namespace frustum::report::qif {
namespace {

using metrology::CharacteristicKind;
using pugi::xml_node;

constexpr std::array kToDatums{
    CharacteristicKind::parallelism,     CharacteristicKind::perpendicularity,
    CharacteristicKind::angularity,      CharacteristicKind::position,
    CharacteristicKind::coaxiality,      CharacteristicKind::concentricity,
    CharacteristicKind::symmetry,        CharacteristicKind::circular_run_out,
    CharacteristicKind::total_run_out,   CharacteristicKind::line_profile,
    CharacteristicKind::surface_profile,
};

bool takes_datum_system(const metrology::PlannedCharacteristic& c) {
  const bool is_profile =
      c.kind == CharacteristicKind::line_profile || c.kind == CharacteristicKind::surface_profile;
  return is_profile ? !c.floating && c.frame.empty()
                    : c.kind != CharacteristicKind::concentricity && c.features.size() == 1 &&
                          c.frame.empty();
}

// What xs:NMTOKEN takes of a name; letters are the datum's own.
std::string label_of(const std::string& feature) {
  std::string label = feature;
  for (char& c : label) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '.' || c == '-';
    if (!is_plain) c = '_';
  }
  return label;
}

}  // namespace

Datums::Datums(xml_node root, const metrology::InspectionPlan& plan, Ids& ids,
               const FeatureIds& features)
    : plan_(plan), ids_(ids), features_(features) {
  definitions_ = root.insert_child_after("DatumDefinitions", root.child("FileUnits"));
  reference_frames_ = root.insert_child_after("DatumReferenceFrames", definitions_);
  for (const metrology::PlannedCharacteristic& planned : plan.characteristics) {
    const Names datums = datums_of(planned);
    if (!datums.empty() && !frame_ids_.contains(datums)) add_frame(datums);
  }
  close_list(definitions_);
  close_list(reference_frames_);
}

std::optional<int> Datums::frame_of(const metrology::PlannedCharacteristic& planned) const {
  const auto at = frame_ids_.find(datums_of(planned));
  return at == frame_ids_.end() ? std::nullopt : std::optional(at->second);
}

Datums::Names Datums::datums_of(const metrology::PlannedCharacteristic& planned) const {
  if (std::ranges::find(kToDatums, planned.kind) == kToDatums.end()) return {};
  Names datums;
  if (takes_datum_system(planned)) {
    if (plan_.datum && plan_.datum->best_fit.empty() &&
        plan_.alignment == metrology::Alignment::datum) {
      for (const auto& name : {plan_.datum->primary, plan_.datum->secondary, plan_.datum->tertiary})
        if (!name.empty()) datums.push_back(name);
    }
    if (datums.size() < 2) return {};
  } else if (planned.features.size() == 2 && planned.frame.empty() &&
             planned.kind != CharacteristicKind::line_profile &&
             planned.kind != CharacteristicKind::surface_profile) {
    datums = {planned.features.back()};
  }
  const bool is_known = std::ranges::all_of(
      datums, [&](const std::string& name) { return features_.nominals.contains(name); });
  return is_known ? datums : Names();
}

int Datums::definition_of(const std::string& feature) {
  if (const auto at = definition_ids_.find(feature); at != definition_ids_.end()) return at->second;
  const int id = ids_.next();
  const xml_node definition = add_identified(definitions_, "DatumDefinition", id);
  add_text(definition, "DatumLabel", label_of(feature));
  const xml_node list = add(definition, "FeatureNominalIds");
  add_reference(list, "Id", features_.nominals.at(feature));
  close_list(list);
  definition_ids_[feature] = id;
  return id;
}

void Datums::add_frame(const Names& datums) {
  constexpr std::array kPrecedence{"PRIMARY", "SECONDARY", "TERTIARY"};
  std::vector<int> definitions;
  for (const std::string& name : datums) definitions.push_back(definition_of(name));
  const int id = ids_.next();
  const xml_node list = add(add_identified(reference_frames_, "DatumReferenceFrame", id), "Datums");
  for (std::size_t i = 0; i < datums.size(); ++i) {
    const xml_node datum = add(list, "Datum");
    const xml_node simple = add(datum, "SimpleDatum");
    add_reference(simple, "DatumDefinitionId", definitions[i]);
    add_text(simple, "MaterialModifier", "NONE");
    add_text(simple, "ReferencedComponent", "ACTUAL");
    add_text(add(datum, "Precedence"), "PrecedenceEnum", kPrecedence.at(i));
  }
  close_list(list);
  frame_ids_[datums] = id;
}

}  // namespace frustum::report::qif
