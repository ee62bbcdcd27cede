#include "stock/mesh/io/mesh_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace frustum::stock {
namespace {

constexpr const char* kReadable = "convert the mesh to .stl, .ply or .obj";

constexpr std::size_t kMostVertices = 0xFFFFFFFFU;

Diagnostic at_line(int line, std::string message, std::string hint = {}) {
  Diagnostic found = error(std::move(message), std::move(hint));
  found.line = line;
  return found;
}

// Words of a text, with their lines.
class Words {
 public:
  explicit Words(std::string_view text, int line = 1) : text_(text), line_(line) {}

  // Empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }
  // Of this line only; empty at its end.
  std::string_view next_in_line() {
    while (at_ < text_.size() && is_space(text_[at_]) && text_[at_] != '\n') ++at_;
    return at_ < text_.size() && text_[at_] == '\n' ? std::string_view{} : next();
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view text_;
  std::size_t at_ = 0;
  int line_;
};

template <typename Number>
std::optional<Number> number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value{};
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

Diagnostic no_number(int line, std::string_view word, std::string_view what) {
  if (word.empty()) return at_line(line, fmt::format("the file ends where {} should be", what));
  return at_line(line, fmt::format("'{}' is not {}", word.substr(0, 40), what));
}

Result<Vec3> point_of(Words& words) {
  Vec3 point;
  for (double& x : point) {
    const std::string_view word = words.next();
    const auto value = number_of<double>(word);
    if (!value) return no_number(words.line(), word, "a finite coordinate");
    x = *value;
  }
  return point;
}

void add_polygon(SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners) {
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const std::array<std::uint32_t, 3> t{corners[0], corners[k - 1], corners[k]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
  }
}

// Corners that agree to the last bit become one vertex.
class Weld {
 public:
  explicit Weld(SurfaceMesh& mesh) : mesh_(mesh) {}
  std::uint32_t operator()(Vec3 point) {
    point += Vec3::Zero();  // -0 becomes 0
    const auto [found, is_new] =
        numbers_.try_emplace(point, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(point);
    return found->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const Vec3& p) const {
      std::uint64_t mixed = 0;
      for (const double x : p) {
        mixed = (mixed ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U;
        mixed ^= mixed >> 29U;
      }
      return mixed;
    }
  };
  SurfaceMesh& mesh_;
  std::unordered_map<Vec3, std::uint32_t, Hash> numbers_{};
};

// Numbers of a binary file, in its byte order.
class Bytes {
 public:
  Bytes(std::string_view bytes, std::size_t at, bool big_endian)
      : bytes_(bytes), at_(at), swap_(big_endian != (std::endian::native == std::endian::big)) {}

  template <typename Number>
  std::optional<Number> next() {
    if (at_ > bytes_.size() || bytes_.size() - at_ < sizeof(Number)) return std::nullopt;
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(Number));
    if (swap_) std::reverse(raw.begin(), raw.end());
    at_ += sizeof(Number);
    return std::bit_cast<Number>(raw);
  }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::string_view bytes_;
  std::size_t at_;
  bool swap_;
};

Diagnostic cut_short(std::size_t byte, std::string_view what) {
  return error(fmt::format("the file ends at byte {}, within {}", byte, what),
               "it was cut short: write or copy it again");
}

Result<SurfaceMesh> binary_stl(std::string_view bytes) {
  Bytes in(bytes, 80, false);
  const auto count = in.next<std::uint32_t>();
  if (!count) return cut_short(bytes.size(), "the header of a binary STL");
  const std::uint64_t wanted = 84 + std::uint64_t{50} * *count;
  if (bytes.size() < wanted) {
    return error(fmt::format("a binary STL of {} triangles has {} bytes, this file has {}", *count,
                             wanted, bytes.size()),
                 "it was cut short, or is no STL");
  }
  SurfaceMesh mesh;
  Weld weld(mesh);
  for (std::uint32_t t = 0; t < *count; ++t) {
    for (int k = 0; k < 3; ++k) (void)in.next<float>();  // the normal follows from the corners
    std::vector<std::uint32_t> corners;
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 point;
      for (double& x : point) x = static_cast<double>(*in.next<float>());
      if (!point.allFinite()) {
        return error(fmt::format("triangle {} at byte {} has a coordinate that is not finite",
                                 t + 1, 84 + std::size_t{50} * t));
      }
      corners.push_back(weld(point));
    }
    (void)in.next<std::uint16_t>();
    add_polygon(mesh, corners);
  }
  return mesh;
}

Result<SurfaceMesh> text_stl(std::string_view text) {
  SurfaceMesh mesh;
  Weld weld(mesh);
  Words words(text);
  words.skip_line();  // solid NAME
  std::vector<std::uint32_t> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "vertex") {
      const auto point = point_of(words);
      if (!point) return point.error();
      corners.push_back(weld(*point));
    } else if (word == "endfacet") {
      if (corners.size() != 3) {
        return at_line(words.line(), fmt::format("a facet with {} vertices", corners.size()),
                       "facets of an STL have three");
      }
      add_polygon(mesh, corners);
      corners.clear();
    } else if (word == "endsolid" || word == "solid" || word == "facet") {
      words.skip_line();
    } else if (word != "outer" && word != "loop" && word != "endloop") {
      return at_line(words.line(),
                     fmt::format("'{}' is no word of a text STL", word.substr(0, 40)));
    }
  }
  if (!corners.empty()) return at_line(words.line(), "the file ends within a facet");
  return mesh;
}

// Some programs begin binary files with "solid" too; their size tells.
Result<SurfaceMesh> parse_stl(std::string_view bytes) {
  if (bytes.size() >= 84) {
    const auto count = *Bytes(bytes, 80, false).next<std::uint32_t>();
    if (bytes.size() == 84 + std::uint64_t{50} * count) return binary_stl(bytes);
  }
  return bytes.starts_with("solid") ? text_stl(bytes) : binary_stl(bytes);
}

enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };
constexpr std::array<std::pair<std::string_view, PlyType>, 16> kPlyTypes{
    {{"char", PlyType::i8},
     {"uchar", PlyType::u8},
     {"short", PlyType::i16},
     {"ushort", PlyType::u16},
     {"int", PlyType::i32},
     {"uint", PlyType::u32},
     {"float", PlyType::f32},
     {"double", PlyType::f64},
     {"int8", PlyType::i8},
     {"uint8", PlyType::u8},
     {"int16", PlyType::i16},
     {"uint16", PlyType::u16},
     {"int32", PlyType::i32},
     {"uint32", PlyType::u32},
     {"float32", PlyType::f32},
     {"float64", PlyType::f64}}};

std::optional<PlyType> ply_type(std::string_view word) {
  for (const auto& [name, type] : kPlyTypes) {
    if (name == word) return type;
  }
  return std::nullopt;
}

struct PlyProperty {
  std::string name{};
  PlyType type = PlyType::f32;
  std::optional<PlyType> count{};  // of a list
};
struct PlyElement {
  std::string name{};
  std::size_t count = 0;
  std::vector<PlyProperty> properties{};
};
struct PlyHeader {
  bool text = false;
  bool big_endian = false;
  std::vector<PlyElement> elements{};
  std::size_t end = 0;  // the first byte after it
  int lines = 0;
};

Result<PlyProperty> property_of(Words& words) {
  PlyProperty property;
  std::string_view word = words.next_in_line();
  if (word == "list") {
    word = words.next_in_line();
    property.count = ply_type(word);
    if (!property.count) {
      return at_line(words.line(), fmt::format("'{}' is no type of a PLY", word));
    }
    word = words.next_in_line();
  }
  const auto type = ply_type(word);
  if (!type) return at_line(words.line(), fmt::format("'{}' is no type of a PLY", word));
  property.type = *type;
  property.name = words.next_in_line();
  return property;
}

Result<PlyHeader> ply_header(std::string_view bytes) {
  Words words(bytes);
  if (words.next() != "ply") return at_line(1, "a PLY begins with the line 'ply'");
  PlyHeader header;
  bool has_format = false;
  for (std::string_view word = words.next(); word != "end_header"; word = words.next()) {
    if (word.empty()) return at_line(words.line(), "the header of the PLY has no end_header");
    if (word == "format") {
      const std::string_view kind = words.next_in_line();
      header.text = kind == "ascii";
      header.big_endian = kind == "binary_big_endian";
      has_format = header.text || header.big_endian || kind == "binary_little_endian";
      if (!has_format) {
        return at_line(words.line(), fmt::format("'{}' is no format of a PLY", kind),
                       "ascii, binary_little_endian or binary_big_endian");
      }
    } else if (word == "element") {
      PlyElement element;
      element.name = words.next_in_line();
      const std::string_view count = words.next_in_line();
      const auto number = number_of<std::size_t>(count);
      if (!number || *number > kMostVertices) {
        return at_line(words.line(), fmt::format("'{}' is no count of elements", count));
      }
      element.count = *number;
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) return at_line(words.line(), "a property of no element");
      auto property = property_of(words);
      if (!property) return property.error();
      header.elements.back().properties.push_back(std::move(*property));
    } else if (word != "comment" && word != "obj_info") {
      return at_line(words.line(), fmt::format("'{}' is no word of a PLY header", word));
    }
    words.skip_line();
  }
  if (!has_format) return at_line(words.line(), "the header of the PLY names no format");
  header.lines = words.line();
  words.skip_line();
  header.end = std::min(words.at() + 1, bytes.size());
  return header;
}

// The numbers of the body one by one, whatever its format.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const PlyHeader& header)
      : text_(header.text),
        words_(bytes.substr(header.end), header.lines + 1),
        binary_(bytes, header.end, header.big_endian) {}

  Result<double> next(PlyType type) {
    if (text_) {
      const std::string_view word = words_.next();
      const auto value = number_of<double>(word);
      if (!value) return no_number(words_.line(), word, "a finite number");
      return *value;
    }
    const std::size_t at = binary_.at();
    const auto value = binary(type);
    if (!value) return cut_short(at, "the body of the PLY");
    return *value;
  }
  [[nodiscard]] Diagnostic here(std::string message) const {
    if (text_) return at_line(words_.line(), std::move(message));
    return error(fmt::format("{}, before byte {}", message, binary_.at()));
  }

 private:
  template <typename Number>
  std::optional<double> as_double() {
    const auto value = binary_.next<Number>();
    if (!value) return std::nullopt;
    return static_cast<double>(*value);
  }
  std::optional<double> binary(PlyType type) {
    switch (type) {
      case PlyType::i8:
        return as_double<std::int8_t>();
      case PlyType::u8:
        return as_double<std::uint8_t>();
      case PlyType::i16:
        return as_double<std::int16_t>();
      case PlyType::u16:
        return as_double<std::uint16_t>();
      case PlyType::i32:
        return as_double<std::int32_t>();
      case PlyType::u32:
        return as_double<std::uint32_t>();
      case PlyType::f32:
        return as_double<float>();
      case PlyType::f64:
        break;
    }
    return as_double<double>();
  }

  bool text_;
  Words words_;
  Bytes binary_;
};

// One row of an element; the values of a list property go to `list`, of others to `single`.
struct PlyRow {
  std::vector<double> single{};
  std::vector<double> list{};
};

std::optional<Diagnostic> read_row(PlyBody& body, const PlyElement& element, PlyRow& row) {
  row.single.assign(element.properties.size(), 0.0);
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    std::size_t count = 1;
    const bool wanted = property.name == "vertex_indices" || property.name == "vertex_index";
    if (property.count) {
      const auto length = body.next(*property.count);
      if (!length) return length.error().front();
      if (!(*length >= 0.0) || *length > 1e6) {
        return body.here(fmt::format("a list of {} values", *length));
      }
      count = static_cast<std::size_t>(*length);
      if (wanted) row.list.clear();
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto value = body.next(property.type);
      if (!value) return value.error().front();
      if (!property.count) row.single[p] = *value;
      if (property.count && wanted) row.list.push_back(*value);
    }
  }
  return std::nullopt;
}

std::optional<Diagnostic> read_ply_vertices(PlyBody& body, const PlyElement& element,
                                            SurfaceMesh& mesh) {
  std::array<std::size_t, 3> place{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name(1, static_cast<char>('x' + k));
    const auto found =
        std::find_if(element.properties.begin(), element.properties.end(),
                     [&](const PlyProperty& p) { return p.name == name && !p.count; });
    if (found == element.properties.end()) {
      return error(fmt::format("the vertices of the PLY have no property {}", name));
    }
    place[k] = static_cast<std::size_t>(found - element.properties.begin());
  }
  PlyRow row;
  for (std::size_t v = 0; v < element.count; ++v) {
    if (auto fault = read_row(body, element, row)) return fault;
    const Vec3 point(row.single[place[0]], row.single[place[1]], row.single[place[2]]);
    if (!point.allFinite()) return body.here("a coordinate that is not finite");
    mesh.vertices.push_back(point);
  }
  return std::nullopt;
}

std::optional<Diagnostic> read_ply_faces(PlyBody& body, const PlyElement& element,
                                         SurfaceMesh& mesh) {
  PlyRow row;
  std::vector<std::uint32_t> corners;
  for (std::size_t f = 0; f < element.count; ++f) {
    row.list.clear();
    if (auto fault = read_row(body, element, row)) return fault;
    corners.clear();
    for (const double index : row.list) {
      if (!(index >= 0.0 && index < static_cast<double>(mesh.vertices.size()))) {
        return body.here(fmt::format("face {} names vertex {}; there are {}, counted from 0", f + 1,
                                     index, mesh.vertices.size()));
      }
      corners.push_back(static_cast<std::uint32_t>(index));
    }
    if (corners.size() < 3) {
      return body.here(fmt::format("face {} has {} corners", f + 1, corners.size()));
    }
    add_polygon(mesh, corners);
  }
  return std::nullopt;
}

Result<SurfaceMesh> parse_ply(std::string_view bytes) {
  const auto header = ply_header(bytes);
  if (!header) return header.error();
  SurfaceMesh mesh;
  PlyBody body(bytes, *header);
  PlyRow ignored;
  for (const PlyElement& element : header->elements) {
    std::optional<Diagnostic> fault;
    if (element.name == "vertex") {
      fault = read_ply_vertices(body, element, mesh);
    } else if (element.name == "face") {
      fault = read_ply_faces(body, element, mesh);
    } else if (!element.properties.empty()) {
      for (std::size_t row = 0; row < element.count && !fault; ++row) {
        fault = read_row(body, element, ignored);
      }
    }
    if (fault) return *fault;
  }
  return mesh;
}

// The rest of a line that begins with v: three coordinates, and weights or colours that are not needed.
Result<Vec3> obj_point(Words& words) {
  const int line = words.line();
  Vec3 point;
  for (double& x : point) {
    const std::string_view word = words.next_in_line();
    if (word.empty()) return at_line(line, "a vertex has three coordinates");
    const auto value = number_of<double>(word);
    if (!value) return no_number(line, word, "a finite coordinate");
    x = *value;
  }
  return point;
}

Result<SurfaceMesh> parse_obj(std::string_view text) {
  SurfaceMesh mesh;
  Words words(text);
  std::vector<std::uint32_t> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "v") {
      const auto point = obj_point(words);
      if (!point) return point.error();
      mesh.vertices.push_back(*point);
    } else if (word == "f") {
      corners.clear();
      const int line = words.line();
      for (auto corner = words.next_in_line(); !corner.empty(); corner = words.next_in_line()) {
        const auto index = number_of<std::int64_t>(corner.substr(0, corner.find('/')));
        const auto count = static_cast<std::int64_t>(mesh.vertices.size());
        // Negative ones count back from the last vertex.
        const std::int64_t place = index ? (*index < 0 ? count + *index : *index - 1) : -1;
        if (place < 0 || place >= count) {
          return at_line(line, fmt::format("'{}' is no vertex: {} are known here, counted from 1",
                                           corner.substr(0, 40), count));
        }
        corners.push_back(static_cast<std::uint32_t>(place));
      }
      if (corners.size() < 3) {
        return at_line(line, fmt::format("a face with {} corners", corners.size()));
      }
      add_polygon(mesh, corners);
    }
    words.skip_line();
  }
  return mesh;
}

}  // namespace

Result<SurfaceMesh> parse_mesh(std::string_view bytes, MeshFormat format) {
  Result<SurfaceMesh> mesh = error("3MF and VTP files are written here, not read", kReadable);
  if (format == MeshFormat::stl) mesh = parse_stl(bytes);
  if (format == MeshFormat::ply) mesh = parse_ply(bytes);
  if (format == MeshFormat::obj) mesh = parse_obj(bytes);
  if (mesh && mesh->triangles.empty()) return error("the file has no triangles");
  return mesh;
}

Result<SurfaceMesh> read_mesh(const std::filesystem::path& file) {
  const auto format = mesh_format_of(file);
  if (!format) {
    Diagnostic unknown = format.error().front();
    unknown.hint = kReadable;
    return unknown;
  }
  const auto named = [&](Diagnostic fault) {
    fault.file = file.string();
    return fault;
  };
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) {
    return named(error("this is a directory, not a mesh", "name one of the files in it"));
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) return named(error("the mesh cannot be read", "check the path and permissions"));
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  auto mesh = parse_mesh(bytes, *format);
  if (!mesh) return named(mesh.error().front());
  return mesh;
}

}  // namespace frustum::stock
