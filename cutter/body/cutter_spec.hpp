// A tool: its type, the dimensions that the type has, its errors, its holder. The one value that
// goes from a job or a tool library to the report; what else is known of a tool is computed from
// it.
//
// Model    : one row a type in cutter_types() tells its name, the keys it takes and the generatrix
//            they make
// Units    : mm, rad; heights from the tip
// Errors   : generatrix functions say which dimension does not fit the others
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.hpp"
#include "core/toml_document.hpp"
#include "core/units.hpp"
#include "cutter/body/generatrix.hpp"

namespace frustum::cutter {

enum class CutterType : std::uint8_t {
  flat,
  ball,
  bull,
  taper,
  taper_ball,
  drill,
  chamfer,
  lollipop,
  t_slot,
  dovetail,
  barrel,
  lens,
  apt,
  profile,
  measured,
};

using CutterRow = std::array<double, 3>;

// Right-hand tools cut while the spindle turns clockwise (M3), left-hand ones by M4.
enum class CutterHand : std::uint8_t { right, left };

struct CutterSpec {
  CutterType type = CutterType::flat;
  std::string name{};  // that programs call it by; empty: by its number alone
  CutterHand hand = CutterHand::right;
  Mm diameter{};
  Mm length{};
  Mm flute_length{};  // 0: the whole length
  Mm radius_error{};
  Mm length_error{};

  Mm corner_radius{};
  Rad end_angle{};    // minor cutting edge angle of a hollow-cut end face
  Rad taper_angle{};  // flank against axis; positive: wider towards the spindle
  Rad tip_angle{};    // included
  Mm tip_diameter{};
  Mm end_radius{};
  Mm flank_radius{};
  Mm belly_height{};              // of a barrel's largest diameter; 0: half of the flutes
  Mm arc_offset{};                // E of the seven parameters
  Mm arc_height{};                // F
  Rad end_slope{};                // alpha
  std::vector<CutterRow> rows{};  // profile: r, z, arc radius; measured: z, r, 0

  // Offset of the tool's axis from the spindle's at the gauge point and the angle between them.
  Mm run_out{};
  Rad run_out_tilt{};

  Mm neck_diameter{};
  Mm neck_length{};
  Rad neck_angle{};  // of the cone from neck to shank, against the axis; 0: a step
  Mm shank_diameter{};
  std::vector<CutterRow>
      holder{};  // height, lower diameter, upper diameter; the last ends at the gauge

  bool operator==(const CutterSpec&) const = default;
};

using ToolList = std::map<int, CutterSpec>;  // by tool number

// Height of the cutting part above the tip.
[[nodiscard]] inline Mm flute_height(const CutterSpec& spec) {
  return spec.flute_length.value > 0.0 ? spec.flute_length : spec.length;
}
// As reports print it: "flat end mill, diameter 12 mm, length 150 mm".
[[nodiscard]] std::string description(const CutterSpec& spec);

struct CutterKey {
  std::string_view name;
  std::variant<Mm CutterSpec::*, Rad CutterSpec::*, std::vector<CutterRow> CutterSpec::*> value;
  bool required = false;
  Bound bound = Bound::positive;  // of a value that is given
};

struct CutterTypeRow {
  CutterType type;
  std::string_view name;   // in files
  std::string_view title;  // in reports
  std::vector<CutterKey> keys;
  // The nominal generatrix; the spec's diameter already holds the radius error.
  Result<std::vector<GeneratrixSegment>> (*generatrix)(const CutterSpec&);
};
[[nodiscard]] std::span<const CutterTypeRow> cutter_types();
[[nodiscard]] const CutterTypeRow& type_row(CutterType type);
[[nodiscard]] std::string to_string(CutterType type);

// Keys that every type takes.
[[nodiscard]] std::span<const CutterKey> common_keys();

}  // namespace frustum::cutter
