#include "tests/cutter/cutter_kinds.hpp"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <utility>

namespace frustum::proof {
namespace {

using cutter::Cutter;
using cutter::CutterSpec;
using cutter::CutterType;

Kind kind(const std::string& name, const CutterSpec& spec, Meridian meridian,
          bool is_convex = true) {
  auto made = Cutter::make(spec);
  if (!made) {
    std::cerr << name << ": " << to_string(made.error().front()) << '\n';
    std::abort();
  }
  return {name, *std::move(made), std::move(meridian), is_convex};
}

constexpr Real kDegree = 0.0174532925199432957692L;

Real tangent(double degrees) { return std::tan(static_cast<Real>(degrees) * kDegree); }
Real sine(double degrees) { return std::sin(static_cast<Real>(degrees) * kDegree); }
Real cosine(double degrees) { return std::cos(static_cast<Real>(degrees) * kDegree); }
Rad rad(double degrees) { return {degrees * kRadPerDeg}; }

Kind flat() {
  return kind(
      "flat",
      {.type = CutterType::flat, .diameter = {12.0}, .length = {80.0}, .flute_length = {30.0}},
      Meridian().line_to(6, 0).line_to(6, 30));
}

Kind ball() {
  return kind(
      "ball",
      {.type = CutterType::ball, .diameter = {10.0}, .length = {80.0}, .flute_length = {25.0}},
      Meridian().arc_to(5, 5, 0, 5).line_to(5, 25));
}

Kind bull() {
  return kind("bull",
              {.type = CutterType::bull,
               .diameter = {12.0},
               .length = {80.0},
               .flute_length = {25.0},
               .corner_radius = {2.0}},
              Meridian().line_to(4, 0).arc_to(6, 2, 4, 2).line_to(6, 25));
}

// The corner touches the end at the distance of c tan(45 - taper / 2) from where end and flank
// would meet.
Kind taper() {
  const Real centre = 4 - tangent((90.0 - 10.0) / 2.0);
  const Real r = centre + cosine(10), z = 1 - sine(10);
  return kind("taper",
              {.type = CutterType::taper,
               .diameter = {8.0},
               .length = {80.0},
               .flute_length = {20.0},
               .corner_radius = {1.0},
               .taper_angle = rad(10.0)},
              Meridian()
                  .line_to(centre, 0)
                  .arc_to(r, z, centre, 1)
                  .line_to(r + (20 - z) * tangent(10), 20));
}

Kind taper_ball() {
  const Real r = 3 * cosine(7), z = 3 - 3 * sine(7);
  return kind("taper_ball",
              {.type = CutterType::taper_ball,
               .diameter = {6.0},
               .length = {80.0},
               .flute_length = {22.0},
               .taper_angle = rad(7.0)},
              Meridian().arc_to(r, z, 0, 3).line_to(r + (22 - z) * tangent(7), 22));
}

Kind drill() {
  return kind("drill",
              {.type = CutterType::drill,
               .diameter = {9.0},
               .length = {80.0},
               .flute_length = {28.0},
               .tip_angle = rad(118.0)},
              Meridian().line_to(4.5L, 4.5L / tangent(59)).line_to(4.5L, 28));
}

Kind chamfer() {
  return kind("chamfer",
              {.type = CutterType::chamfer,
               .diameter = {10.0},
               .length = {60.0},
               .flute_length = {8.0},
               .tip_angle = rad(90.0),
               .tip_diameter = {1.0}},
              Meridian().line_to(0.5L, 0).line_to(5, 4.5L).line_to(5, 8));
}

Kind lollipop() {
  const Real top = 4 + std::sqrt(Real{4 * 4 - 2 * 2});
  return kind(
      "lollipop",
      {.type = CutterType::lollipop, .diameter = {8.0}, .length = {60.0}, .neck_diameter = {4.0}},
      Meridian().arc_to(4, 4, 0, 4).arc_to(2, top, 0, 4));
}

Kind t_slot() {
  return kind("t_slot",
              {.type = CutterType::t_slot,
               .diameter = {16.0},
               .length = {60.0},
               .flute_length = {5.0},
               .corner_radius = {0.5}},
              Meridian()
                  .line_to(7.5L, 0)
                  .arc_to(8, 0.5L, 7.5L, 0.5L)
                  .line_to(8, 4.5L)
                  .arc_to(7.5L, 5, 7.5L, 4.5L));
}

Kind dovetail() {
  return kind("dovetail",
              {.type = CutterType::dovetail,
               .diameter = {14.0},
               .length = {60.0},
               .flute_length = {6.0},
               .taper_angle = rad(30.0)},
              Meridian().line_to(7, 0).line_to(7 - 6 * tangent(30), 6));
}

// The corner's circle is inside the flank's and touches it: centres are apart by the difference of
// radii.
Kind barrel() {
  const Real big_r = 5 - 60, big_z = 10;
  const Real centre = big_r + std::sqrt(Real{59 * 59 - 9 * 9});
  const Real r = big_r + (centre - big_r) * 60 / 59, z = big_z + (1 - big_z) * 60 / 59;
  return kind("barrel",
              {.type = CutterType::barrel,
               .diameter = {10.0},
               .length = {80.0},
               .flute_length = {20.0},
               .corner_radius = {1.0},
               .flank_radius = {60.0}},
              Meridian()
                  .line_to(centre, 0)
                  .arc_to(r, z, centre, 1)
                  .arc_to(big_r + std::sqrt(Real{60 * 60 - 10 * 10}), 20, big_r, big_z));
}

Kind lens() {
  const Real centre_z = 20 - std::sqrt(Real{19 * 19 - 5 * 5});
  const Real r = Real{5} * 20 / 19, z = 20 + (centre_z - 20) * 20 / 19;
  return kind("lens",
              {.type = CutterType::lens,
               .diameter = {12.0},
               .length = {80.0},
               .flute_length = {15.0},
               .corner_radius = {1.0},
               .end_radius = {20.0}},
              Meridian().arc_to(r, z, 0, 20).arc_to(6, centre_z, 5, centre_z).line_to(6, 15));
}

// The end face rises towards the axis by two degrees; the corner touches it.
Kind hollow() {
  const Real centre = 6 - 0.8L;
  const Real r = centre - 0.8L * sine(2), z = 0.8L - 0.8L * cosine(2);
  return kind("hollow",
              {.type = CutterType::bull,
               .diameter = {12.0},
               .length = {80.0},
               .flute_length = {30.0},
               .corner_radius = {0.8},
               .end_angle = rad(2.0)},
              Meridian(z + r * tangent(2))
                  .line_to(r, z)
                  .arc_to(centre, 0, centre, 0.8L)
                  .arc_to(6, 0.8L, centre, 0.8L)
                  .line_to(6, 30),
              false);
}

// A head, a concave neck and a wider collar.
Kind waisted() {
  return kind("waisted",
              {.type = CutterType::profile,
               .length = {60.0},
               .rows = {{0, 0, 0},
                        {4, 0, 0},
                        {5, 1, 0},
                        {5, 4, 0},
                        {3, 6, -2},
                        {3, 10, 0},
                        {6, 13, 0},
                        {6, 18, 0}}},
              Meridian()
                  .line_to(4, 0)
                  .line_to(5, 1)
                  .line_to(5, 4)
                  .arc_to(3, 6, 5, 6)
                  .line_to(3, 10)
                  .line_to(6, 13)
                  .line_to(6, 18),
              false);
}

Kind measured() {
  return kind(
      "measured",
      {.type = CutterType::measured,
       .length = {60.0},
       .rows = {{0, 0, 0}, {0.3, 2, 0}, {1.1, 3.5, 0}, {2.5, 4.2, 0}, {6, 4.0, 0}, {12, 4.6, 0}}},
      Meridian().line_to(2, 0.3).line_to(3.5, 1.1).line_to(4.2, 2.5).line_to(4.0, 6).line_to(4.6,
                                                                                             12),
      false);
}

std::vector<Kind> make_all() {
  return {flat(),   ball(),     bull(),   taper(), taper_ball(), drill(),   chamfer(), lollipop(),
          t_slot(), dovetail(), barrel(), lens(),  hollow(),     waisted(), measured()};
}

}  // namespace

const std::vector<Kind>& cutter_kinds() {
  static const std::vector<Kind> all = make_all();
  return all;
}

const Kind& kind_named(const std::string& name) {
  for (const Kind& each : cutter_kinds()) {
    if (each.name == name) return each;
  }
  std::abort();
}

}  // namespace frustum::proof
