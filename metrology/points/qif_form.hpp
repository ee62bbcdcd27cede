// What every QIF document keeps to, whatever it is about.
//
// Model  : lists say how many elements they have; what can be referred to has a number; text has no
//          references but those of XML itself, since nothing reads the declarations of others
// Units  : none
// Errors : none
// Source : QIF 3.0 (ISO 23952), Primitives.xsd: n of lists, QIFIdType; XML 1.0, 4.6
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "core/diagnostic.hpp"

namespace frustum::metrology {

class QifDocument;

// Names without the prefix of the root: <qif:Points> is read as <Points>.
void drop_prefix(pugi::xml_node root);

// The first that is wrong in the lists that plans and points are read from; others are not looked
// at.
[[nodiscard]] std::optional<Diagnostic> list_fault(const QifDocument& document);

// The first reference to an entity that XML itself does not define, such as &part; in bytes that
// are ASCII below 0x80.
struct UnknownReference {
  std::size_t offset = 0;
  std::string_view text{};  // with & and ;
};
[[nodiscard]] std::optional<UnknownReference> unknown_reference(std::string_view bytes);

}  // namespace frustum::metrology
