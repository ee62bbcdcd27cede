#include "metrology/fit/curvature.hpp"

#include "metrology/fit/element_gram.hpp"

namespace frustum::metrology {
namespace {

enum class Sort { shift, tilt, size };

struct Direction {
  Sort sort = Sort::size;
  Vec3 along = Vec3::Zero();
};

Direction direction_of(Parameter parameter, const Element& element) {
  const UnitVec3* axis = axis_of(element);
  const UnitVec3 a = axis != nullptr ? *axis : UnitVec3::z();
  const auto [u, v] = tangents(a);
  switch (parameter) {
    case Parameter::shift_u:
      return {Sort::shift, u};
    case Parameter::shift_v:
      return {Sort::shift, v};
    case Parameter::shift_along:
      return {Sort::shift, a.vec()};
    case Parameter::shift_x:
      return {Sort::shift, Vec3::UnitX()};
    case Parameter::shift_y:
      return {Sort::shift, Vec3::UnitY()};
    case Parameter::shift_z:
      return {Sort::shift, Vec3::UnitZ()};
    case Parameter::tilt_u:
      return {Sort::tilt, u};
    case Parameter::tilt_v:
      return {Sort::tilt, v};
    case Parameter::radius:
    case Parameter::tube_radius:
    case Parameter::half_angle:
      break;
  }
  return {};
}

// A gradient by the parameters of `there` as one by those of `here`, whose tangents are others.
ElementStep turned(const ElementStep& gradient, const Element& there, const Element& here) {
  const std::span<const Parameter> parameters = parameters_of(kind_of(here));
  ElementStep result = ElementStep::Zero(gradient.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Direction wanted = direction_of(parameters[i], here);
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      const Direction given = direction_of(parameters[j], there);
      const double share =
          wanted.sort == Sort::size || given.sort == Sort::size
              ? static_cast<double>(i == j)
              : static_cast<double>(wanted.sort == given.sort) * wanted.along.dot(given.along);
      result[static_cast<Eigen::Index>(i)] += share * gradient[static_cast<Eigen::Index>(j)];
    }
  }
  return result;
}

}  // namespace

StepBasis curvature_of(const Element& element, const PointBlocks& points, const StepBasis& basis) {
  // The error of a difference goes with its square, that of rounding with its inverse: both near
  // 1e-11.
  constexpr double kStep = 1e-5;
  const auto gradient = [&](const ElementStep& step) {
    const Element there = moved(element, step);
    const ElementGram gram = gram_of(there, points);
    const Eigen::Index n = gram.rows() - 1;
    return turned(gram.row(n).head(n).transpose(), there, element);
  };
  StepBasis square(basis.cols(), basis.cols());
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    const ElementStep step = kStep * basis.col(k);
    square.col(k) = basis.transpose() * (gradient(step) - gradient(-step)) / (2.0 * kStep);
  }
  return StepBasis(0.5 * (square + square.transpose()));
}

}  // namespace frustum::metrology
