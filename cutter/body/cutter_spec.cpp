#include "cutter/body/cutter_spec.hpp"

#include <fmt/format.h>

#include "cutter/body/standard_generatrix.hpp"

namespace frustum::cutter {
namespace {

constexpr auto kDiameter = &CutterSpec::diameter;
constexpr auto kFlutes = &CutterSpec::flute_length;

std::vector<CutterTypeRow> rows_of_types() {
  using S = CutterSpec;
  const CutterKey diameter{"diameter", kDiameter, true};
  const CutterKey flutes{"flute_length", kFlutes};
  const CutterKey these_flutes{"flute_length", kFlutes, true};
  const CutterKey corner{"corner_radius", &S::corner_radius, false, Bound::non_negative};
  const CutterKey concave_end{"end_angle", &S::end_angle, false, Bound::non_negative};
  const CutterKey taper{"taper_angle", &S::taper_angle, true, Bound::any};
  const CutterKey point{"tip_angle", &S::tip_angle, true};
  return {
      {CutterType::flat,
       "flat",
       "flat end mill",
       {diameter, flutes, concave_end},
       end_mill_generatrix},
      {CutterType::ball, "ball", "ball end mill", {diameter, flutes}, ball_generatrix},
      {CutterType::bull,
       "bull",
       "bull nose end mill",
       {diameter, {"corner_radius", &S::corner_radius, true}, flutes, concave_end},
       end_mill_generatrix},
      {CutterType::taper,
       "taper",
       "taper end mill",
       {diameter, taper, corner, flutes},
       end_mill_generatrix},
      {CutterType::taper_ball,
       "taper_ball",
       "taper ball end mill",
       {diameter, taper, flutes},
       taper_ball_generatrix},
      {CutterType::drill, "drill", "drill", {diameter, point, flutes}, pointed_generatrix},
      {CutterType::chamfer,
       "chamfer",
       "chamfer mill",
       {diameter, point, {"tip_diameter", &S::tip_diameter, false, Bound::non_negative}, flutes},
       pointed_generatrix},
      {CutterType::lollipop,
       "lollipop",
       "lollipop cutter",
       {diameter, {"neck_diameter", &S::neck_diameter, true}},
       lollipop_generatrix},
      {CutterType::t_slot,
       "t_slot",
       "T-slot cutter",
       {diameter, these_flutes, corner},
       t_slot_generatrix},
      {CutterType::dovetail,
       "dovetail",
       "dovetail cutter",
       {diameter, {"taper_angle", &S::taper_angle, true}, these_flutes},
       dovetail_generatrix},
      {CutterType::barrel,
       "barrel",
       "barrel cutter",
       {diameter,
        {"flank_radius", &S::flank_radius, true},
        these_flutes,
        corner,
        {"belly_height", &S::belly_height}},
       barrel_generatrix},
      {CutterType::lens,
       "lens",
       "lens end mill",
       {diameter, {"end_radius", &S::end_radius, true}, corner, flutes},
       lens_generatrix},
      {CutterType::apt,
       "apt",
       "seven-parameter end mill",
       {{"D", kDiameter, true},
        {"R", &S::corner_radius, false, Bound::non_negative},
        {"E", &S::arc_offset, false, Bound::any},
        {"F", &S::arc_height, false, Bound::any},
        {"alpha", &S::end_slope, false, Bound::any},
        {"beta", &S::taper_angle, false, Bound::any},
        {"H", kFlutes, true}},
       apt_generatrix},
      {CutterType::profile,
       "profile",
       "profile cutter",
       {{"outline", &S::rows, true}},
       profile_generatrix},
      {CutterType::measured,
       "measured",
       "measured cutter",
       {{"points", &S::rows, true}},
       measured_generatrix},
  };
}

}  // namespace

std::span<const CutterTypeRow> cutter_types() {
  static const std::vector<CutterTypeRow> rows = rows_of_types();
  return rows;
}

std::span<const CutterKey> common_keys() {
  using S = CutterSpec;
  static const std::vector<CutterKey> keys{
      {"length", &S::length, true},
      {"radius_error", &S::radius_error, false, Bound::any},
      {"length_error", &S::length_error, false, Bound::any},
      {"run_out", &S::run_out, false, Bound::non_negative},
      {"run_out_tilt", &S::run_out_tilt, false, Bound::any},
      {"neck_diameter", &S::neck_diameter},
      {"neck_length", &S::neck_length},
      {"neck_angle", &S::neck_angle, false, Bound::non_negative},
      {"shank_diameter", &S::shank_diameter},
      {"holder", &S::holder}};
  return keys;
}

const CutterTypeRow& type_row(CutterType type) {
  return cutter_types()[static_cast<std::size_t>(type)];
}

std::string description(const CutterSpec& spec) {
  std::string text{type_row(spec.type).title};
  if (spec.diameter.value != 0.0) text += fmt::format(", diameter {:g} mm", spec.diameter.value);
  text += fmt::format(", length {:g} mm", spec.length.value);
  const auto add_error = [&text](std::string_view name, double value, std::string_view unit) {
    if (value != 0.0) text += fmt::format(", {} {:g} {}", name, value, unit);
  };
  add_error("radius error", spec.radius_error.value * kUmPerMm, "um");
  add_error("length error", spec.length_error.value * kUmPerMm, "um");
  add_error("run-out", spec.run_out.value * kUmPerMm, "um");
  add_error("run-out tilt", spec.run_out_tilt.value * kUradPerRad, "urad");
  return text;
}

std::string to_string(CutterType type) { return std::string(type_row(type).name); }

}  // namespace frustum::cutter
