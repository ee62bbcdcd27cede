#include "metrology/fit/element_gram.hpp"

#include "metrology/fit/element_rows.hpp"

namespace frustum::metrology {
namespace {

using Block = PointBlocks::Block;

// Four sums side by side: additions need not wait for each other.
[[gnu::noinline]] double products(const Block& a, const Block& b) {
  using Four = Eigen::Array<double, 4, 1>;
  Four sums = Four::Zero();
  for (Eigen::Index i = 0; i < PointBlocks::kSize; i += 4) {
    sums += a.segment<4>(i) * b.segment<4>(i);
  }
  return sums.sum();
}

template <typename E>
[[gnu::noinline]] ElementGram gram(const E& element, const PointBlocks& points) {
  constexpr int kN = kParametersOf<E>;
  ElementGram sums = ElementGram::Zero(kN + 1, kN + 1);
  for (std::size_t b = 0; b < points.x.size(); ++b) {
    auto r = row<Block>(element, points.x[b], points.y[b], points.z[b]);
    if (points.weighs(b)) {
      r.residual *= points.root_weight[b];
      for (Block& column : r.gradient) column *= points.root_weight[b];
    }
    for (int i = 0; i < kN; ++i) {
      const Block& column = r.gradient[static_cast<std::size_t>(i)];
      for (int j = 0; j <= i; ++j) {
        sums(i, j) += products(column, r.gradient[static_cast<std::size_t>(j)]);
      }
      sums(kN, i) += products(column, r.residual);
    }
    sums(kN, kN) += products(r.residual, r.residual);
  }
  return sums;
}

}  // namespace

ElementGram gram_of(const Element& element, const PointBlocks& points) {
  return std::visit([&](const auto& e) { return gram(e, points); }, element);
}

}  // namespace frustum::metrology
