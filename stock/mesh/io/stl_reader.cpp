#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "core/byte_reader.hpp"
#include "core/counted.hpp"
#include "core/text_words.hpp"
#include "stock/mesh/io/mesh_formats.hpp"

namespace frustum::stock {
namespace {

Result<Vec3> stl_corner(TextWords& words) {
  Vec3 point;
  for (double& x : point) {
    const std::string_view word = words.next();
    const auto value = finite_number_in_word(word);
    if (!value) return not_a_number(words.line(), word, "a finite coordinate");
    x = *value;
  }
  return point;
}

// Corners that agree to the last bit become one vertex.
class CornerWeld {
 public:
  explicit CornerWeld(SurfaceMesh& mesh) : mesh_(mesh) {}
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

Result<SurfaceMesh> binary_stl(std::string_view bytes) {
  ByteReader in(bytes, 80);
  const auto count = in.next<std::uint32_t>();
  if (!count) {
    return error(
        "file-cut-short"_id,
        fmt::format("the file ends at byte {}, within the header of a binary STL", bytes.size()),
        "it was cut short: write or copy it again");
  }
  const std::uint64_t wanted = 84 + std::uint64_t{50} * *count;
  if (bytes.size() < wanted) {
    return error("file-cut-short"_id,
                 fmt::format("a binary STL of {} triangles has {} bytes, this file has {}", *count,
                             wanted, bytes.size()),
                 "it was cut short, or is no STL");
  }
  SurfaceMesh mesh;
  CornerWeld weld(mesh);
  for (std::uint32_t t = 0; t < *count; ++t) {
    for (int k = 0; k < 3; ++k) (void)in.next<float>();  // the normal follows from the corners
    std::vector<std::uint32_t> corners;
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 point;
      for (double& x : point) x = static_cast<double>(*in.next<float>());
      if (!point.allFinite()) {
        return error("coordinate-not-finite"_id,
                     fmt::format("triangle {} at byte {} has a coordinate that is not finite",
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
  CornerWeld weld(mesh);
  TextWords words(text);
  words.skip_line();  // solid NAME
  std::vector<std::uint32_t> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "vertex") {
      const auto point = stl_corner(words);
      if (!point) return point.error();
      corners.push_back(weld(*point));
    } else if (word == "endfacet") {
      if (corners.size() != 3) {
        return mesh_fault(
            "facet-corners"_id, words.line(),
            fmt::format("a facet with {}", counted(corners.size(), "vertex", "vertices")),
            "facets of an STL have three");
      }
      add_polygon(mesh, corners);
      corners.clear();
    } else if (word == "endsolid" || word == "solid" || word == "facet") {
      words.skip_line();
    } else if (word != "outer" && word != "loop" && word != "endloop") {
      return mesh_fault("stl-word"_id, words.line(),
                        fmt::format("'{}' is no word of a text STL", word.substr(0, 40)));
    }
  }
  if (!corners.empty())
    return mesh_fault("file-cut-short"_id, words.line(), "the file ends within a facet");
  return mesh;
}

}  // namespace

// Some programs begin binary files with "solid" too; their size decides.
Result<SurfaceMesh> parse_stl(std::string_view bytes) {
  if (bytes.size() >= 84) {
    const auto count = *ByteReader(bytes, 80).next<std::uint32_t>();
    if (bytes.size() == 84 + std::uint64_t{50} * count) return binary_stl(bytes);
  }
  return bytes.starts_with("solid") ? text_stl(bytes) : binary_stl(bytes);
}

}  // namespace frustum::stock
