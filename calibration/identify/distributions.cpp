#include "calibration/identify/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>

namespace frustum::calibration {

double chi_square_tail(double chi_square, int degrees_of_freedom) {
  assert(degrees_of_freedom > 0 && chi_square >= 0.0);
  const boost::math::chi_squared distribution(degrees_of_freedom);
  return boost::math::cdf(boost::math::complement(distribution, chi_square));
}

double coverage_factor(double confidence, std::optional<double> degrees_of_freedom) {
  assert(confidence > 0.0 && confidence < 1.0);
  const double upper = 0.5 * (1.0 - confidence);
  if (!degrees_of_freedom) {
    return boost::math::quantile(boost::math::complement(boost::math::normal(), upper));
  }
  return boost::math::quantile(
      boost::math::complement(boost::math::students_t(*degrees_of_freedom), upper));
}

}  // namespace frustum::calibration
