#include "core/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace frustum {
namespace {

struct PlyTypeName {
  std::string_view name, other_name;
  PlyType type;
};
constexpr std::array kPlyTypeNames{
    PlyTypeName{"char", "int8", PlyType::i8},      PlyTypeName{"uchar", "uint8", PlyType::u8},
    PlyTypeName{"short", "int16", PlyType::i16},   PlyTypeName{"ushort", "uint16", PlyType::u16},
    PlyTypeName{"int", "int32", PlyType::i32},     PlyTypeName{"uint", "uint32", PlyType::u32},
    PlyTypeName{"float", "float32", PlyType::f32}, PlyTypeName{"double", "float64", PlyType::f64}};

// Meshes number their vertices with 32 bits.
constexpr std::size_t kMostRows = 0xFFFFFFFFU;
constexpr double kLongestList = 1e6;

Diagnostic header_fault(int line, std::string message, std::string hint = {}) {
  Diagnostic found = error("ply-header"_id, std::move(message), std::move(hint));
  found.line = line;
  return found;
}

Result<PlyType> ply_type_of(std::string_view word, int line) {
  for (const auto& [name, other_name, type] : kPlyTypeNames) {
    if (word == name || word == other_name) return type;
  }
  return header_fault(line, fmt::format("'{}' is no type of a PLY", word.substr(0, 40)),
                      "char, uchar, short, ushort, int, uint, float or double");
}

Result<PlyProperty> ply_property(TextWords& words) {
  PlyProperty property;
  std::string_view word = words.next_in_line();
  if (word == "list") {
    const auto count = ply_type_of(words.next_in_line(), words.line());
    if (!count) return count.error();
    property.count = *count;
    word = words.next_in_line();
  }
  const auto type = ply_type_of(word, words.line());
  if (!type) return type.error();
  property.type = *type;
  property.name = words.next_in_line();
  if (property.name.empty()) {
    return header_fault(words.line(), "a property is a type and a name",
                        "for example property double x");
  }
  return property;
}

Result<PlyElement> ply_element(TextWords& words) {
  PlyElement element;
  element.name = words.next_in_line();
  const std::string_view count = words.next_in_line();
  const auto number = number_in_word<std::size_t>(count);
  if (!number || *number > kMostRows) {
    return header_fault(words.line(), fmt::format("'{}' is not a count of elements", count));
  }
  element.count = *number;
  return element;
}

std::optional<PlyEncoding> encoding_named(std::string_view name) {
  if (name == "ascii") return PlyEncoding::text;
  if (name == "binary_little_endian") return PlyEncoding::little_endian;
  if (name == "binary_big_endian") return PlyEncoding::big_endian;
  return std::nullopt;
}

std::optional<std::size_t> column_of(const PlyElement& element, std::string_view name,
                                     bool is_list) {
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    if (property.name == name && property.count.has_value() == is_list) return k;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> PlyElement::value_column(std::string_view property) const {
  return column_of(*this, property, false);
}
std::optional<std::size_t> PlyElement::list_column(std::string_view property) const {
  return column_of(*this, property, true);
}

Result<PlyHeader> read_ply_header(std::string_view bytes) {
  TextWords words(bytes);
  if (words.next() != "ply") return header_fault(1, "a PLY begins with the line 'ply'");
  PlyHeader header;
  std::optional<PlyEncoding> encoding;
  for (std::string_view word = words.next(); word != "end_header"; word = words.next()) {
    const int line = words.line();
    if (word.empty()) return header_fault(line, "the header of the PLY has no end_header");
    if (word == "format") {
      const std::string_view name = words.next_in_line();
      encoding = encoding_named(name);
      if (!encoding) {
        return header_fault(line, fmt::format("'{}' is no format of a PLY", name.substr(0, 40)),
                            "ascii, binary_little_endian or binary_big_endian");
      }
    } else if (word == "element") {
      auto element = ply_element(words);
      if (!element) return element.error();
      header.elements.push_back(*std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) return header_fault(line, "a property of no element");
      auto property = ply_property(words);
      if (!property) return property.error();
      header.elements.back().properties.push_back(*std::move(property));
    } else if (word == "comment") {
      header.comments.push_back({line, std::string(words.rest_of_line())});
    } else if (word != "obj_info") {
      return header_fault(line, fmt::format("'{}' is no line of a PLY header", word.substr(0, 40)));
    }
    words.skip_line();
  }
  if (!encoding) return header_fault(words.line(), "the header of the PLY names no format");
  header.encoding = *encoding;
  header.lines = words.line();
  words.skip_line();
  header.end = std::min(words.at() + 1, bytes.size());
  return header;
}

PlyBody::PlyBody(std::string_view bytes, const PlyHeader& header)
    : is_text_(header.encoding == PlyEncoding::text),
      size_(bytes.size()),
      words_(bytes.substr(header.end), header.lines + 1),
      binary_(bytes, header.end,
              header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little) {
}

template <typename T>
PlyBody::Number PlyBody::next_binary() {
  const auto value = binary_.next<T>();
  if (!value) return {};
  return {static_cast<double>(*value)};
}

PlyBody::Number PlyBody::next(PlyType type) {
  if (is_text_) {
    const std::string_view word = words_.next();
    return {number_in_word<double>(word), word};
  }
  switch (type) {
    case PlyType::i8:
      return next_binary<std::int8_t>();
    case PlyType::u8:
      return next_binary<std::uint8_t>();
    case PlyType::i16:
      return next_binary<std::int16_t>();
    case PlyType::u16:
      return next_binary<std::uint16_t>();
    case PlyType::i32:
      return next_binary<std::int32_t>();
    case PlyType::u32:
      return next_binary<std::uint32_t>();
    case PlyType::f32:
      return next_binary<float>();
    case PlyType::f64:
      break;
  }
  return next_binary<double>();
}

Diagnostic PlyBody::no_number(const PlyElement& element, std::size_t index,
                              std::string_view word) const {
  const std::string what = fmt::format("{} {} of {}", element.name, index + 1, element.count);
  if (!word.empty()) {
    return fault("number-expected"_id,
                 fmt::format("{} holds '{}', which is not a number", what, word.substr(0, 40)));
  }
  return error(
      "file-cut-short"_id,
      fmt::format("the file ends within {}, at byte {} within the body of the PLY", what, size_),
      "it was cut short: write or copy it again");
}

std::optional<Diagnostic> PlyBody::read(const PlyElement& element, std::size_t index, PlyRow& row) {
  row.values.assign(element.properties.size(), 0.0);
  row.lists.resize(element.properties.size());
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    row.lists[p].clear();
    if (!property.count) {
      const Number number = next(property.type);
      if (!number.value) return no_number(element, index, number.word);
      row.values[p] = *number.value;
      continue;
    }
    const Number length = next(*property.count);
    if (!length.value) return no_number(element, index, length.word);
    if (!(*length.value >= 0.0 && *length.value <= kLongestList)) {
      return fault("ply-list-length"_id, fmt::format("a list of {} values", *length.value));
    }
    const auto count = static_cast<std::size_t>(*length.value);
    for (std::size_t k = 0; k < count; ++k) {
      const Number number = next(property.type);
      if (!number.value) return no_number(element, index, number.word);
      row.lists[p].push_back(*number.value);
    }
  }
  return std::nullopt;
}

Diagnostic PlyBody::fault(DiagnosticId id, std::string message, std::string hint) const {
  if (!is_text_) message += fmt::format(", before byte {}", binary_.at());
  Diagnostic found = error(id, std::move(message), std::move(hint));
  if (is_text_) found.line = words_.line();
  return found;
}

}  // namespace frustum
