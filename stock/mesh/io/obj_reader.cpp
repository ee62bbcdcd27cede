#include <fmt/format.h>

#include <cstdint>

#include "core/counted.hpp"
#include "core/text_words.hpp"
#include "stock/mesh/io/mesh_formats.hpp"

namespace frustum::stock {
namespace {

// The rest of a line that begins with v: three coordinates, and weights or colours that are not
// needed.
Result<Vec3> obj_point(TextWords& words) {
  const int line = words.line();
  Vec3 point;
  for (double& x : point) {
    const std::string_view word = words.next_in_line();
    if (word.empty())
      return mesh_fault("vertex-coordinates"_id, line, "a vertex has three coordinates");
    const auto value = finite_number_in_word(word);
    if (!value) return not_a_number(line, word, "a finite coordinate");
    x = *value;
  }
  return point;
}

}  // namespace

Result<SurfaceMesh> parse_obj(std::string_view text) {
  SurfaceMesh mesh;
  TextWords words(text);
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
        const auto index = number_in_word<std::int64_t>(corner.substr(0, corner.find('/')));
        const auto count = static_cast<std::int64_t>(mesh.vertices.size());
        // Negative ones count back from the last vertex.
        const std::int64_t place = index ? (*index < 0 ? count + *index : *index - 1) : -1;
        if (place < 0 || place >= count) {
          return mesh_fault("vertex-unknown"_id, line,
                            fmt::format("'{}' is no vertex: {} are known here, counted from 1",
                                        corner.substr(0, 40), count));
        }
        corners.push_back(static_cast<std::uint32_t>(place));
      }
      if (corners.size() < 3) {
        return mesh_fault("facet-corners"_id, line,
                          fmt::format("a face with {}", counted(corners.size(), "corner")));
      }
      add_polygon(mesh, corners);
    }
    words.skip_line();
  }
  return mesh;
}

}  // namespace frustum::stock
