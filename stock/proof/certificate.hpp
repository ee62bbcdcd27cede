// Proof that a surface point of the workpiece is within its bound of the true surface.
//
// Model    : the true surface passes between a point of the void and a point of the material. Along
//            the normal at the distance of the bound, (a) the point towards the void is inside the
//            cutter that made it, at its pose then, or outside the blank, and (b) the point towards
//            the material is inside the blank and outside every cutter at every instant of every
//            segment. Both are shown by interval arithmetic from the tool path, the generatrices of
//            the cutters and the blank alone; nothing of the ray search is asked. On an edge, where
//            (b) fails along the normal since another segment cuts beside, other directions at the
//            same distance are tried: the claim is the same, the point is not regular
// Units    : mm; frame: workpiece
// Errors   : none; a proof that cannot be finished says why, and never counts as proven
// Accuracy : `proven` and `refuted` are proofs but for what blanks from meshes say of themselves
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "stock/solid/workpiece.hpp"

namespace frustum::stock {

enum class Verdict : std::uint8_t { proven, open, refuted };

struct Certificate {
  Verdict verdict = Verdict::open;
  bool regular = false;      // proven along the point's own normal
  std::string reason{};      // why it is not proven
  std::size_t spans = 0;     // of time that were looked at
  std::size_t segments = 0;  // that came near enough to be looked at one by one
};

struct CertifierOptions {
  std::size_t most_spans = 200000;  // a point
  // Segments from here on have not cut yet.
  std::uint32_t first_excluded = cutter::SweptCutter::kAll;
};

class Certifier {
 public:
  // The workpiece must outlive it.
  explicit Certifier(const Workpiece& workpiece, const CertifierOptions& options = {});

  // Within point.sweep_bound of the surface that the tool path of this workpiece leaves.
  [[nodiscard]] Certificate certify(const SurfacePoint& point) const;

 private:
  struct Tool;
  struct Search;
  struct Claim;
  [[nodiscard]] const Tool* tool_of(std::uint32_t segment) const;
  void prove_clear_of(const Tool& tool, Search& search) const;

  const Workpiece* workpiece_;
  CertifierOptions options_;
  std::vector<std::shared_ptr<const Tool>> tools_;
};

}  // namespace frustum::stock
