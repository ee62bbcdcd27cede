#include "cutter/search/gap_pieces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/constants.hpp"

namespace frustum::cutter {
namespace {

class GapSearch {
 public:
  GapSearch(const RayQuestion& question, const Body& body, std::span<const RayGap> gaps)
      : question_(question), body_(body), gaps_(gaps), order_(gaps.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t i) { return gaps_[i].segment; });
  }

  std::vector<GapPiece> pieces() && {
    double lo = kInfinity, hi = -kInfinity;
    for (const RayGap& gap : gaps_) {
      lo = std::min(lo, gap.lo);
      hi = std::max(hi, gap.hi);
    }
    look(order_, lo, hi);
    std::ranges::sort(found_, {}, [](const GapPiece& p) { return std::tuple(p.gap, p.lo); });
    std::size_t count = 0;
    for (const GapPiece& piece : found_) {
      GapPiece* const last = count > 0 ? &found_[count - 1] : nullptr;
      if (last != nullptr && last->gap == piece.gap && piece.lo <= last->hi) {
        last->hi = std::max(last->hi, piece.hi);
      } else {
        found_[count++] = piece;
      }
    }
    found_.resize(count);
    return std::move(found_);
  }

 private:
  void look(std::span<const std::uint32_t> run, double lo, double hi) {
    if (run.empty()) return;
    double from = hi, to = lo;
    for (const std::uint32_t i : run) {
      from = std::min(from, std::max(lo, gaps_[i].lo));
      to = std::max(to, std::min(hi, gaps_[i].hi));
    }
    if (!(from <= to)) return;
    constexpr int kMostLooks = 4000;
    if (run.size() == 1 || ++looks_ > kMostLooks) {
      keep(run, from, to);
      return;
    }
    const ToolPose& middle = begin_of(run[run.size() / 2]);
    const double spread = spread_of(run, middle), half = 0.5 * (to - from);
    const double away = body_.distance(middle, question_.ray.at(from + half));
    if (away >= half + spread) return;
    constexpr double kLeast = 1e-9;  // mm, above rounding
    if (half > std::max(spread, kLeast)) {
      look(run, from, from + half);
      look(run, from + half, to);
    } else {
      look(run.first(run.size() / 2), from, to);
      look(run.subspan(run.size() / 2), from, to);
    }
  }

  void keep(std::span<const std::uint32_t> run, double lo, double hi) {
    for (const std::uint32_t i : run) {
      const double from = std::max(lo, gaps_[i].lo), to = std::min(hi, gaps_[i].hi);
      if (from <= to) found_.push_back({i, from, to});
    }
  }

  [[nodiscard]] const kinematics::PathSegment& segment_of(std::uint32_t gap) const {
    return question_.path->segments[gaps_[gap].segment];
  }
  [[nodiscard]] const ToolPose& begin_of(std::uint32_t gap) const {
    return question_.path->from(segment_of(gap));
  }
  // No point of the cutter is farther from where it is at that pose at any moment of the run. An
  // axis leaves its chord by less than its square.
  [[nodiscard]] double spread_of(std::span<const std::uint32_t> run, const ToolPose& middle) const {
    double most = 0.0, turned = 0.0;
    const auto from_middle = [&](const ToolPose& pose) {
      return (pose.tip - middle.tip).norm() + body_.reach() * (pose.axis - middle.axis).norm();
    };
    for (const std::uint32_t i : run) {
      const ToolPose &from = begin_of(i), &to = question_.path->to(segment_of(i));
      most = std::max({most, from_middle(from), from_middle(to)});
      turned = std::max(turned, (to.axis - from.axis).squaredNorm());
    }
    return most + body_.reach() * turned;
  }

  const RayQuestion& question_;
  const Body& body_;
  std::span<const RayGap> gaps_;
  std::vector<std::uint32_t> order_;
  std::vector<GapPiece> found_{};
  int looks_ = 0;
};

}  // namespace

std::vector<GapPiece> pieces_to_walk(const RayQuestion& question, const Body& body,
                                     std::span<const RayGap> gaps) {
  return GapSearch(question, body, gaps).pieces();
}

}  // namespace frustum::cutter
