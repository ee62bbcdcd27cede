#include "parser/reading/cldata/cldata_nurbs.hpp"

#include <fmt/format.h>

#include <array>

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kDegree = 3;

}  // namespace

bool CldataNurbs::goes_on(LineScanner& in, const CldataRecord& record) {
  const bool part = record.word == "KNOT" || record.word == "CNTRL";
  if (part == (line_ != 0)) return true;
  if (part) {
    in.fail("spline-not-begun"_id, record.column, record.word + " without NURBS",
            "begin the spline with NURBS/ and its knots");
  } else {
    in.fail("spline-open"_id, record.column,
            fmt::format("the NURBS on line {} has {} knots and {} control points", line_,
                        knots_.size() - kDegree - 1, points_.size() - 1),
            "give two control points more than knots");
    line_ = 0;
  }
  return false;
}

void CldataNurbs::begin(LineScanner& in, const CldataRecord& record, std::uint32_t line,
                        const std::optional<Vec3>& at) {
  if (!record.arguments.empty()) {
    return in.fail("argument-count"_id, record.arguments.front().column, "NURBS takes no arguments",
                   "give its knots by KNOT/");
  }
  if (!at) {
    return in.fail("position-unknown"_id, record.column, "the start of the spline is not known",
                   "write a GOTO before it");
  }
  line_ = line;
  knots_.assign(kDegree + 1, 0.0);
  points_.assign(1, *at);
}

void CldataNurbs::add_knots(LineScanner& in, const CldataRecord& record) {
  if (record.arguments.empty() || points_.size() > 1) {
    return in.fail("spline-knots"_id, record.column, "a KNOT without knots or behind a CNTRL",
                   "give all knots before the control points");
  }
  for (const CldataArgument& argument : record.arguments) {
    if (!argument.is_number() || !(argument.number > knots_.back())) {
      return in.fail("spline-knots"_id, argument.column, "a knot that does not go up",
                     "give each knot once, above the one before it");
    }
    knots_.push_back(argument.number);
  }
}

std::optional<CldataCurve> CldataNurbs::add_point(LineScanner& in, const CldataRecord& record) {
  if (!are_cldata_numbers(in, record, {3}, "give x,y,z")) return std::nullopt;
  const std::size_t knots = knots_.size() - kDegree - 1;
  if (knots == 0) {
    in.fail("spline-knots"_id, record.column, "CNTRL before the knots", "give them by KNOT/");
    return std::nullopt;
  }
  if (points_.size() == 1) knots_.insert(knots_.end(), kDegree, knots_.back());
  points_.push_back(record.point());
  if (points_.size() <= kDegree) return std::nullopt;
  const std::size_t part = points_.size() - kDegree - 1;
  const double from = knots_[part + kDegree];
  const double to = knots_[part + kDegree + 1];
  if (part + 2 * (kDegree + 1) == knots_.size()) line_ = 0;
  return CldataCurve{blossom(part, from, from, to), blossom(part, from, to, to),
                     blossom(part, to, to, to)};
}

// De Boor's scheme, with a parameter of its own at each level.
Vec3 CldataNurbs::blossom(std::size_t part, double a, double b, double c) const {
  const std::array parameters{a, b, c};
  std::array<Vec3, kDegree + 1> row{};
  for (std::size_t i = 0; i <= kDegree; ++i) row.at(i) = points_[part + i];
  for (std::size_t level = 1; level <= kDegree; ++level) {
    for (std::size_t i = kDegree; i >= level; --i) {
      const double low = knots_[part + i];
      const double high = knots_[part + i + kDegree + 1 - level];
      const double share = (parameters.at(level - 1) - low) / (high - low);
      row.at(i) = (1.0 - share) * row.at(i - 1) + share * row.at(i);
    }
  }
  return row.back();
}

void add_curve(Block& block, const CldataCurve& curve, std::uint32_t column) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    add_number(block, "IJK"[axis], curve.first[axis], column);
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    add_number(block, "uvw"[axis], curve.second[axis], column);
  }
}

}  // namespace frustum::parser
