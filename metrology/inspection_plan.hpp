// What to measure on a part and what it must hold: features with their probing, datum system,
// characteristics with tolerances. A TOML file that a metrologist can read and edit.
//
// Units  : mm and rad in these structs; in files mm and degrees unless a text carries its own unit;
//          a tolerance always carries one ("8 um", "600 urad")
// Errors : load_plan and parse_plan report every misspelt or unknown key, missing or unsuitable
//          feature and impossible strategy with file, line and key path
#pragma once

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "metrology/decision_rule.hpp"
#include "metrology/monte_carlo_settings.hpp"

namespace frustum::metrology {

struct ProbeSettings {
  double ball_diameter = 3.0;  // mm
  double clearance = 2.0;      // mm: the approach starts so far off the nominal surface
  double reach = 2.0;          // mm: how far past the nominal surface it searches

  bool operator==(const ProbeSettings&) const = default;
};

enum class FeatureKind { plane, cylinder, cone, circle, line };
enum class Side { outside, inside };  // a boss, probed from without; a hole, probed from within

// Circles around the axis of a cylinder, cone or circle.
struct SectionStrategy {
  std::vector<double> sections{0.0};  // mm along the axis from `point`
  int points_per_section = 36;
  double start_angle = 0.0;  // rad, right-handed about the axis from the zero direction
  double sweep = 2.0 * std::numbers::pi;  // rad; a full turn does not repeat its first point

  bool operator==(const SectionStrategy&) const = default;
};
// Rings around `point` on a plane; a ring is a section.
struct RingStrategy {
  std::vector<double> rings{};  // mm, radii
  int points_per_ring = 12;
  double start_angle = 0.0;               // rad
  double sweep = 2.0 * std::numbers::pi;  // rad

  bool operator==(const RingStrategy&) const = default;
};
// Rows and columns over a parallelogram with sides u and v centred on `point`; a row is a section.
struct GridStrategy {
  Vec3 u = Vec3::UnitX();  // mm, the whole side
  Vec3 v = Vec3::UnitY();
  int columns = 3;  // along u
  int rows = 3;     // along v

  bool operator==(const GridStrategy&) const = default;
};
// Points at equal steps on a line.
struct LineStrategy {
  double from = 0.0;  // mm along the axis from `point`
  double to = 1.0;
  int points = 10;

  bool operator==(const LineStrategy&) const = default;
};
using Strategy = std::variant<SectionStrategy, RingStrategy, GridStrategy, LineStrategy>;

// How far the feature's surface reaches; deviation maps and orientation zones use it.
struct AxialExtent {
  double from = 0.0;  // mm along the axis from `point`
  double to = 0.0;

  bool operator==(const AxialExtent&) const = default;
};
struct RadialExtent {
  double inner = 0.0;  // mm from `point`
  double outer = 0.0;

  bool operator==(const RadialExtent&) const = default;
};
struct RectangleExtent {
  Vec3 u = Vec3::Zero();  // mm, whole sides, perpendicular to each other, centred on `point`
  Vec3 v = Vec3::Zero();

  bool operator==(const RectangleExtent&) const = default;
};
// monostate: not stated; what the strategy covers counts.
using Extent = std::variant<std::monostate, AxialExtent, RadialExtent, RectangleExtent>;

struct PlannedFeature {
  std::string name{};
  FeatureKind kind = FeatureKind::plane;
  // Nominal geometry in the workpiece frame. Directions are kept as written, of any length.
  Vec3 point = Vec3::Zero();    // on the axis, on the plane, centre of the circle
  Vec3 axis = Vec3::UnitZ();    // plane: outward normal; cone: toward growing radius
  double radius = 0.0;          // mm: cylinder, circle; cone: section radius, see below
  double half_angle = 0.0;      // rad: cone
  Side side = Side::outside;    // cylinder, cone, circle
  Vec3 normal = Vec3::UnitX();  // line: outward normal of the surface it lies on
  // Where angles about the axis start; absent: workpiece X, or Y when the axis is within 26 deg of
  // X.
  std::optional<Vec3> zero{};
  Strategy strategy{};
  Extent extent{};

  bool operator==(const PlannedFeature&) const = default;
};
// A cone's `radius` in a plan is what a drawing gives: perpendicular to the axis, in the section
// through `point`. Files call it section_radius. (A fitted Cone holds the orthogonal distance
// instead.)

// Z = outward normal of the primary plane; origin = axis of the secondary pierced with it; Y =
// trace of the tertiary plane (a groove face) in the primary plane. Without a tertiary the plan's
// own clocking stays.
struct DatumSystem {
  std::string primary{};
  std::string secondary{};
  std::string tertiary{};  // may be empty

  bool operator==(const DatumSystem&) const = default;
};
// A workpiece frame of its own for characteristics that name it. Z = outward normal of the
// least-squares plane through all points of `planes`; X = along `line`, laid into that plane; the
// origin keeps the planned height over that plane and the planned distance from the line. Seen from
// the workpiece frame it is the identity for a perfect part, so planned directions hold in it.
struct PlannedFrame {
  std::string name{};
  std::vector<std::string> planes{};  // features of kind plane, one or more
  std::string line{};                 // a feature of kind line

  bool operator==(const PlannedFrame&) const = default;
};
// datum: results are in the datum system (when the plan has one); plan: in the workpiece frame as
// the points come.
enum class Alignment { datum, plan };

enum class CharacteristicKind {
  roundness,             // one section: P-V from the LS circle in its LS plane
  cylindricity,          // P-V from the LS cylinder
  cone_form,             // P-V of normal deviations from the LS cone
  equivalent_cone_form,  // one section, as a roundness tester sees it; half angle of the plan
  flatness,              // P-V from the LS plane
  straightness,          // twice the largest distance from the LS line
  half_angle,            // against the nominal
  concentricity,         // two sections: twice the distance of their centres across the axis: the
                         // planned one in the datum system, else that fitted to the first feature
  perpendicularity,  // features = [toleranced, datum]: zone over the toleranced feature's extent
  radius,            // against the nominal; cone: in the section through the nominal point
  diameter,
  line_distance,  // features = [first, second], lines: distance of their least-squares lines along
  // `direction`, second minus first, minus the planned distance; taken at the planned
  // `point` of the first
  line_angle,  // features = [first, second], lines: angle of the second minus that of the first,
               // right-handed about `direction`, minus the planned one
};

struct PlannedCharacteristic {
  std::string name{};
  CharacteristicKind kind = CharacteristicKind::roundness;
  std::vector<std::string>
      features{};  // one; two for perpendicularity; one or two for concentricity
  std::vector<std::size_t> sections{};  // first = 0; empty: first (and last, for concentricity)
  double tolerance = 0.0;               // mm or rad: limit of the value, or of |value - nominal|
  std::string frame{};                  // line kinds: evaluated in this frame; empty: as all others
  Vec3 direction = Vec3::Zero();        // line kinds: measured along it, or the angle about it

  bool operator==(const PlannedCharacteristic&) const = default;
};

struct InspectionPlan {
  std::string title{};
  ProbeSettings probe{};
  Alignment alignment = Alignment::datum;
  std::optional<DatumSystem> datum{};
  std::optional<MonteCarloSettings> monte_carlo{};  // absent: linear propagation alone
  DecisionRule decision = DecisionRule::simple;
  std::vector<PlannedFrame> frames{};
  std::vector<PlannedFeature> features{};
  std::vector<PlannedCharacteristic> characteristics{};

  bool operator==(const InspectionPlan&) const = default;
};

[[nodiscard]] std::string_view name_of(FeatureKind kind);
[[nodiscard]] std::string_view name_of(CharacteristicKind kind);
// line_distance, line_angle: two lines against each other, along or about a direction.
[[nodiscard]] bool compares_lines(CharacteristicKind kind);
// Its value and its tolerance are angles.
[[nodiscard]] bool is_angle(CharacteristicKind kind);
// Whether a small change of the part changes the value in proportion. Forms and zones are magnitudes: about
// a perfect part every change makes them larger.
[[nodiscard]] bool has_derivative(CharacteristicKind kind);

[[nodiscard]] Result<InspectionPlan> load_plan(const std::filesystem::path& file);
// `file` names the text in diagnostics.
[[nodiscard]] Result<InspectionPlan> parse_plan(std::string_view text,
                                                const std::filesystem::path& file = {});
// Reading it back gives the same plan to the last bit.
[[nodiscard]] std::string to_toml(const InspectionPlan& plan);

// What is impossible in a plan made by a program; empty when it can be measured. Key paths as in a
// file.
[[nodiscard]] Diagnostics check(const InspectionPlan& plan);

[[nodiscard]] const PlannedFeature* find_feature(const InspectionPlan& plan, std::string_view name);
[[nodiscard]] const PlannedFrame* find_frame(const InspectionPlan& plan, std::string_view name);

}  // namespace frustum::metrology
