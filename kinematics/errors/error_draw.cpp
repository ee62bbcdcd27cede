#include "kinematics/errors/error_draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/random.hpp"

namespace frustum::kinematics {
namespace {

class Drawing {
 public:
  Drawing(std::uint64_t seed, std::uint32_t index)
      : key_{seed, index, RandomPurpose::error_amount} {}

  void fix(Amount& amount, const std::string& place) {
    for (std::size_t i = 0; i < amount.drawn.size(); ++i) {
      const DrawnFactor& factor = amount.drawn[i];
      const std::string name =
          factor.name.empty() ? fmt::format("{}/{}", place, i) : "drawn " + factor.name;
      const double x = drawn_from(factor.distribution, key_, stream_of(name)) + factor.shift;
      amount.value *= factor.function == DrawnFactor::Function::cosine ? std::cos(x)
                      : factor.function == DrawnFactor::Function::sine ? std::sin(x)
                                                                       : x;
      any_ = true;
    }
    amount.drawn.clear();
  }

  ErrorEntry operator()(ErrorEntry entry) {
    any_ = false;
    for (std::size_t t = 0; t < entry.terms.size(); ++t) {
      ErrorShape& shape = entry.terms[t];
      const std::string place = fmt::format("{}/{}", entry.name, t);
      fix(shape.amount, place + "/amount");
      fix(shape.phase, place + "/phase");
      fix(shape.peak, place + "/peak");
      for (std::size_t c = 0; c < shape.coefficients.size(); ++c) {
        fix(shape.coefficients[c], fmt::format("{}/{}", place, c));
      }
    }
    if (any_) entry.written = written(entry.terms);
    return entry;
  }

 private:
  RandomKey key_;
  bool any_ = false;
};

}  // namespace

std::uint64_t stream_of(std::string_view name) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ULL;
  }
  return hash;
}

double drawn_from(const Distribution& distribution, const RandomKey& key, std::uint64_t stream) {
  const Distribution d = distribution.read_as(ToleranceReading::uniform);
  if (d.kind == Distribution::Kind::uniform) return d.lo + (d.hi - d.lo) * uniform(key, stream);
  if (d.kind == Distribution::Kind::triangular) {
    const double u = uniform(key, stream);
    const double reach = 0.5 * (d.hi - d.lo);
    return u < 0.5 ? d.lo + reach * std::sqrt(2.0 * u) : d.hi - reach * std::sqrt(2.0 * (1.0 - u));
  }
  // A limit of a tenth of sd, the narrowest, keeps one draw in twelve: 1000 never fail.
  for (std::uint64_t attempt = 0; attempt < 1000; ++attempt) {
    const double deviation = d.deviation * normal(key, stream + attempt);
    if (!d.limit || std::abs(deviation) <= *d.limit) return d.mean + deviation;
  }
  return d.mean;
}

std::vector<ErrorEntry> draw(std::span<const ErrorEntry> entries, std::uint64_t seed,
                             std::uint32_t index) {
  Drawing drawing(seed, index);
  std::vector<ErrorEntry> fixed;
  fixed.reserve(entries.size());
  for (const ErrorEntry& entry : entries) fixed.push_back(drawing(entry));
  return fixed;
}

}  // namespace frustum::kinematics
