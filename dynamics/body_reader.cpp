#include "dynamics/body_reader.hpp"

#include <fmt/format.h>

#include <cmath>

namespace frustum::dynamics {
namespace {

// Beyond these a number is in another unit: no part of a machine tool is so heavy or so wide.
constexpr double kHeaviest = 1e7;  // kg
constexpr double kLightest = 1e-3;
constexpr double kFarthest = 1e6;  // mm: a kilometre
constexpr double kWidest = 100.0;  // m, radius of gyration
constexpr double kNarrowest = 1e-4;
constexpr double kDensest = 25000.0;  // kg/m^3, of osmium 22590

bool all_positive(const Vec3& v) { return (v.array() > 0.0).all(); }

SolidShape read_shape(const TomlTable& table) {
  const auto length = [&](const char* key) {
    const double value = table.number(key, Bound::positive);
    if (value > kFarthest) {
      table.fail(key, "out-of-range"_id, "the solid is longer than a kilometre", "in mm");
      return 1.0;
    }
    return value * kMetresPerMm;
  };
  switch (table.choice("shape", {"box", "cylinder", "prism"})) {
    case 0: {
      const Vec3 size = table.vector("size");
      if (table.is_array("size") && !all_positive(size)) {
        table.fail("size", "empty-body"_id, "the solid is empty: every size must be above 0",
                   "size = [x, y, z] in mm");
        return SolidBox{};
      }
      if (size.cwiseAbs().maxCoeff() > kFarthest) {
        table.fail("size", "out-of-range"_id, "the solid is longer than a kilometre",
                   "size = [x, y, z] in mm");
        return SolidBox{};
      }
      return SolidBox{size * kMetresPerMm};
    }
    case 1:
      return SolidCylinder{length("diameter"), length("length")};
    default:
      break;
  }
  SolidPrism prism{{}, length("length")};
  for (const auto& corner : table.rows("outline", 2)) {
    const Eigen::Vector2d at(corner[0], corner[1]);
    if (at.cwiseAbs().maxCoeff() > kFarthest) {
      table.fail("outline", "out-of-range"_id, "a corner is more than a kilometre away", "in mm");
      return prism;
    }
    prism.outline.emplace_back(at * kMetresPerMm);
  }
  if (crosses_itself(prism)) {
    table.fail("outline", "empty-body"_id, "the outline crosses itself",
               "its corners one after the other, either way round");
  } else if (table.is_array("outline") && !(volume_of(prism) > 0.0)) {
    table.fail("outline", "empty-body"_id, "the solid is empty: its outline encloses no area",
               "three corners or more, [x, y] each, in mm");
  }
  return prism;
}

Solid read_solid(const TomlTable& table) {
  Solid solid{.shape = read_shape(table)};
  if (table.has("at")) solid.at = point_of(table, "at");
  const Vec3 turn = table.vector_or("rotation", Vec3::Zero()) * kRadPerDeg;
  solid.rotation = rotation_z(turn.z()) * rotation_y(turn.y()) * rotation_x(turn.x());
  if (table.has("mass") == table.has("density")) {
    table.fail(table.has("mass") ? "density" : "mass", "conflicting-keys"_id,
               "a solid has either a mass or a density",
               "mass in kg, or density in kg/m^3: steel 7850, cast iron 7200");
    return solid;
  }
  if (table.has("mass")) {
    solid.mass = table.number("mass", Bound::positive);
    return solid;
  }
  const double density = table.number("density", Bound::positive);
  if (density > kDensest) {
    table.fail("density", "out-of-range"_id,
               fmt::format("nothing is as dense as {:g} kg/m^3", density),
               "in kg/m^3: steel 7850, cast iron 7200, mineral casting 2400");
  }
  solid.mass = density * volume_of(solid.shape);
  return solid;
}

// Beyond these limits a number is in another unit.
void check_size(const TomlTable& table, const char* mass_key, const char* size_key,
                const RigidBody& body, const char* hint) {
  if (!table.is_sound()) return;
  if (!(body.mass >= kLightest && body.mass <= kHeaviest)) {
    table.fail(mass_key, "out-of-range"_id,
               fmt::format("no part of a machine weighs {:g} kg", body.mass), hint);
    return;
  }
  const double gyration = std::sqrt(body.inertia.trace() / body.mass);
  if (!(gyration > kNarrowest && gyration < kWidest)) {
    table.fail(size_key, "out-of-range"_id,
               fmt::format("a body of {:g} kg with this tensor would be about {:.3g} m wide",
                           body.mass, gyration),
               hint);
  }
}

RigidBody read_solids(const TomlTable& table) {
  std::vector<Solid> solids;
  for (const TomlTable& entry : table.tables("element")) solids.push_back(read_solid(entry));
  for (const char* key : {"mass", "com", "inertia"}) {
    if (!table.has(key)) continue;
    table.fail(key, "conflicting-keys"_id, "the body is given by its elements",
               "take this key away, or the elements");
  }
  if (solids.empty() || !table.is_sound()) return RigidBody{};
  const RigidBody body = body_of(solids);
  check_size(table, "element", "element", body, "sizes in mm, mass in kg, density in kg/m^3");
  return body;
}

}  // namespace

Vec3 point_of(const TomlTable& table, std::string_view key) {
  const Vec3 point = table.vector(key);
  if (point.cwiseAbs().maxCoeff() > kFarthest) {
    table.fail(key, "out-of-range"_id, "the point is more than a kilometre away",
               "[x, y, z] in mm");
    return Vec3::Zero();
  }
  return point * kMetresPerMm;
}

RigidBody read_body(const TomlTable& table) {
  if (table.has("element")) return read_solids(table);
  RigidBody body;
  body.mass = table.number("mass", Bound::positive);
  body.centre = point_of(table, "com");
  const bool was_sound = table.is_sound();
  const std::vector<double> entries = table.numbers("inertia");
  if (entries.size() != 6) {
    // What has an entry that is no number has been reported.
    if (!was_sound || table.is_sound()) {
      table.fail("inertia", "wrong-type"_id,
                 fmt::format("expected six numbers, found {}", entries.size()),
                 "[xx, yy, zz, xy, xz, yz] in kg m^2 about the centre of mass, xy = -sum m x y");
    }
    return body;
  }
  body.inertia << entries[0], entries[3], entries[4],  //
      entries[3], entries[1], entries[5],              //
      entries[4], entries[5], entries[2];
  if (!body.inertia.allFinite()) return body;
  if (const auto why = impossible_inertia(body.inertia)) {
    table.fail("inertia", "impossible-inertia"_id, "no body has this tensor: " + *why,
               "[xx, yy, zz, xy, xz, yz] in kg m^2 about the centre of mass, xy = -sum m x y");
    return RigidBody{body.mass, body.centre, Mat3::Identity()};
  }
  check_size(table, "mass", "inertia", body, "in kg and kg m^2, which is 1e6 kg mm^2");
  return body;
}

}  // namespace frustum::dynamics
