// Arcs of APT CLDATA, which are spread over records.
//
//   CIRCLE/x,y,z,i,j,k,r and the GOTO records after it, as long as they go on along the circle.
//                           Without radius (SolidWorks CAM) or with more numbers (tolerances and
//                           the cutter: NX) one GOTO; TIMES,n or PITCH,p: a helix; CLOCKWISE:
//                           against i,j,k
//   MOVARC/x,y,z,i,j,k,r,ANGLE,a    one GOTO, `a` degrees further
//   INDIRV/i,j,k            the direction at the start; INDIRP/x,y,z: towards a point; then
//   TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z) up to where the line or plane meets the
//                           circle; ON,2,INTOF: to the second place; a line from the centre to the
//                           circle: to its end
//
// The tool turns counterclockwise about i,j,k, in the form of NX clockwise.
// Units : those of the file, degrees
// Errors: by LineScanner::fail: numbers that are missing, an axis without length, a circle
//         that does not lead to its GOTO, turns that disagree with the end, no start or direction
// Source: PTC Creo Help, CL Output for Circular Interpolation (right-hand rule). NX: its CL files,
//         where only clockwise arcs go on from the lines before and after them, and the reader of
//         CL files of STEP Tools
#pragma once

#include <cstdint>
#include <optional>

#include "parser/motion.hpp"
#include "parser/reading/cldata/cldata_record.hpp"

namespace frustum::parser {

struct CldataArc {
  Vec3 centre = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();
  int turns = 1;
  bool times_started = false;  // TIMES was taken for the turns that are started
  bool step = false;           // its end is as near ahead of its start as two neighbouring decimals

  // The plane of X, Y and Z that it is in.
  [[nodiscard]] std::optional<Plane> plane() const;
  // The motion's word: "CIRCLE+" in a plane, else "CIRCLE/".
  [[nodiscard]] const char* code() const;
};

class CldataArcs {
 public:
  // CIRCLE, MOVARC.
  void begin(LineScanner& in, const CldataRecord& record, std::uint32_t line);
  // INDIRV, INDIRP.
  void point_along(LineScanner& in, const CldataRecord& record);
  // The line of a circle that waits for its GOTO.
  [[nodiscard]] std::optional<std::uint32_t> waits_since() const;
  // What is no GOTO ends a circle.
  void close() { circle_.reset(); }
  // The arc from `at` to the point that a GOTO at `column` names; none when that move is straight.
  [[nodiscard]] std::optional<CldataArc> to(LineScanner& in, const Vec3& end, std::uint32_t column,
                                            const std::optional<Vec3>& at, bool inches);
  // Behind TLON.
  [[nodiscard]] std::optional<CldataArc> along_line(LineScanner& in, std::uint32_t column,
                                                    const std::optional<Vec3>& at);

 private:
  struct Circle {
    std::uint32_t line = 0;
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;
    Vec3 axis = Vec3::UnitZ();
    bool one_move = false;  // only the next GOTO belongs to it
    bool closes = true;     // a GOTO to its start is a full turn
    const char* word = "";  // TIMES, PITCH or ANGLE, with its number
    double value = 0.0;
    std::uint32_t column = 0;
    double turned = 0.0;  // full turns so far
    bool flat = true;     // up to now
    bool begun = false;   // a GOTO has gone along it

    // From the centre, across the axis.
    [[nodiscard]] Vec3 arm(const Vec3& point) const;
    // Full turns between two points, from -0.5 to 0.5, and above 0 and up to 1.
    [[nodiscard]] double shorter_turn(const Vec3& from, const Vec3& to) const;
    [[nodiscard]] double turn(const Vec3& from, const Vec3& to) const;
  };
  struct Direction {
    Vec3 vector = Vec3::Zero();
    bool is_point = false;
  };
  // Whether the axis of the circle, at `column`, is a unit vector.
  static bool set_axis(LineScanner& in, Circle& circle, const Vec3& axis, std::uint32_t column);
  [[nodiscard]] static std::optional<int> turns_of(LineScanner& in, const Circle& circle,
                                                   std::uint32_t column, double turn,
                                                   double height);
  [[nodiscard]] static std::optional<Circle> read_circle(LineScanner& in);
  [[nodiscard]] static std::optional<Vec3> read_end(LineScanner& in, const Circle& circle,
                                                    const Vec3& at);

  std::optional<Circle> circle_{};
  std::optional<Direction> direction_{};
};

// The arc's own words; the place of its end is the caller's.
void add_arc(Block& block, const CldataArc& arc, std::uint32_t column);

}  // namespace frustum::parser
