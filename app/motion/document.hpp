// A document that is built up field by field, and written as JSON at the end.
//
// Units  : those that the names of the fields say
// Errors : none; numbers that are not finite are written as null
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace frustum::app {

class Document;

// Nothing is null.
using Lists = std::vector<std::vector<double>>;
class DocumentValue {
 public:
  DocumentValue() = default;
  // Implicit: what is assigned to a field.
  DocumentValue(double number) : value_(number) {}                             // NOLINT
  DocumentValue(std::uint64_t count) : value_(count) {}                        // NOLINT
  DocumentValue(const char* text) : value_(std::string(text)) {}               // NOLINT
  DocumentValue(std::string_view text) : value_(std::string(text)) {}          // NOLINT
  DocumentValue(std::string text) : value_(std::move(text)) {}                 // NOLINT
  DocumentValue(std::vector<double> numbers) : value_(std::move(numbers)) {}   // NOLINT
  DocumentValue(std::vector<std::string> texts) : value_(std::move(texts)) {}  // NOLINT
  DocumentValue(Lists lists) : value_(std::move(lists)) {}                     // NOLINT
  DocumentValue(std::vector<Lists> lists) : value_(std::move(lists)) {}        // NOLINT
  DocumentValue(Document fields);                                              // NOLINT
  DocumentValue(const std::vector<Document>& list);                            // NOLINT
  DocumentValue(const std::optional<double>& number) {                         // NOLINT
    if (number) value_ = *number;
  }

 private:
  friend class DocumentWriter;
  using Field = std::pair<std::string, DocumentValue>;
  std::variant<std::monostate, double, std::uint64_t, std::string, std::vector<double>,
               std::vector<std::string>, Lists, std::vector<Lists>, std::vector<Field>,
               std::vector<std::vector<Field>>>
      value_{};
};

class Document {
 public:
  using Field = std::pair<std::string, DocumentValue>;
  Document() = default;
  Document(std::initializer_list<Field> fields) : fields_(fields) {}

  // The field of that name, made at the end where there is none.
  DocumentValue& operator[](std::string_view name);
  [[nodiscard]] const std::vector<Field>& fields() const { return fields_; }
  [[nodiscard]] std::string json() const;

 private:
  std::vector<Field> fields_{};
};

}  // namespace frustum::app
