// One sound specimen of each cutter type, for laws that hold for all.
// Units: mm, rad. Errors: none.
#pragma once

#include <vector>

#include "cutter/body/cutter_spec.hpp"

namespace frustum::cutter {

inline std::vector<CutterSpec> specimens() {
  const auto base = [](CutterType type, double diameter, double flutes) {
    return CutterSpec{
        .type = type, .diameter = {diameter}, .length = {100.0}, .flute_length = {flutes}};
  };
  std::vector<CutterSpec> all;
  const auto add = [&all](CutterSpec spec) -> CutterSpec& {
    all.push_back(std::move(spec));
    return all.back();
  };
  add(base(CutterType::flat, 12.0, 30.0));
  add(base(CutterType::flat, 20.0, 30.0)).end_angle = Rad{1.7 * kRadPerDeg};
  add(base(CutterType::ball, 10.0, 25.0));
  add(base(CutterType::bull, 16.0, 20.0)).corner_radius = {3.0};
  CutterSpec& hollow_bull = add(base(CutterType::bull, 16.0, 20.0));
  hollow_bull.corner_radius = {2.0};
  hollow_bull.end_angle = 3.0_deg;
  CutterSpec& taper = add(base(CutterType::taper, 6.0, 18.0));
  taper.taper_angle = 5.0_deg;
  taper.corner_radius = {1.0};
  add(base(CutterType::taper_ball, 4.0, 22.0)).taper_angle = 7.0_deg;
  add(base(CutterType::drill, 8.5, 40.0)).tip_angle = 118.0_deg;
  CutterSpec& chamfer = add(base(CutterType::chamfer, 10.0, 8.0));
  chamfer.tip_angle = 90.0_deg;
  chamfer.tip_diameter = {2.0};
  add(base(CutterType::lollipop, 9.0, 0.0)).neck_diameter = {4.0};
  CutterSpec& slot = add(base(CutterType::t_slot, 21.0, 9.0));
  slot.corner_radius = {1.5};
  slot.neck_diameter = {10.0};
  CutterSpec& dovetail = add(base(CutterType::dovetail, 20.0, 8.0));
  dovetail.taper_angle = 30.0_deg;
  dovetail.shank_diameter = {8.0};
  CutterSpec& barrel = add(base(CutterType::barrel, 12.0, 24.0));
  barrel.flank_radius = {85.0};
  barrel.corner_radius = {2.0};
  CutterSpec& lens = add(base(CutterType::lens, 12.0, 10.0));
  lens.end_radius = {20.0};
  lens.corner_radius = {1.5};
  CutterSpec& apt = add(base(CutterType::apt, 14.0, 26.0));
  apt.corner_radius = {3.0};
  apt.arc_offset = {4.3};
  apt.arc_height = {3.2};
  apt.end_slope = 4.0_deg;
  apt.taper_angle = 3.0_deg;
  add(base(CutterType::profile, 0.0, 0.0)).rows = {{0, 1, 0},   {3, 0, 0},  {6, 3, 3},  {6, 8, 0},
                                                   {4, 11, -4}, {4, 15, 0}, {7, 15, 0}, {7, 20, 0}};
  add(base(CutterType::measured, 0.0, 0.0)).rows = {{0, 0, 0},    {0.1, 1, 0},   {0.4, 2, 0},
                                                    {1, 2.98, 0}, {5, 3.002, 0}, {12, 2.997, 0}};
  return all;
}

}  // namespace frustum::cutter
