// Splines of APT CLDATA as NX writes them, as one cubic (Bezier) curve for each part between knots.
//
//   NURBS/                  begins at the place before it, which is the first control point
//   KNOT/u,u,..             the knots after the first ones, up to the end of the curve
//   CNTRL/x,y,z             the control points
//
// Model : a cubic B-spline, clamped at both ends: its first knots, four of 0, and the further three
//         of the last one are not written, so that there are two more points than knots
// Units : those of the file
// Errors: by LineScanner::fail: knots that do not go up, points without or before their knots
// Source: a file of NX: all of its 70 splines have as many points, and as cubics of these knots
//         they have an even speed, many to less than a hundredth
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/pose.hpp"
#include "parser/language/block.hpp"
#include "parser/reading/cldata/cldata_record.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {

// From where the tool is, by two control points.
struct CldataCurve {
  Vec3 first = Vec3::Zero();
  Vec3 second = Vec3::Zero();
  Vec3 end = Vec3::Zero();
};

class CldataNurbs {
 public:
  // Whether the record belongs to a spline that is open; one that does not is a mistake.
  bool goes_on(LineScanner& in, const CldataRecord& record);
  void begin(LineScanner& in, const CldataRecord& record, std::uint32_t line,
             const std::optional<Vec3>& at);
  void add_knots(LineScanner& in, const CldataRecord& record);
  // The part of the curve that this point completes.
  [[nodiscard]] std::optional<CldataCurve> add_point(LineScanner& in, const CldataRecord& record);

 private:
  [[nodiscard]] Vec3 blossom(std::size_t part, double a, double b, double c) const;

  std::uint32_t line_ = 0;       // of a spline that is open
  std::vector<double> knots_{};  // with the four at the start
  std::vector<Vec3> points_{};
};

// The words of the curve beside those of its end.
void add_curve(Block& block, const CldataCurve& curve, std::uint32_t column);

}  // namespace frustum::parser
