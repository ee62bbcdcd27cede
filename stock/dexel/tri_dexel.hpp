// Three orthogonal families of exact rays through a solid, on one cubic grid.
//
// Model    : the ray of axis d through the grid nodes (u, v) of the other two axes keeps the
//            intervals of material along it; u = d+1, v = d+2 (cyclic). The outermost nodes are
//            outside the box and hold no material: a solid that reaches beyond the box is cut off
//            half a pitch inside them.
// Units    : mm; frame: that of the solid
// Shape    : memory grows with (size of the box / pitch)^2, never with its cube
// Errors   : sample() refuses a pitch or box that is not finite and positive, and a grid of more
//            than kMaxRays rays (the message names the least pitch that fits)
// Accuracy : every end is as exact as the solid's rays; volume() converges at order 2 for curved
//            bodies (tests/stock/tri_dexel_test.cpp), at order 1 for faces parallel to the rays,
//            where a whole layer of rays hits or misses at once: the volume of the surface mesh is
//            the better number
// Threads  : sample() and sampled_again() run on oneTBB; the same bits for any number of threads
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/interval_set.hpp"
#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/dexel/tri_dexel_solid.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::stock {

// The nodes origin + pitch * (i, j, k), 0 <= i < nodes[0] and so on.
struct DexelGrid {
  Vec3 origin = Vec3::Zero();
  double pitch = 1.0;
  std::array<int, 3> nodes{};

  // Covers the box with one to two spare layers. The nodes are shifted against the box by
  // irrational fractions of the pitch, so that rays are not in planes where people like to put
  // faces.
  [[nodiscard]] static DexelGrid over(const BoundingBox& box, double pitch);

  [[nodiscard]] Vec3 node(int i, int j, int k) const { return origin + pitch * Vec3(i, j, k); }
  // The ray of axis `axis` through the nodes (u, v); it starts (s = 0) at its first node.
  [[nodiscard]] Ray ray(int axis, int u, int v) const;
  [[nodiscard]] std::int64_t rays() const;
};

class ReachedRays;

class TriDexel {
 public:
  static constexpr std::int64_t kMaxRays = 200'000'000;  // about 2 GB of empty rays

  [[nodiscard]] static Result<TriDexel> sample(SolidView solid, const BoundingBox& box, Mm pitch);

  // Of a solid that differs from the one sampled only along rays that were reached: bit for bit
  // what sample() finds of it.
  [[nodiscard]] TriDexel sampled_again(SolidView solid, const ReachedRays& reached) const;

  [[nodiscard]] const DexelGrid& grid() const { return grid_; }
  // Material along grid().ray(axis, u, v).
  [[nodiscard]] std::span<const Interval> material(int axis, int u, int v) const;
  [[nodiscard]] std::size_t interval_count() const;

  // Material volume as each family of rays sees it, mm^3, and the mean of the three.
  [[nodiscard]] std::array<double, 3> volumes() const;
  [[nodiscard]] double volume() const;

 private:
  struct Family {
    std::vector<std::size_t> first;  // intervals of ray r: [first[r], first[r + 1])
    std::vector<Interval> intervals;
  };
  // What is known of the rays: all of it but where they were reached.
  struct Known {
    const TriDexel* dexels = nullptr;
    const ReachedRays* reached = nullptr;
  };
  explicit TriDexel(const DexelGrid& grid) : grid_(grid) {}
  void sample_family(SolidView solid, int axis, const Known& known);

  DexelGrid grid_;
  std::array<Family, 3> families_;
};

}  // namespace frustum::stock
