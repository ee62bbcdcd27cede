// Elements of a QIF document as a reader of plans asks for them: by id, and their values.
//
// Model  : what is missing or wrong is noted, a harmless value is returned, and reading goes on, so
//          that all mistakes of a document are reported at once
// Units  : lengths come out in mm, angles in rad
// Errors : a missing element, a value that is no number or not positive, one in a unit of its own,
//          a reference to nothing or to an element of another kind: with line, column and element
// Source : QIF 3.0 (ISO 23952), Primitives.xsd, Units.xsd
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

#include "core/pose.hpp"
#include "metrology/points/qif_document.hpp"

namespace frustum::metrology {

class QifElements {
 public:
  explicit QifElements(const QifDocument& document);

  [[nodiscard]] pugi::xml_node root() const { return document_.root(); }

  // A list's elements can be referred to from then on.
  void add_list(pugi::xml_node list);
  // The element that the child `name` of `from` refers to; an empty one where that is noted.
  pugi::xml_node referred(pugi::xml_node from, const char* name, std::string_view expected);
  [[nodiscard]] pugi::xml_node with_id(const std::string& id) const;

  // The value of a child.
  double length(pugi::xml_node parent, const char* name);
  double positive_length(pugi::xml_node parent, const char* name);
  double angle(pugi::xml_node parent, const char* name);
  Vec3 place(pugi::xml_node parent, const char* name);      // mm
  Vec3 direction(pugi::xml_node parent, const char* name);  // of any length but 0

  void note(pugi::xml_node element, DiagnosticId id, std::string_view message, std::string hint);
  [[nodiscard]] const Diagnostics& noted() const { return noted_; }

 private:
  double number(pugi::xml_node parent, const char* name, const char* unit_attribute,
                const std::string& unit);
  Vec3 triple(pugi::xml_node parent, const char* name);
  void refuse_second(pugi::xml_node element);
  void take_angular_unit();

  const QifDocument& document_;
  std::unordered_map<std::string, pugi::xml_node> by_id_{};
  std::string length_unit_{};
  std::string angle_unit_{};
  double rad_ = 1.0;  // in a unit of angle of the document
  Diagnostics noted_{};
};

}  // namespace frustum::metrology
