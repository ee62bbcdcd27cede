#include "report/exchange/qif_node.hpp"

#include <iterator>

#include "metrology/plan/qif/qif_kinds.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report::qif {

pugi::xml_node add(pugi::xml_node parent, const std::string& name) {
  return parent.append_child(name.c_str());
}

pugi::xml_node add_text(pugi::xml_node parent, const std::string& name, std::string_view text) {
  pugi::xml_node node = add(parent, name);
  node.text().set(readable_text(text).c_str());
  return node;
}

pugi::xml_node add_number(pugi::xml_node parent, const std::string& name, double value) {
  return add_text(parent, name, xml_decimal(value));
}

pugi::xml_node add_vector(pugi::xml_node parent, const std::string& name, const Vec3& vector) {
  return add_text(
      parent, name,
      xml_decimal(vector.x()) + ' ' + xml_decimal(vector.y()) + ' ' + xml_decimal(vector.z()));
}

pugi::xml_node add_reference(pugi::xml_node parent, const std::string& name, int id) {
  return add_text(parent, name, std::to_string(id));
}

pugi::xml_node add_identified(pugi::xml_node parent, const std::string& name, int id) {
  pugi::xml_node node = add(parent, name);
  node.append_attribute("id") = id;
  return node;
}

void add_algorithm(pugi::xml_node parent, metrology::Criterion criterion) {
  add_text(add(parent, "SubstituteFeatureAlgorithm"), "SubstituteFeatureAlgorithmEnum",
           metrology::kQifCriteria.at(static_cast<std::size_t>(criterion)));
}

void close_list(pugi::xml_node list) {
  const auto children = list.children();
  const auto count = std::distance(children.begin(), children.end());
  if (count == 0) {
    list.parent().remove_child(list);
  } else {
    list.prepend_attribute("n") = static_cast<int>(count);
  }
}

}  // namespace frustum::report::qif
