// The volume that the moving cutters cover, asked along rays.
//
// Model    : union over all segments of a ToolPath of the cutter body moving through it
// Units    : mm; frame: workpiece
// Errors   : sweep() refuses a path that uses a tool number without a cutter, or turns a tool half
//            about
//            between two poses
// Accuracy : interval ends within 1 nm normal to the swept surface for the given path; of concave
//            cutters
//            as concave_sweep.hpp says
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/interval_set.hpp"
#include "core/ray.hpp"
#include "core/result.hpp"
#include "cutter/body/cutter.hpp"
#include "cutter/search/end_fan.hpp"
#include "cutter/search/ray_search.hpp"
#include "cutter/search/sweep_contact.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::cutter {

// What may cover anything in a ball: groups of the trees of poses, by tool; and what the ends of
// rays there have shown of them, which is added to as rays are asked.
struct SweptNear {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;  // mm
  std::vector<std::vector<std::uint32_t>> groups{};
  std::vector<EndFans> fans{};

  [[nodiscard]] bool holds(const Vec3& point) const {
    return (point - centre).squaredNorm() <= radius * radius;
  }
  [[nodiscard]] bool empty() const;
};

class SweptCutter {
 public:
  static constexpr std::uint32_t kAll = std::numeric_limits<std::uint32_t>::max();

  // `tools` by tool number, as the blocks of the path name them.
  [[nodiscard]] static Result<SweptCutter> sweep(kinematics::ToolPath path,
                                                 std::map<int, Cutter> tools);

  // Covered part of the ray; an end's tag is the segment that made it. Segments from
  // `first_excluded` on are left out. Gaps of less than 1e-9 mm are passed over: rounding leaves
  // them where the parts of a cutter meet.
  [[nodiscard]] IntervalSet along(const Ray& ray, RaySpan span,
                                  std::uint32_t first_excluded = kAll) const;
  // The same of parallel rays, bit for bit: in rows of `row`, neighbours near each other, so that
  // they share their search. Where a span is empty (lo above hi), nothing is asked.
  [[nodiscard]] std::vector<IntervalSet> along_all(std::span<const Ray> rays,
                                                   std::span<const RaySpan> spans, std::size_t row,
                                                   std::uint32_t first_excluded = kAll) const;
  // Walks from `from` to the end of what is covered there without a gap: where a probe that comes
  // out of the void meets material. Nothing if `from` is not covered. Gaps of less than 1e-9 mm are
  // passed over.
  [[nodiscard]] std::optional<SweepContact> end_of_void(const Ray& ray, double from, double to,
                                                        std::uint32_t first_excluded = kAll) const;
  // The same, begun with what is likely to make the end. `near`: what near() found for a ball that
  // holds the ray from `from` to `to`; of one thread at a time.
  struct Likely {
    std::span<const EndTag> segments{};  // negative ones say nothing
    SweptNear* near = nullptr;
  };
  [[nodiscard]] std::optional<SweepContact> end_of_void(const Ray& ray, double from, double to,
                                                        const Likely& likely,
                                                        std::uint32_t first_excluded) const;
  // What may cover anything within `radius` of `centre`; `within`: of a ball around this one.
  [[nodiscard]] SweptNear near(const Vec3& centre, double radius, std::uint32_t first_excluded,
                               const SweptNear* within = nullptr) const;
  // What the cutter, shrunk by `shrunk_by` all round, surely covers in these segments alone: the
  // cutter at poses a quarter of its radius apart. For finding collisions, not for surfaces.
  [[nodiscard]] IntervalSet core_along(const Ray& ray, std::span<const std::uint32_t> segments,
                                       double shrunk_by) const;
  // The contact that made the end at s that along() tagged with `segment`.
  [[nodiscard]] SweepContact contact(const Ray& ray, double s, std::uint32_t segment) const;

  // No segment outside [first, last] comes nearer to the point than this, or than `enough` (mm).
  [[nodiscard]] double clearance(const Vec3& point, std::uint32_t first, std::uint32_t last,
                                 double enough) const;

  // No end found on a ray is farther than this from the surface that the path sweeps, normal to it
  // and but for rounding (mm): twice kSearchTolerance, for the solution and for what is left aside,
  // and kMissedDepth; with concave cutters more (concave_sweep.hpp).
  [[nodiscard]] double accuracy() const { return accuracy_; }

  // Of the segment's sweep.
  [[nodiscard]] Box box(std::uint32_t segment) const;

  [[nodiscard]] const kinematics::ToolPath& path() const { return path_; }
  [[nodiscard]] const Cutter& tool(int number) const { return tools_->at(number); }
  [[nodiscard]] std::shared_ptr<const std::map<int, Cutter>> tools() const { return tools_; }

 private:
  SweptCutter(kinematics::ToolPath path, std::map<int, Cutter> tools);
  [[nodiscard]] const Body& body_of(std::uint32_t segment) const;
  [[nodiscard]] SweepContact contact_of(const Ray& ray, const SweptIntervalEnd& end) const;
  bool advance_front_near(const RayQuestion& question, std::size_t tool, const Likely& likely,
                          SweptIntervalEnd& front) const;

  kinematics::ToolPath path_;
  std::shared_ptr<const std::map<int, Cutter>> tools_;  // shared by copies: profiles are pointed to
  double accuracy_ = 0.0;
  std::shared_ptr<const std::vector<ToolSweep>> sweeps_;
};

}  // namespace frustum::cutter
