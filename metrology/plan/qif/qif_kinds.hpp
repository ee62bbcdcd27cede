// The words of QIF for features and characteristics of plans.
//
// A definition, nominal, item or measurement is called by its stem: CylinderFeatureItem,
// FlatnessCharacteristicNominal. Several kinds of plans may share a stem; the first is what a
// document means that says no more.
// Units  : none
// Errors : none
// Source : QIF 3.0 (ISO 23952), Features.xsd and Characteristics.xsd
#pragma once

#include <array>
#include <string_view>

#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// What a definition says besides the tolerance.
enum class QifZone {
  none,         // the tolerance is a width, nothing else
  diameter,     // a cylinder or circle
  orientation,  // a cylinder for an axis, two planes for a plane, with its material condition
  position,     // as the diameter, with its material condition
  limits,       // plus and minus about a nominal
  between       // limits of what is between two features, along or about a direction
};

struct QifKind {
  CharacteristicKind kind;
  std::string_view stem;
  QifZone zone;
};
inline constexpr std::array<QifKind, 25> kQifKinds{{
    {CharacteristicKind::roundness, "Circularity", QifZone::none},
    {CharacteristicKind::cylindricity, "Cylindricity", QifZone::none},
    {CharacteristicKind::cone_form, "Conicity", QifZone::none},
    {CharacteristicKind::flatness, "Flatness", QifZone::none},
    {CharacteristicKind::straightness, "Straightness", QifZone::diameter},
    {CharacteristicKind::axis_straightness, "Straightness", QifZone::diameter},
    {CharacteristicKind::parallelism, "Parallelism", QifZone::orientation},
    {CharacteristicKind::angularity, "Angularity", QifZone::orientation},
    {CharacteristicKind::perpendicularity, "Perpendicularity", QifZone::orientation},
    {CharacteristicKind::position, "Position", QifZone::position},
    {CharacteristicKind::concentricity, "Concentricity", QifZone::diameter},
    {CharacteristicKind::coaxiality, "Coaxiality", QifZone::diameter},
    {CharacteristicKind::symmetry, "Symmetry", QifZone::none},
    {CharacteristicKind::circular_run_out, "CircularRunout", QifZone::none},
    {CharacteristicKind::total_run_out, "TotalRunout", QifZone::none},
    {CharacteristicKind::line_profile, "LineProfile", QifZone::none},
    {CharacteristicKind::surface_profile, "SurfaceProfile", QifZone::none},
    {CharacteristicKind::half_angle, "Angle", QifZone::limits},
    {CharacteristicKind::radius, "Radius", QifZone::limits},
    {CharacteristicKind::diameter, "Diameter", QifZone::limits},
    {CharacteristicKind::line_distance, "DistanceBetween", QifZone::between},
    {CharacteristicKind::line_angle, "AngleBetween", QifZone::between},
    // What no standard knows: a document that says no more means none of them.
    {CharacteristicKind::equivalent_cone_form, "OtherForm", QifZone::none},
    {CharacteristicKind::thickness, "OtherForm", QifZone::none},
    {CharacteristicKind::deviation, "OtherForm", QifZone::none},
}};
inline constexpr std::string_view kQifOtherForm = "OtherForm";

struct QifFeatureKind {
  FeatureKind kind;
  std::string_view stem;
};
inline constexpr std::array<QifFeatureKind, 7> kQifFeatureKinds{{
    {FeatureKind::plane, "Plane"},
    {FeatureKind::cylinder, "Cylinder"},
    {FeatureKind::cone, "Cone"},
    {FeatureKind::circle, "Circle"},
    {FeatureKind::line, "Line"},
    {FeatureKind::sphere, "Sphere"},
    {FeatureKind::point, "Point"},
}};

// SubstituteFeatureAlgorithmEnum, in the order of Criterion.
inline constexpr std::array<std::string_view, 5> kQifCriteria{
    "LEASTSQUARES", "MINMAX", "MAXINSCRIBED", "MINCIRCUMSCRIBED", "ONESIDED"};

}  // namespace frustum::metrology
