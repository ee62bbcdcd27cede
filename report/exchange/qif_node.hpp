// Elements of a QIF document as the writers of its parts make them.
//
// Units: none. Errors: none.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "core/pose.hpp"
#include "metrology/fit/association.hpp"

namespace frustum::report::qif {

// Numbers that elements of the document are named by; each is given once.
class Ids {
 public:
  int next() { return ++last_; }
  [[nodiscard]] int last() const { return last_; }

 private:
  int last_ = 0;
};

pugi::xml_node add(pugi::xml_node parent, const std::string& name);
// <name>text</name>
pugi::xml_node add_text(pugi::xml_node parent, const std::string& name, std::string_view text);
pugi::xml_node add_number(pugi::xml_node parent, const std::string& name, double value);
pugi::xml_node add_vector(pugi::xml_node parent, const std::string& name, const Vec3& vector);
pugi::xml_node add_reference(pugi::xml_node parent, const std::string& name, int id);
// <name id="..">
pugi::xml_node add_identified(pugi::xml_node parent, const std::string& name, int id);

// <SubstituteFeatureAlgorithm>
void add_algorithm(pugi::xml_node parent, metrology::Criterion criterion);

// States in the attribute n how many elements the list holds; an empty list is taken out.
void close_list(pugi::xml_node list);

}  // namespace frustum::report::qif
