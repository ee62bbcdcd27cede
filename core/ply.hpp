// PLY files: the header, and the rows of its elements one after another.
//
// Text, binary little endian and binary big endian, all number types, lists. What the elements mean
// is for the reader of a mesh or of a point cloud to say.
// Units : as the numbers are
// Errors: a header that is malformed, rows that end too early, words that are no numbers; with the
//         line, or with the byte in binary files, and with the number of the row. Diagnostics name
//         no file
// Source: G. Turk, The PLY Polygon File Format, 1994
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/byte_reader.hpp"
#include "core/result.hpp"
#include "core/text_words.hpp"

namespace frustum {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class PlyEncoding : std::uint8_t { text, little_endian, big_endian };

struct PlyProperty {
  std::string name{};
  PlyType type = PlyType::f32;
  std::optional<PlyType> count{};  // of a list
};

struct PlyElement {
  std::string name{};
  std::size_t count = 0;
  std::vector<PlyProperty> properties{};

  // Of the property with one value, or with a list of them.
  [[nodiscard]] std::optional<std::size_t> value_column(std::string_view property) const;
  [[nodiscard]] std::optional<std::size_t> list_column(std::string_view property) const;
};

struct PlyComment {
  int line = 0;
  std::string text{};  // after the word "comment"
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements{};
  std::vector<PlyComment> comments{};
  std::size_t end = 0;  // the first byte after it
  int lines = 0;
};

[[nodiscard]] Result<PlyHeader> read_ply_header(std::string_view bytes);

// One row of an element, by the columns of its properties: of single properties the value, of
// others the list.
struct PlyRow {
  std::vector<double> values{};
  std::vector<std::vector<double>> lists{};
};

// The rows that follow the header, in the order of its elements.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const PlyHeader& header);

  // The row with this index, from 0; call it once for every row of every element. Text may say nan
  // or inf.
  [[nodiscard]] std::optional<Diagnostic> read(const PlyElement& element, std::size_t index,
                                               PlyRow& row);
  // An error of what has just been read: at its line, or before a byte.
  [[nodiscard]] Diagnostic fault(DiagnosticId id, std::string message, std::string hint = {}) const;

 private:
  struct Number {
    std::optional<double> value{};
    std::string_view word{};  // of a text
  };
  Number next(PlyType type);
  template <typename T>
  Number next_binary();
  [[nodiscard]] Diagnostic no_number(const PlyElement& element, std::size_t index,
                                     std::string_view word) const;

  bool is_text_;
  std::size_t size_;
  TextWords words_;
  ByteReader binary_;
};

}  // namespace frustum
