#include "programs/contour/contour_path.hpp"

#include <fmt/format.h>

namespace frustum::programs {
namespace {

constexpr double kLead = 20.0;        // mm before the first and past the last corner
constexpr double kApproach = 30.0;    // mm along the outward normal
constexpr double kAboveLedge = 0.5;   // mm
constexpr double kBelowBottom = 1.0;  // mm, of a through bore

using Kind = ContourMove::Kind;

class Moves {
 public:
  // From above `start` down to it.
  explicit Moves(const Vec3& start) {
    to(Kind::rapid, {start.x(), start.y(), kContourClear});
    to(Kind::rapid, start);
  }
  void to(Kind kind, const Vec3& end, const Vec3& centre = Vec3::Zero()) {
    moves_.push_back({kind, end, centre});
  }
  [[nodiscard]] std::vector<ContourMove> up() && {
    const Vec3 end = moves_.back().end;
    to(Kind::rapid, {end.x(), end.y(), kContourClear});
    return std::move(moves_);
  }

 private:
  std::vector<ContourMove> moves_{};
};

std::vector<ContourMove> around_circle(double radius, double z) {
  const Vec3 start(radius, 0.0, z), centre(0.0, 0.0, z);
  const Vec3 out = kApproach * Vec3::UnitX(), along = -kLead * Vec3::UnitY();
  Moves moves(start - along + out);
  moves.to(Kind::feed, start - along);
  moves.to(Kind::feed, start);
  moves.to(Kind::clockwise, start, centre);
  moves.to(Kind::feed, start + along);
  moves.to(Kind::feed, start + along + out);
  return std::move(moves).up();
}

std::vector<ContourMove> around_polygon(const ContourPolygon& polygon, double radius, double z) {
  const auto beside = [&](std::size_t corner, std::size_t side) -> Vec3 {
    return polygon.corner(corner) + radius * polygon.normal(side) + z * Vec3::UnitZ();
  };
  const Vec3 first = beside(0, 0) - kLead * polygon.along(0);
  const Vec3 last = beside(4, 3) + kLead * polygon.along(3);
  Moves moves(first + kApproach * polygon.normal(0));
  moves.to(Kind::feed, first);
  for (std::size_t side = 0; side < 3; ++side) {
    moves.to(Kind::feed, beside(side + 1, side));
    moves.to(Kind::clockwise, beside(side + 1, side + 1),
             polygon.corner(side + 1) + z * Vec3::UnitZ());
  }
  moves.to(Kind::feed, last);
  moves.to(Kind::feed, last + kApproach * polygon.normal(3));
  return std::move(moves).up();
}

// In from the centre and back there on half circles.
std::vector<ContourMove> inside_bore(double radius, double z) {
  const Vec3 centre(0.0, 0.0, z), start(radius, 0.0, z), half(0.5 * radius, 0.0, z);
  Moves moves(centre);
  moves.to(Kind::counterclockwise, start, half);
  moves.to(Kind::counterclockwise, start, centre);
  moves.to(Kind::counterclockwise, centre, half);
  return std::move(moves).up();
}

}  // namespace

std::vector<ContourOperation> contour_path(const ContourPiece& piece,
                                           const ContourGeometry& shape) {
  const double cutter = shape.cutter_radius;
  std::vector<ContourOperation> operations;
  operations.push_back({"circle",
                        {"circle"},
                        around_circle(shape.circle_radius + cutter, shape.floor(0) + kAboveLedge)});
  for (std::size_t i = 0; i < shape.polygons.size(); ++i) {
    const ContourPolygon& polygon = shape.polygons[i];
    ContourOperation operation{std::string(polygon.name)};
    for (int side = 1; side <= 4; ++side) {
      operation.makes.push_back(fmt::format("{}.{}", polygon.name, side));
    }
    operation.moves = around_polygon(polygon, cutter, shape.floor(i + 1) + kAboveLedge);
    operations.push_back(std::move(operation));
  }
  if (piece.bore) {
    operations.push_back(
        {"bore", {"bore"}, inside_bore(shape.bore_radius - cutter, shape.bottom - kBelowBottom)});
  }
  return operations;
}

}  // namespace frustum::programs
