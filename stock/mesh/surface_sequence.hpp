// The surfaces of one workpiece at program states that follow each other.
//
// Model    : between two states only the segments between them are new. Rays of the tri-dexel, and
//            blocks of cells with the rays of their vertices, that the boxes of these sweeps do not
//            reach are as they were; the others are asked again. What follows (triangles, folds) is
//            made anew of the whole. So each surface is, bit for bit, that of extract_surface() at
//            its state (tests/stock/surface_sequence_test.cpp)
// Units    : mm; frame: workpiece
// Shape    : between calls it keeps what one surface is made of: about the memory of a tri-dexel
//            and twice that of a mesh
// Errors   : those of TriDexel::sample
// Accuracy : that of extract_surface()
// Threads  : at() runs on oneTBB; the same bits for any number of threads
#pragma once

#include <cstddef>
#include <memory>

#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/program_state.hpp"

namespace frustum::stock {

class SurfaceSequence {
 public:
  // Samples the blank's box. The workpiece must outlive it.
  SurfaceSequence(const Workpiece& workpiece, Mm pitch);
  ~SurfaceSequence();
  SurfaceSequence(SurfaceSequence&&) noexcept;
  SurfaceSequence& operator=(SurfaceSequence&&) noexcept;

  // States in the order of the program take the least time. One before the last is made anew.
  [[nodiscard]] Result<SurfaceMesh> at(const ProgramState& state);
  // Of the last state: how many vertices there were at first, and how many of them were placed.
  struct Work {
    std::size_t vertices = 0, placed = 0;
  };
  [[nodiscard]] const Work& work() const { return work_; }

 private:
  struct Stages;
  const Workpiece* workpiece_;
  Mm pitch_;
  std::unique_ptr<const Stages> last_;  // null: before the first
  Work work_{};
};

}  // namespace frustum::stock
