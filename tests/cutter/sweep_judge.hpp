// Holds what a SweptCutter reports along a ray against standing cutters.
//
// Units: mm. Errors: none; the judgement is data.
#pragma once

#include <string>

#include "cutter/search/swept_cutter.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {

struct Judgement {
  long rays = 0;
  long ends = 0;
  double worst_end = 0.0;      // |least signed distance| at a reported end
  double worst_covered = 0.0;  // how far a point of a reported interval is from every cutter
  double worst_void = 0.0;     // how deep a point of a reported gap is in some cutter
  double worst_contact = 0.0;  // distance of a contact's point from its cutter at its moment
  double worst_normal =
      0.0;              // of a step along the normal, what does not lead away from that cutter
  std::string where{};  // of the worst end

  void add(const Judgement& other);
};

class SweepJudge {
 public:
  SweepJudge(const Kind& kind, const kinematics::ToolPath& path);

  // Every end, and points between ends; s = 0 is one of them.
  [[nodiscard]] Judgement along(const Ray& ray, Draw& draw) const;
  // A ray through the neighbourhood of the sweep; half of them only just touch it.
  [[nodiscard]] Ray random_ray(Draw& draw) const;

  [[nodiscard]] const cutter::SweptCutter& swept() const { return swept_; }

 private:
  void judge_point(const Ray& ray, double s, bool reported_covered, Judgement& judged) const;
  void judge_end(const Ray& ray, double s, EndTag tag, Judgement& judged) const;

  cutter::SweptCutter swept_;
  StandingCutters standing_;
  bool is_convex_;
};

}  // namespace frustum::proof
