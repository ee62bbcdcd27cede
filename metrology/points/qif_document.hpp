// A QIF 3.0 document as its readers see it: elements, the unit of length, and where an element is.
//
// Model  : elements refer to one another by id; a missing one is reported with the place of who
//          asked
// Units  : mm in a unit of the document (FileUnits, metres per unit)
// Errors : what is no XML, with line and column; no QIFDocument, another version than 3, no unit
//          of length
// Source : QIF 3.0 (ISO 23952), QIFDocument.xsd and Units.xsd
#pragma once

#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum::metrology {

class QifDocument {
 public:
  // Diagnostics of a document name no file.
  [[nodiscard]] static Result<QifDocument> parse(std::string_view bytes);

  [[nodiscard]] pugi::xml_node root() const { return root_; }
  [[nodiscard]] double mm() const { return mm_; }

  // 1-based; both 0 where the text was in an encoding that had to be converted.
  struct Place {
    int line = 0;
    int column = 0;
  };
  [[nodiscard]] Place place_of(pugi::xml_node element) const;

  // "<Name id="7"> MESSAGE", with the place of the element.
  [[nodiscard]] Diagnostic fault(pugi::xml_node element, DiagnosticId id, std::string_view message,
                                 std::string hint = {}) const;

 private:
  QifDocument() = default;
  [[nodiscard]] Place place_at(std::size_t offset) const;
  [[nodiscard]] std::optional<Diagnostic> take_root();
  [[nodiscard]] std::optional<Diagnostic> take_unit();

  std::unique_ptr<pugi::xml_document> document_ = std::make_unique<pugi::xml_document>();
  pugi::xml_node root_{};
  std::vector<std::size_t> line_starts_{};  // bytes; empty where places are not known
  double mm_ = 1.0;
};

// All numbers of a list that blanks separate; nothing where one of them is no finite number.
[[nodiscard]] std::optional<std::vector<double>> qif_numbers(std::string_view text);
// All text of an element, that before and after comments too; a blank for each element in it.
[[nodiscard]] std::string qif_content(pugi::xml_node element);
[[nodiscard]] std::optional<std::vector<double>> qif_numbers(pugi::xml_node element);
// Without blanks before and after, as xs:token is read.
[[nodiscard]] std::string qif_text(pugi::xml_node element);

}  // namespace frustum::metrology
