#include "studies/laws/random_field.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/constants.hpp"

namespace frustum::studies {
namespace {

using kinematics::ErrorShape;
using kinematics::FieldKernel;

constexpr double kShareOfVariance = 0.999;

double spectral_density(FieldKernel kernel, double frequency, double length) {
  if (kernel == FieldKernel::gaussian) {
    const double x = frequency * length;
    return length * std::sqrt(2.0 * std::numbers::pi) * std::exp(-0.5 * x * x);
  }
  const double rate = std::numbers::sqrt3 / length;
  const double sum = rate * rate + frequency * frequency;
  return 4.0 * rate * rate * rate / (sum * sum);
}

double circle_for(FieldKernel kernel, double span, double length) {
  return kernel == FieldKernel::gaussian ? span + 6.0 * length : 2.0 * span + 8.0 * length;
}

kinematics::Amount normal_amount(double deviation, UnitKind unit, std::string name) {
  kinematics::Amount amount{.value = 1.0, .kind = unit};
  amount.drawn.push_back({.distribution = {.kind = kinematics::Distribution::Kind::normal,
                                           .unit = unit,
                                           .deviation = deviation},
                          .name = std::move(name)});
  return amount;
}

}  // namespace

double FieldSpectrum::rescaling() const {
  double sum = 0.0;
  for (const double v : variances) sum += v;
  return 1.0 / std::sqrt(sum);
}

Result<FieldSpectrum> field_spectrum(FieldKernel kernel, double span, double correlation_length) {
  FieldSpectrum spectrum{.period = circle_for(kernel, span, correlation_length)};
  double sum = 0.0;
  for (int k = 0; k <= kMostHarmonics; ++k) {
    const double density =
        spectral_density(kernel, kTurn * k / spectrum.period, correlation_length);
    spectrum.variances.push_back((k == 0 ? 1.0 : 2.0) * density / spectrum.period);
    sum += spectrum.variances.back();
    if (sum >= kShareOfVariance) return spectrum;
  }
  return error("field-correlation"_id,
               fmt::format("a field with a correlation length of {:g} over a span of {:g} needs "
                           "more than {} harmonics",
                           correlation_length, span, kMostHarmonics),
               "write a longer correlation length, or a shorter span: over 0mm..100mm");
}

double kernel_value(FieldKernel kernel, double distance, double correlation_length) {
  const double x = std::abs(distance) / correlation_length;
  if (kernel == FieldKernel::gaussian) return std::exp(-0.5 * x * x);
  return (1.0 + std::numbers::sqrt3 * x) * std::exp(-std::numbers::sqrt3 * x);
}

Result<std::vector<ErrorShape>> field_terms(const ErrorShape& field,
                                            const kinematics::AxisRange& span,
                                            const std::string& place) {
  const auto spectrum = field_spectrum(field.kernel, span.width(), field.correlation);
  if (!spectrum) return spectrum.error();
  const double scale = field.amount.value * spectrum->rescaling();
  std::vector<ErrorShape> terms;
  for (std::size_t k = 0; k < spectrum->variances.size(); ++k) {
    const double deviation = scale * std::sqrt(spectrum->variances[k]);
    const std::string name = fmt::format("{}/field/{}", place, k);
    if (k == 0) {
      terms.push_back({.amount = normal_amount(deviation, field.amount.kind, name)});
      continue;
    }
    ErrorShape wave{.kind = ErrorShape::Kind::cyclic,
                    .amount = normal_amount(deviation, field.amount.kind, name + "/cos"),
                    .period = spectrum->period / static_cast<double>(k)};
    wave.position_kind = field.position_kind;
    terms.push_back(wave);
    wave.amount = normal_amount(deviation, field.amount.kind, name + "/sin");
    wave.phase = {.value = -0.25 * kTurn, .kind = UnitKind::angle};
    terms.push_back(wave);
  }
  return terms;
}

}  // namespace frustum::studies
