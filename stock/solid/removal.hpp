// What each block of the program takes away: volume, rate, engagement, first and last contact.
//
// Model    : along a ray the material left after block N is known for every N; what differs between
//            N-1 and N is what block N removed. The blocks that took something are found by asking
//            only at the blocks whose sweeps bound what is missing, and by halving where no bound
//            tells. Volumes are sums over three families of parallel rays, one in each cell of a
//            grid that divides the blank's box evenly, and the mean of the three
// Units    : mm, mm3, s; frame: workpiece
// Shape    : one BlockRemoval for each block of the tool path, in program order
// Errors   : removal_of() refuses a pitch that is not a finite number above 0, and a grid of more
//            than
//            kMaxRemovalRays rays
// Accuracy : along a ray that of Workpiece (1 nm), and the pieces of all blocks add up to what is
//            missing of the blank within rounding. Volumes converge with the pitch; rows are
//            shifted against each other, so that faces along the rays average out. Boxes that the
//            grid divides are exact (tests/stock/removal_test.cpp)
// Threads  : removal_of() runs on oneTBB; the same bits for any number of threads
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/solid/program_state.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock {

// A part of a ray and the block that took the material there.
struct RemovedPiece {
  std::uint32_t block = 0;
  Interval piece{};
};

// In program order; pieces of one block from the ray's beginning on.
[[nodiscard]] std::vector<RemovedPiece> removed_along(const Workpiece& workpiece,
                                                      const Timetable& table, const Ray& ray,
                                                      RaySpan span);

struct BlockRemoval {
  std::uint32_t block = 0;
  double volume = 0.0;             // mm3
  double rate = 0.0;               // mm3/min over the block's duration; 0 where that is unknown
  double largest_thickness = 0.0;  // mm of material met along a ray, all three families
  double mean_thickness = 0.0;     // mm, of all pieces met
  // Axial: along what of its axis the tool is in what the block takes, at any time and whether or
  // not it is gone by then (a plunge: its depth). Radial: of the material, across axis and feed,
  // where the cutter meets it (a plunge has none).
  double axial_engagement = 0.0;
  std::optional<double> radial_engagement{};
  // s since the start of the program, as the rays of the grid are met; nothing: the block cuts air.
  std::optional<double> first_contact{};
  std::optional<double> last_contact{};
};

struct RemovalOptions {
  Mm pitch{};  // of the rays; 0: the blank's longest side / 120
};

inline constexpr double kMaxRemovalRays = 50e6;

[[nodiscard]] Result<std::vector<BlockRemoval>> removal_of(const Workpiece& workpiece,
                                                           const RemovalOptions& options = {});

// One ray in each cell of a grid over a box, shifted from row to row, as rays of one axis from the
// box's lower face.
struct CellRays {
  Vec3 origin = Vec3::Zero();
  int axis = 0;
  int count_u = 1, count_v = 1;         // cells along axes axis+1, axis+2
  double pitch_u = 0.0, pitch_v = 0.0;  // mm
  double length = 0.0;                  // mm of the box along the axis

  [[nodiscard]] static CellRays over(const BoundingBox& box, int axis, double pitch);
  [[nodiscard]] Ray ray(int u, int v) const;
  [[nodiscard]] RaySpan span() const { return {0.0, length}; }
  [[nodiscard]] double cell() const { return pitch_u * pitch_v; }
};

}  // namespace frustum::stock
