#include "report/exchange/qif_plan_keys.hpp"

#include <map>
#include <sstream>
#include <string>

#include "metrology/plan/qif/qif_plan.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report::qif {
namespace {

using metrology::PlanKeys;
using pugi::xml_node;

std::string text_of(xml_node root) {
  std::ostringstream text;
  root.print(text, "", pugi::format_raw, pugi::encoding_utf8);
  return text.str();
}

void fill(xml_node list, const PlanKeys& keys) {
  for (const metrology::PlanKey& k : keys) {
    xml_node node = add(list, "AttributeStr");
    node.append_attribute("name") = ("plan." + k.key).c_str();
    node.append_attribute("value") = readable_text(k.value).c_str();
  }
  close_list(list);
}

// The elements of a list by their ids.
std::map<int, xml_node> by_id(xml_node list) {
  std::map<int, xml_node> found;
  for (const xml_node element : list) found[element.attribute("id").as_int()] = element;
  return found;
}

template <typename Part>
void fill_items(xml_node list, const std::vector<Part>& parts, const std::vector<PlanKeys>& keys,
                const std::map<std::string, int>& ids) {
  const std::map<int, xml_node> items = by_id(list);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto id = ids.find(parts[i].name);
    if (id == ids.end()) continue;
    xml_node item = items.at(id->second);
    fill(item.prepend_child("Attributes"), keys[i]);
  }
}

}  // namespace

void add_plan_keys(xml_node root, const metrology::InspectionPlan& plan, const FeatureIds& features,
                   const CharacteristicIds& characteristics) {
  if (features.items.empty()) return;
  const metrology::PlanTexts keys = metrology::unstated_keys(plan, text_of(root));
  fill(root.insert_child_after("Attributes", root.child("QPId")), keys.root);
  fill_items(root.child("Features").child("FeatureItems"), plan.features, keys.features,
             features.items);
  fill_items(root.child("Characteristics").child("CharacteristicItems"), plan.characteristics,
             keys.characteristics, characteristics);
}

}  // namespace frustum::report::qif
