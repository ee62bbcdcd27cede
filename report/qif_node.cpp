#include "report/qif_node.hpp"

#include <algorithm>
#include <iterator>

#include "report/exact_decimal.hpp"
#include "report/html_text.hpp"

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
  return add_text(parent, name, exact_decimal(value));
}

pugi::xml_node add_vector(pugi::xml_node parent, const std::string& name, const Vec3& vector) {
  return add_text(parent, name,
                  exact_decimal(vector.x()) + ' ' + exact_decimal(vector.y()) + ' ' +
                      exact_decimal(vector.z()));
}

pugi::xml_node add_reference(pugi::xml_node parent, const std::string& name, int id) {
  return add_text(parent, name, std::to_string(id));
}

pugi::xml_node add_identified(pugi::xml_node parent, const std::string& name, int id) {
  pugi::xml_node node = add(parent, name);
  node.append_attribute("id") = id;
  return node;
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
