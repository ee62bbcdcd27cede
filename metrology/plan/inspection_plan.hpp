// What to measure on a part and what it must hold: features with their probing, datum system,
// characteristics with tolerances. A TOML file that a metrologist can read and edit.
//
// Units  : mm and rad in these structs; in files mm and degrees unless a text carries its own unit;
//          a tolerance always carries one ("8 um", "600 urad")
// Errors : load_plan and parse_plan report every misspelt or unknown key, missing or unsuitable
//          feature and impossible strategy with file, line and key path
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "metrology/decision_rule.hpp"
#include "metrology/fit/association.hpp"
#include "metrology/plan/monte_carlo_settings.hpp"
#include "metrology/plan/report_header.hpp"

namespace frustum {
class SplineSurface;
}  // namespace frustum

namespace frustum::metrology {

// Where a touch is taken to be: from the centre of the ball toward the fitted surface, or against
// the approach, which leaves the cosine error where the surface is turned from its planned normal.
enum class Compensation { fitted, approach };

struct ProbeSettings {
  double ball_diameter = 3.0;  // mm
  double clearance = 2.0;      // mm: the approach starts so far off the nominal surface
  double reach = 2.0;          // mm: how far past the nominal surface it searches
  Compensation compensation = Compensation::fitted;

  bool operator==(const ProbeSettings&) const = default;
};

// A point is one touch on a surface, whose normal is its `axis`; it has no strategy. Of a ruled
// surface nothing is fitted: its points are compared with the planned one.
enum class FeatureKind { plane, cylinder, cone, circle, line, sphere, point, ruled };
enum class Side { outside, inside };  // a boss, probed from without; a hole, probed from within

// Strategies take a number of points or, where `pitch` is greater than 0, a distance between
// points: the number is 0 then, and so many points are taken that they lie no farther apart.
// `scan`: the ball stays in contact from point to point, with a scanning probe's noise.

// Circles around the axis of a cylinder, cone or circle; circles of latitude of a sphere.
struct SectionStrategy {
  std::vector<double> sections{0.0};  // mm along the axis from `point`
  int points_per_section = 36;
  double start_angle = 0.0;  // rad, right-handed about the axis from the zero direction
  double sweep = 2.0 * std::numbers::pi;  // rad; a full turn does not repeat its first point
  double pitch = 0.0;                     // mm along the circle
  bool scan = false;

  bool operator==(const SectionStrategy&) const = default;
};
// Rings around `point` on a plane; a ring is a section.
struct RingStrategy {
  std::vector<double> rings{};  // mm, radii
  int points_per_ring = 12;
  double start_angle = 0.0;               // rad
  double sweep = 2.0 * std::numbers::pi;  // rad
  double pitch = 0.0;                     // mm along the ring
  bool scan = false;

  bool operator==(const RingStrategy&) const = default;
};
// Rows and columns over a parallelogram with sides u and v centred on `point`; a row is a section.
struct GridStrategy {
  Vec3 u = Vec3::UnitX();  // mm, the whole side
  Vec3 v = Vec3::UnitY();
  int columns = 3;     // along u
  int rows = 3;        // along v
  double pitch = 0.0;  // mm along u
  bool scan = false;

  bool operator==(const GridStrategy&) const = default;
};
// Points at equal steps on a line.
struct LineStrategy {
  double from = 0.0;  // mm along the axis from `point`
  double to = 1.0;
  int points = 10;
  double pitch = 0.0;  // mm
  bool scan = false;

  bool operator==(const LineStrategy&) const = default;
};
// Straight lines of a cylinder or cone, at equal angles; a line is a section.
struct GeneratrixStrategy {
  int generatrices = 4;
  double from = 0.0;  // mm along the axis from `point`
  double to = 1.0;
  int points = 10;                        // on each
  double start_angle = 0.0;               // rad
  double sweep = 2.0 * std::numbers::pi;  // rad
  double pitch = 0.0;                     // mm along the axis
  bool scan = false;

  bool operator==(const GeneratrixStrategy&) const = default;
};
// A helix on a cylinder or cone, from one height to the other; one section.
struct SpiralStrategy {
  double from = 0.0;  // mm along the axis from `point`
  double to = 1.0;
  double turns = 3.0;        // negative: left-handed
  int points = 100;          // both ends included
  double start_angle = 0.0;  // rad
  double pitch = 0.0;        // mm along the helix, on its larger end
  bool scan = false;

  bool operator==(const SpiralStrategy&) const = default;
};
// Circles of latitude about the axis of a sphere, at equal steps of the angle from the axis; a
// circle is a section. The default is the pattern of 25 points of ISO 10360-5.
struct SphereStrategy {
  std::vector<int> points{1, 4, 8, 4, 8};  // of each circle
  double polar_from = 0.0;                 // rad from the axis
  double polar_to = 0.5 * std::numbers::pi;
  double start_angle = 0.0;               // rad, of the first circle
  double twist = std::numbers::pi / 8.0;  // rad: each circle is turned by it against the one before

  bool operator==(const SphereStrategy&) const = default;
};
// Lines along a ruled or freeform surface, at shares of its height (v), with points at equal steps
// of u; a line is a section.
struct SurfaceLineStrategy {
  std::vector<double> heights{0.2, 0.5, 0.8};
  double from = 0.02;  // of u
  double to = 0.98;
  int points = 49;
  bool scan = false;
  // mm, in the order of the points: what is left of the material where the machine makes no error,
  // because the cutter cannot do better. Reports give it a column of its own. Empty: nothing known.
  std::vector<double> geometric{};

  bool operator==(const SurfaceLineStrategy&) const = default;
};
using Strategy =
    std::variant<SectionStrategy, RingStrategy, GridStrategy, LineStrategy, GeneratrixStrategy,
                 SpiralStrategy, SphereStrategy, SurfaceLineStrategy>;

// The planned surface of a ruled feature: a net of points (spline_surface.hpp).
struct NominalNet {
  std::shared_ptr<const SplineSurface> surface{};

  bool operator==(const NominalNet& other) const;
};

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
  Vec3 axis = Vec3::UnitZ();    // plane, point: outward normal; cone: toward growing radius;
                                // sphere: toward the pole
  double radius = 0.0;          // mm: cylinder, circle, sphere; cone: section radius, see below
  double half_angle = 0.0;      // rad: cone
  Side side = Side::outside;    // cylinder, cone, circle, sphere
  Vec3 normal = Vec3::UnitX();  // line: outward normal of the surface it is on
  // Where angles about the axis start; absent: workpiece X, or Y when the axis is within 26 deg of
  // X.
  std::optional<Vec3> zero{};
  NominalNet net{};  // ruled; `point` and `axis` do not count
  Strategy strategy{};
  Extent extent{};

  bool operator==(const PlannedFeature&) const = default;
};
// A cone's `radius` in a plan is what a drawing gives: perpendicular to the axis, in the section
// through `point`. Files call it section_radius. (A fitted Cone holds the orthogonal distance
// instead.)

// By order of precedence: each datum takes the degrees of freedom that those before it left
// (datum_system.hpp). Or, when best_fit names features, all of them at once: the planned geometry
// laid into their points by least squares.
struct DatumSystem {
  std::string primary{};
  std::string secondary{};  // may be empty, as may
  std::string tertiary{};
  // How a plane represents its points: least_squares, or outside_material as it would touch a
  // table.
  Criterion criterion = Criterion::least_squares;
  std::vector<std::string> best_fit{};
  // Degrees that a best fit leaves as planned: of kDegreeNames.
  std::vector<std::string> locked{};
  // criterion = "base": each datum is the element that its own points gave, without regard to those
  // before it.
  bool base = false;

  bool operator==(const DatumSystem&) const = default;
};
// Shift along and rotation about the axes of the workpiece frame.
inline constexpr std::array<std::string_view, 6> kDegreeNames{"TX", "TY", "TZ", "RX", "RY", "RZ"};

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
  concentricity,     // features = [toleranced, datum]: twice the largest distance of the centres
                     // of the sections from the datum's axis. One feature: twice the distance of
                     // the centres of two sections across the axis: the planned one in the datum
                     // system, else the fitted one
  perpendicularity,  // features = [toleranced, datum]: zone over the toleranced feature's extent
  radius,            // against the nominal; cone: in the section through the nominal point
  diameter,
  line_distance,  // features = [first, second], lines: distance of their least-squares lines along
  // `direction`, second minus first, minus the planned distance; taken at the planned
  // `point` of the first
  line_angle,  // features = [first, second], lines: angle of the second minus that of the first,
               // right-handed about `direction`, minus the planned one
  // Zones of ISO 1101, defined in docs/characteristics.md. Where one feature is named instead of
  // two or more, the datum is the plan's datum system.
  axis_straightness,  // of the centres of the sections
  parallelism,        // features = [toleranced, datum]
  angularity,         // features = [toleranced, datum]
  position,           // against its true position in the datum system or frame
  coaxiality,         // features = [toleranced, datum, ...]: several datums make one common axis
  symmetry,           // features = [toleranced, datum], either of them also a pair of faces
  circular_run_out,   // features = [toleranced, datum, ...]: each section for itself
  total_run_out,      // features = [toleranced, datum, ...]: the whole surface
  line_profile,       // each section against the planned surface
  surface_profile,    // all points of one feature or several against the planned surfaces
  thickness,  // features = [one side, the other]: mean deviation of both, each out of the material,
              // of one section or of all
  deviation,  // of one point of a ruled feature, out of the material
};

// Of a form: peak to valley, highest peak, deepest valley, root mean square (RONt, RONp, RONv,
// RONq).
enum class FormParameter { t, p, v, q };

// The undulations that count: cut-offs of Gaussian filters (gaussian_filter.hpp). 0: none there.
struct ProfileFilter {
  double upr = 0.0;          // closed profiles: more undulations per revolution are taken away
  double upr_from = 0.0;     // and so are fewer than these
  double cutoff = 0.0;       // mm, open profiles: shorter waves are taken away
  double cutoff_long = 0.0;  // mm: and so are longer ones

  bool operator==(const ProfileFilter&) const = default;
};

// Where a contour begins and ends on a round feature: angles about its axis, from its zero
// direction. The mark that the tool leaves there is apart from the form of the rest.
struct Seam {
  double at = 0.0;      // rad
  double within = 0.0;  // rad to either side

  bool operator==(const Seam&) const = default;
};

struct PlannedCharacteristic {
  std::string name{};
  CharacteristicKind kind = CharacteristicKind::roundness;
  std::vector<std::string>
      features{};  // one; two for perpendicularity; one or two for concentricity
  // Of the first feature, first = 0. Empty: all, of which the worst counts; of a concentricity
  // within one feature first and last.
  std::vector<std::size_t> sections{};
  double tolerance = 0.0;         // mm or rad: limit of the value, or of |value - nominal|
  std::string frame{};            // evaluated in this frame; empty: as all others
  Vec3 direction = Vec3::Zero();  // line kinds: measured along it, or the angle about it
  // How the toleranced element represents its points: mz for the zone itself, mi and mc for fits.
  Criterion criterion = Criterion::least_squares;
  // Datums of orientation, coaxiality, symmetry and run-out: least_squares or outside_material.
  Criterion datum_criterion = Criterion::least_squares;
  std::optional<FormParameter> parameter{};  // of forms; absent: peak to valley
  std::optional<ProfileFilter> filter{};     // roundness, straightness, circular run-out
  int harmonics = 0;       // highest that is reported of a roundness or circular run-out
  bool floating = false;   // profiles: the planned geometry is laid into the points first
  bool deviation = false;  // sizes: the value is the deviation from the nominal one
  // Roundness, equivalent_cone_form: the value without this sector is reported beside the whole.
  std::optional<Seam> seam{};
  std::optional<std::size_t> point{};  // deviation: which point of its feature, the first is 0

  bool operator==(const PlannedCharacteristic&) const = default;
};

struct InspectionPlan {
  std::string title{};
  ReportHeader header{};
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
// Cylinder, cone, circle, sphere: what has a radius, and material within or around.
[[nodiscard]] bool is_round(FeatureKind kind);
// What a point of a plan is probed by: the one touch at its place.
[[nodiscard]] Strategy single_touch();
[[nodiscard]] std::string_view name_of(CharacteristicKind kind);
// line_distance, line_angle: two lines against each other, along or about a direction.
[[nodiscard]] bool compares_lines(CharacteristicKind kind);
// Its value and its tolerance are angles.
[[nodiscard]] bool is_angle(CharacteristicKind kind);
// Whether a small change of the part changes the value in proportion. Forms and zones cannot be
// negative: about a perfect part every change makes them larger.
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
