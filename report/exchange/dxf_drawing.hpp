// A drawing in the Drawing Exchange Format: lines, arcs, circles, points and polylines on layers.
//
// Model  : ASCII DXF of AutoCAD release 12 (AC1009), which every program reads: a comment with the
//          version of Frustum, a header, a table of layers, entities; an arc is the
//          counter-clockwise one between its angles
// Units  : mm; the format itself states none
// Errors : none; what is not finite is left out; names of layers are put into the characters that
//          the release has
// Source : Autodesk, DXF Reference, group codes 0, 8, 10 to 31, 40, 50, 51, 62, 66, 70, 999
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/units.hpp"

namespace frustum::report {

class DxfDrawing {
 public:
  // A colour of the format: 1 red, 2 yellow, 3 green, 4 cyan, 5 blue, 6 magenta, 7 black or white,
  // 8 grey.
  void line(std::string_view layer, int colour, const Vec3& from, const Vec3& to);
  void arc(std::string_view layer, int colour, const Vec3& centre, double radius, Rad from, Rad to);
  void point(std::string_view layer, int colour, const Vec3& at);
  void polyline(std::string_view layer, int colour, std::span<const Vec3> points, bool closed);
  void text(std::string_view layer, int colour, const Vec3& at, double height,
            std::string_view content);
  [[nodiscard]] std::string file() const;

  // Letters, digits, $, - and _: others become _.
  [[nodiscard]] static std::string layer_name(std::string_view name);

 private:
  void begin(std::string_view entity, std::string_view layer, int colour);
  void place(int code, const Vec3& at);

  std::string entities_{};
  std::vector<std::pair<std::string, int>> layers_{};  // with the colour of their first entity
};

}  // namespace frustum::report
