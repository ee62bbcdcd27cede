#include "metrology/points/ply_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace frustum::metrology {
namespace {

enum class Encoding { text, little, big };

struct TypeRow {
  std::string_view name, other_name;
  std::size_t bytes;
  char kind;  // i: signed, u: unsigned, f: floating point
};
constexpr std::array kTypes{
    TypeRow{"char", "int8", 1, 'i'},     TypeRow{"uchar", "uint8", 1, 'u'},
    TypeRow{"short", "int16", 2, 'i'},   TypeRow{"ushort", "uint16", 2, 'u'},
    TypeRow{"int", "int32", 4, 'i'},     TypeRow{"uint", "uint32", 4, 'u'},
    TypeRow{"float", "float32", 4, 'f'}, TypeRow{"double", "float64", 8, 'f'}};

const TypeRow* type_named(std::string_view name) {
  for (const TypeRow& row : kTypes) {
    if (row.name == name || row.other_name == name) return &row;
  }
  return nullptr;
}

struct Property {
  const TypeRow* count = nullptr;  // of a list
  const TypeRow* type = nullptr;
  std::string name{};
};
struct PlyElement {
  std::string name{};
  std::uint64_t count = 0;
  std::vector<Property> properties{};
};

Diagnostic at_line(int line, std::string message, std::string hint = {}) {
  Diagnostic d = error(std::move(message), std::move(hint));
  d.line = line;
  return d;
}

std::vector<std::string_view> ply_words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t first = line.find_first_not_of(" \t\r", at);
    if (first == std::string_view::npos) break;
    at = std::min(line.find_first_of(" \t\r", first), line.size());
    words.push_back(line.substr(first, at - first));
  }
  return words;
}

template <typename T>
std::optional<T> ply_number_in(std::string_view text) {
  T value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

class PlyReader {
 public:
  explicit PlyReader(std::string_view bytes) : rest_(bytes) {}

  Result<PlyPoints> read() {
    if (auto fault = header()) return *std::move(fault);
    for (const PlyElement& element : elements_) {
      if (element.name == "vertex") {
        if (auto fault = vertices(element)) return *std::move(fault);
        return std::move(found_);
      }
      if (auto fault = pass_over(element)) return *std::move(fault);
    }
    return at_line(line_, "the PLY has no vertices", "a point cloud is its element vertex");
  }

 private:
  using Fault = std::optional<Diagnostic>;

  std::string_view next_line() {
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return line;
  }

  Fault header() {
    const auto first = ply_words_of(next_line());
    if (first.size() != 1 || first[0] != "ply") {
      return at_line(1, "a PLY begins with the line 'ply'");
    }
    bool has_format = false;
    while (!rest_.empty()) {
      const std::string_view line = next_line();
      const auto words = ply_words_of(line);
      if (words.empty() || words[0] == "obj_info") continue;
      if (words[0] == "end_header") {
        if (!has_format) return at_line(line_, "the header of the PLY names no format");
        ++line_;  // where the body begins
        return std::nullopt;
      }
      Fault fault;
      if (words[0] == "comment") {
        fault = comment(line.substr(line.find("comment") + 7));
      } else if (words[0] == "format" && words.size() >= 2) {
        has_format = true;
        fault = format(words[1]);
      } else if (words[0] == "element" && words.size() == 3) {
        const auto count = ply_number_in<std::uint64_t>(words[2]);
        if (!count) return at_line(line_, fmt::format("'{}' is not a count", words[2]));
        elements_.push_back({std::string(words[1]), *count, {}});
      } else if (words[0] == "property" && !elements_.empty()) {
        fault = property(words);
      } else {
        return at_line(line_, fmt::format("'{}' is no line of a PLY header", words[0]));
      }
      if (fault) return fault;
    }
    return at_line(line_, "the header of the PLY has no end_header");
  }

  Fault comment(std::string_view text) {
    const auto unit = stated_unit(text);
    if (!unit) return at_line(line_, unit.error().front().message, unit.error().front().hint);
    if (*unit) found_.unit = *unit;
    return std::nullopt;
  }

  Fault format(std::string_view name) {
    constexpr std::array<std::string_view, 3> kNames{"ascii", "binary_little_endian",
                                                     "binary_big_endian"};
    const auto* const found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) {
      return at_line(line_, fmt::format("'{}' is no format of a PLY", name),
                     "known: ascii, binary_little_endian, binary_big_endian");
    }
    encoding_ = static_cast<Encoding>(found - kNames.begin());
    return std::nullopt;
  }

  Fault property(const std::vector<std::string_view>& words) {
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) {
      return at_line(line_, "a property is a type and a name", "for example property double x");
    }
    Property made{is_list ? type_named(words[2]) : nullptr, type_named(words[is_list ? 3 : 1]),
                  std::string(words.back())};
    if (made.type == nullptr || (is_list && made.count == nullptr)) {
      return at_line(line_, fmt::format("'{}' is no type of a PLY", words[is_list ? 2 : 1]));
    }
    elements_.back().properties.push_back(std::move(made));
    return std::nullopt;
  }

  // Nothing when the bytes end or the word is not a number.
  std::optional<double> number(const TypeRow& type) {
    if (encoding_ == Encoding::text) {
      while (!rest_.empty() &&
             std::string_view(" \t\r\n").find(rest_[0]) != std::string_view::npos) {
        if (rest_[0] == '\n') ++line_;
        rest_.remove_prefix(1);
      }
      const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
      rest_.remove_prefix(word.size());
      return ply_number_in<double>(word);
    }
    if (rest_.size() < type.bytes) return std::nullopt;
    std::array<char, 8> raw{};
    std::copy_n(rest_.begin(), type.bytes, raw.begin());
    rest_.remove_prefix(type.bytes);
    const bool is_native =
        (encoding_ == Encoding::little) == (std::endian::native == std::endian::little);
    if (!is_native) std::reverse(raw.begin(), raw.begin() + static_cast<long>(type.bytes));
    return value_of(raw, type);
  }

  template <typename T>
  static double as(const std::array<char, 8>& raw) {
    T value{};
    std::memcpy(&value, raw.data(), sizeof value);
    return static_cast<double>(value);
  }
  static double value_of(const std::array<char, 8>& raw, const TypeRow& type) {
    if (type.kind == 'f') return type.bytes == 4 ? as<float>(raw) : as<double>(raw);
    const bool is_signed = type.kind == 'i';
    if (type.bytes == 1) return is_signed ? as<std::int8_t>(raw) : as<std::uint8_t>(raw);
    if (type.bytes == 2) return is_signed ? as<std::int16_t>(raw) : as<std::uint16_t>(raw);
    return is_signed ? as<std::int32_t>(raw) : as<std::uint32_t>(raw);
  }

  [[nodiscard]] Diagnostic bad_body(const PlyElement& element, std::uint64_t index) const {
    const std::string what = fmt::format("{} {} of {}", element.name, index + 1, element.count);
    if (rest_.empty()) return at_line(0, fmt::format("the PLY ends within {}", what));
    return at_line(encoding_ == Encoding::text ? line_ : 0,
                   fmt::format("{} holds a word that is not a number", what));
  }

  Fault pass_over(const PlyElement& element) {
    if (element.properties.empty()) return std::nullopt;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& p : element.properties) {
        double repeats = 1.0;
        if (p.count != nullptr) {
          const auto count = number(*p.count);
          if (!count) return bad_body(element, i);
          repeats = *count;
        }
        for (double k = 0.0; k < repeats; ++k) {
          if (!number(*p.type)) return bad_body(element, i);
        }
      }
    }
    return std::nullopt;
  }

  Fault vertices(const PlyElement& element) {
    std::array<int, 3> axes{-1, -1, -1};  // the property that holds each coordinate
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& p = element.properties[k];
      if (p.count != nullptr) return at_line(0, "the vertices of the PLY hold a list");
      if (p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') {
        axes.at(static_cast<std::size_t>(p.name[0] - 'x')) = static_cast<int>(k);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (axes.at(static_cast<std::size_t>(axis)) >= 0) continue;
      return at_line(
          0,
          fmt::format("the vertices of the PLY have no property {}", static_cast<char>('x' + axis)),
          "a point needs x, y and z");
    }
    std::vector<double> values(element.properties.size());
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        const auto value = number(*element.properties[k].type);
        if (!value) return bad_body(element, i);
        values[k] = *value;
      }
      const auto at = [&](std::size_t axis) {
        return values[static_cast<std::size_t>(axes.at(axis))];
      };
      const Vec3 point(at(0), at(1), at(2));
      if (!point.allFinite()) {
        return at_line(encoding_ == Encoding::text ? line_ : 0,
                       fmt::format("vertex {} of the PLY is not finite", i + 1),
                       "leave out points that were not measured");
      }
      found_.points.push_back(point);
    }
    return std::nullopt;
  }

  std::string_view rest_;
  int line_ = 0;
  Encoding encoding_ = Encoding::text;
  std::vector<PlyElement> elements_{};
  PlyPoints found_{};
};

}  // namespace

Result<PlyPoints> parse_ply_points(std::string_view bytes) { return PlyReader(bytes).read(); }

}  // namespace frustum::metrology
