#include "trials/population/local_contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "cutter/search/swept_cutter.hpp"

namespace frustum::trials {
namespace {

using kinematics::ToolPath;
using kinematics::ToolPose;

// Chords within half of the bound, as path_sampling.hpp leaves them.
int chords_of(const PosesOfPiece& p, double reach, double bound) {
  const Vec3 bend = p[0].tip - 2.0 * p[1].tip + p[2].tip;
  const Vec3 turn = p[0].axis - 2.0 * p[1].axis + p[2].axis;
  const double sagitta = 0.5 * (bend.norm() + reach * turn.norm());
  constexpr double kMost = 64.0;
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(sagitta / (0.5 * bound))), 1.0, kMost));
}

// Pieces whose ends are farther than this from there (mm) cannot make it for any
// drift of a machine within its laws: they are there to be seen to keep away, by micrometres, for
// which coarse chords are good enough.
constexpr double kAside = 0.03;
constexpr double kCoarse = 5e-5;

// The path, and whether its segments may be where a contact is: not the first and last piece of a
// range, beyond which the path goes on, nor one aside.
struct LocalPath {
  ToolPath path{};
  std::vector<bool> is_inner{};
};

LocalPath path_of(const LocalSurroundings& near, int tool, const cutter::Body& body,
                  double path_bound) {
  LocalPath local;
  local.path.bound = path_bound;
  const Vec3 place = carried(near.origin, near.own);
  const auto is_aside = [&](const ToolPose& pose) { return body.distance(pose, place) > kAside; };
  kinematics::PathBlock block;
  block.tool = tool;
  std::size_t piece = 0;
  for (const std::uint32_t length : near.lengths) {
    const auto index = static_cast<std::uint32_t>(local.path.blocks.size());
    local.path.blocks.push_back(block);
    local.path.poses.push_back(near.pieces[piece][0]);
    for (std::uint32_t k = 0; k < length; ++k, ++piece) {
      const PoseParabola parabola{near.pieces[piece]};
      const bool aside = is_aside(near.pieces[piece][0]) && is_aside(near.pieces[piece][2]);
      const int chords = chords_of(near.pieces[piece], body.reach(),
                                   aside ? std::max(kCoarse, path_bound) : path_bound);
      for (int i = 1; i <= chords; ++i) {
        local.path.segments.push_back(
            {static_cast<std::uint32_t>(local.path.poses.size() - 1), index});
        local.path.poses.push_back(i == chords ? near.pieces[piece][2]
                                               : parabola.at(static_cast<double>(i) / chords));
        local.is_inner.push_back(!aside && k > 0 && k + 1 < length);
      }
    }
  }
  return local;
}

// Answers approaches with what the pieces leave; remembers whether an outer one ever did.
class LocalProbe {
 public:
  LocalProbe(const cutter::SweptCutter& swept, const std::vector<bool>& is_inner)
      : swept_(swept), is_inner_(is_inner) {}

  [[nodiscard]] std::optional<metrology::Touch> touch(const Vec3& start, const UnitVec3& direction,
                                                      double length_mm) const {
    const Ray ray{start, direction};
    const auto contact = swept_.end_of_void(ray, 0.0, length_mm);
    if (!contact || contact->s >= length_mm) return std::nullopt;
    stays_inside_ = stays_inside_ && is_inner_[contact->segment];
    return metrology::Touch{ray.at(contact->s), -contact->normal, {}};  // out of the material
  }
  [[nodiscard]] bool stays_inside() const { return stays_inside_; }

 private:
  const cutter::SweptCutter& swept_;
  const std::vector<bool>& is_inner_;
  mutable bool stays_inside_ = true;
};

}  // namespace

std::optional<metrology::BallContact> local_contact(const LocalSurroundings& near, int tool,
                                                    const cutter::Cutter& cutter,
                                                    const metrology::BallApproach& approach,
                                                    double path_bound) {
  LocalPath local = path_of(near, tool, cutter.body(), path_bound);
  const auto swept = cutter::SweptCutter::sweep(std::move(local.path),
                                                std::map<int, cutter::Cutter>{{tool, cutter}});
  if (!swept) return std::nullopt;
  const LocalProbe probe(*swept, local.is_inner);
  const metrology::BallContact contact = metrology::touch_with_ball(probe, approach);
  if (contact.state != metrology::ContactState::contact || !probe.stays_inside()) {
    return std::nullopt;
  }
  const double drift = (contact.touch.point - carried(near.origin, near.own)).norm();
  const double moved = (contact.touch.point - near.origin.touched).norm();
  return near.others_keep_away(drift, moved) ? std::optional(contact) : std::nullopt;
}

}  // namespace frustum::trials
