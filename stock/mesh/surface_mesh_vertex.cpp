#include "stock/mesh/surface_mesh_vertex.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <optional>

#include "core/constants.hpp"

namespace frustum::stock {
namespace {

// Normals that stay within this angle (rad) are one smooth surface: a vertex on it blunts an edge
// that is flatter still by less than 0.1 / 8 of the pitch.
constexpr double kSmooth = 0.1;
// The singular values of two planes that differ by an angle are as 1 to its half, 0.05 for kSmooth;
// less if one of them has more samples than the other. A direction below this is not determined.
constexpr double kUndetermined = 0.03;
// How far along its normal a face is looked for, in pitches. Faces that bend more within a cell are
// beyond what the pitch resolves.
constexpr double kReach = 0.25;
// Planes are taken at this fraction of their distance from the vertex, or nearer, so that on a face
// that bends no more than the pitch resolves they are on their side of the edge.
constexpr double kCloser = 0.15;
// After the first round, so many times farther from the vertex than that still is from its place.
constexpr double kBeside = 4.0;
// In pitches: nearer planes say no more of a face; a vertex this near to its place is there.
constexpr double kClosest = 2.5e-4, kInPlace = 1e-8;
constexpr int kRounds = 4;
// Path segments that are no farther apart in the program are one pass of the cutter.
constexpr EndTag kOnePass = 64;
// Faces of a corner that cross no edge of the cell, and are found when the others do not meet on
// the surface. At least one face does cross an edge.
constexpr std::size_t kHiddenFaces = 2;
constexpr std::size_t kMostSamples = 12 + kHiddenFaces;
constexpr int kMostRows = static_cast<int>(kMostSamples);

using Samples = std::span<const HermiteSample>;

Vec3 mean_point(Samples samples) {
  Vec3 sum = Vec3::Zero();
  for (const HermiteSample& sample : samples) sum += sample.point;
  return sum / static_cast<double>(samples.size());
}

// Zero when the normals cancel.
Vec3 mean_normal(Samples samples) {
  Vec3 sum = Vec3::Zero();
  for (const HermiteSample& sample : samples) sum += sample.normal;
  const double length = sum.norm();
  // Rounding of twelve unit vectors is far below 1e-9; a true mean this short has no use either.
  return length > 1e-9 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

double farthest(Samples samples, const Vec3& point) {
  double most = 0.0;
  for (const HermiteSample& sample : samples) most = std::max(most, (sample.point - point).norm());
  return most;
}

bool is_smooth(Samples samples) {
  for (std::size_t a = 0; a < samples.size(); ++a) {
    for (std::size_t b = a + 1; b < samples.size(); ++b) {
      // The chord of two unit vectors is, to its square, their angle; it is exact for small angles.
      if ((samples[a].normal - samples[b].normal).norm() > kSmooth) return false;
    }
  }
  return true;
}

bool contains(const BoundingBox& box, const Vec3& p) {
  return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
}

// The quadratic error function's minimum: the best of highest rank that is in `allowed`.
Vec3 meet(Samples samples, const BoundingBox& allowed) {
  Vec3 mean = mean_point(samples);
  const auto rows = static_cast<Eigen::Index>(samples.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMostRows, 3> normals(rows, 3);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1> distances(rows);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    normals.row(row) = samples[k].normal.transpose();
    distances[row] = samples[k].normal.dot(samples[k].point - mean);
  }
  // The 3x3 normal equations by SVD: eigenvalues are squares of singular values, hence the square
  // of the threshold. Their rounding, 1e-16 / kUndetermined^2, is 1e-13 of the pitch.
  const Mat3 square = normals.transpose() * normals;
  const Vec3 right = normals.transpose() * distances;
  const Eigen::JacobiSVD<Mat3> svd(square, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3& sigma = svd.singularValues();
  std::array<Vec3, 4> by_rank;
  by_rank[0] = mean;
  int rank = 0;
  while (rank < 3 && sigma[rank] > kUndetermined * kUndetermined * sigma[0]) {
    by_rank[static_cast<std::size_t>(rank) + 1] =
        by_rank[static_cast<std::size_t>(rank)] +
        svd.matrixV().col(rank) * (svd.matrixU().col(rank).dot(right) / sigma[rank]);
    ++rank;
  }
  for (; rank > 0; --rank) {
    const Vec3& point = by_rank[static_cast<std::size_t>(rank)];
    if (contains(allowed, point)) return point;
  }
  return mean;
}

// What one pass of a cutter made, or none, and is smooth.
bool are_of_one_face(const HermiteSample& a, const HermiteSample& b) {
  const bool is_one_pass = a.tag >= 0 && b.tag >= 0 && std::abs(a.tag - b.tag) <= kOnePass;
  return (a.tag == b.tag || is_one_pass) && (a.normal - b.normal).norm() <= kSmooth;
}

// What likely makes the surface at a point: between samples of one pass of a cutter, half way along
// its path if that is their mean; else what made the nearest.
EndTag likely_tag(Samples samples, const Vec3& point, bool is_mean) {
  EndTag first = samples.front().tag, last = first, sum = 0;
  for (const HermiteSample& sample : samples) {
    first = std::min(first, sample.tag);
    last = std::max(last, sample.tag);
    sum += sample.tag;
  }
  const auto count = static_cast<EndTag>(samples.size());
  if (is_mean && first >= 0 && last - first <= kOnePass) return (2 * sum + count) / (2 * count);
  const auto nearest = std::ranges::min_element(samples, {}, [&](const HermiteSample& sample) {
    return (sample.point - point).squaredNorm();
  });
  return nearest->tag;
}

// The samples again, but closer to the vertex, those of a face all where it is beside their mean;
// they keep their places if the surface found there belongs to another face.
void draw_closer(SolidView solid, std::span<HermiteSample> samples, const Vec3& vertex,
                 double distance, double reach, cutter::SweptNear* near) {
  while (!samples.empty()) {
    const HermiteSample first = samples.front();
    const auto others =
        std::partition(samples.begin(), samples.end(),
                       [&](const HermiteSample& sample) { return are_of_one_face(first, sample); });
    const auto face = samples.first(static_cast<std::size_t>(others - samples.begin()));
    samples = samples.subspan(face.size());
    const Vec3 arm = mean_point(face) - vertex;
    const Vec3 at = vertex + std::min(kCloser, distance / arm.norm()) * arm;
    const Vec3 normal = mean_normal(face);
    const EndTag tag = likely_tag(face, at, true);
    const auto found = nearest_surface(solid, at, normal, reach, {{&tag, 1}, near});
    // Within a cell a face turns by less than 60 degrees, or the pitch is too coarse for it anyway.
    if (found && found->normal.dot(normal) > 0.5) std::ranges::fill(face, *found);
  }
}

// What the samples say, and what the surface answers.
struct Answer {
  PlacedVertex placed;
  std::optional<HermiteSample> found;  // the surface next to the vertex
  bool settled = false;                // it is where, and as, the samples say
};

Answer solve(SolidView solid, std::span<HermiteSample> samples, const BoundingBox& allowed,
             double pitch, cutter::SweptNear* near) {
  Vec3 vertex = mean_point(samples);
  bool smooth = is_smooth(samples), has_met = false;
  double away = 0.0;
  for (int round = 0; round < kRounds && !smooth; ++round) {
    const Vec3 before = vertex;
    vertex = meet(samples, allowed);
    has_met = true;
    const double now = farthest(samples, vertex);
    double distance = kInfinity;
    if (round > 0) {
      // Faces leave their planes by the square of the distance, and before that the vertex was off
      // by what it moved: now it is by this, at flat faces by nothing.
      const double share = now / away;
      const double off = share * share * (vertex - before).norm();
      if (!(off >= kInPlace * pitch)) break;
      distance = std::max(kBeside * off, kClosest * pitch);
    }
    away = now;
    draw_closer(solid, samples, vertex, distance, kReach * pitch, near);
    smooth = is_smooth(samples);
  }
  if (!smooth) vertex = meet(samples, allowed);
  Answer answer{{vertex, mean_normal(samples), VertexKind::averaged}, std::nullopt, false};
  if (answer.placed.normal.isZero()) {
    answer.placed.normal = samples.front().normal;
    return answer;
  }
  const EndTag tag = likely_tag(samples, vertex, smooth && !has_met);
  answer.found =
      nearest_surface(solid, vertex, answer.placed.normal, 2.0 * kReach * pitch, {{&tag, 1}, near});
  if (!answer.found || !contains(allowed, answer.found->point)) return answer;
  // An edge vertex is on its edge already but for what the curvature of its faces left over.
  const bool meets = (answer.found->point - vertex).norm() < 1e-3 * pitch;
  answer.settled = smooth ? (answer.found->normal - answer.placed.normal).norm() < kSmooth : meets;
  const bool feature = !smooth && meets;
  answer.placed = {answer.found->point, feature ? answer.placed.normal : answer.found->normal,
                   feature ? VertexKind::feature : VertexKind::surface};
  return answer;
}

// Of a piece whose planes do not meet on the surface: from the mean of its samples the nearest that
// a probe along one of their normals meets, else the mean.
PlacedVertex beside_mean(SolidView solid, Samples samples, const BoundingBox& allowed, double pitch,
                         cutter::SweptNear* near) {
  const Vec3 mean = mean_point(samples);
  PlacedVertex placed{mean, mean_normal(samples), VertexKind::averaged};
  if (placed.normal.isZero()) placed.normal = samples.front().normal;
  double nearest = kInfinity;
  for (const HermiteSample& sample : samples) {
    const auto found =
        nearest_surface(solid, mean, sample.normal, 2.0 * kReach * pitch, {{&sample.tag, 1}, near});
    if (!found || found->normal.dot(sample.normal) < 0.5 || !contains(allowed, found->point))
      continue;
    const double distance = (found->point - mean).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    placed = {found->point, found->normal, VertexKind::surface};
  }
  return placed;
}

}  // namespace

std::optional<HermiteSample> nearest_surface(SolidView solid, const Vec3& point, const Vec3& normal,
                                             double reach,
                                             const cutter::SweptCutter::Likely& likely) {
  // Nearly always the way there from outside is free.
  const Ray inwards{point + reach * normal, -normal};
  cutter::SweptCutter::Likely known = likely;
  if (known.near != nullptr &&
      !(known.near->holds(inwards.origin) && known.near->holds(inwards.at(2.0 * reach)))) {
    known.near = nullptr;
  }
  const auto met = solid.first_surface(inwards, {0.0, 2.0 * reach}, known);
  constexpr double kFacing = 0.5;  // cosine of 60 deg: else something else is in the way
  if (met && met->normal.dot(normal) > kFacing) {
    return HermiteSample{inwards.at(met->s), met->normal,
                         met->segment ? static_cast<EndTag>(*met->segment) : EndTag{-1}};
  }
  const Ray ray{point - reach * normal, normal};
  const IntervalSet material = solid.material_along(ray, {0.0, 2.0 * reach});
  const Interval* best = nullptr;
  for (const Interval& piece : material.intervals()) {
    if (piece.hi_tag == -1) continue;  // the end of the search, not a surface
    if (best == nullptr || std::abs(piece.hi - reach) < std::abs(best->hi - reach)) best = &piece;
  }
  if (best == nullptr) return std::nullopt;
  return HermiteSample{ray.at(best->hi), solid.surface_at(ray, best->hi, best->hi_tag).normal,
                       best->hi_tag};
}

PlacedVertex place_vertex(SolidView solid, std::span<const HermiteSample> samples,
                          const BoundingBox& cell, double leave, cutter::SweptNear* near) {
  const double pitch = cell.max.x() - cell.min.x();
  const Vec3 spare = Vec3::Constant(leave * pitch);
  const BoundingBox allowed{cell.min - spare, cell.max + spare};

  using Known = boost::container::static_vector<HermiteSample, kMostSamples>;
  Known known(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                     samples.size(), kMostSamples - kHiddenFaces)));
  std::optional<PlacedVertex> first;
  for (std::size_t hidden = 0; hidden <= kHiddenFaces; ++hidden) {
    Known drawn = known;
    const Answer answer = solve(solid, {drawn.data(), drawn.size()}, allowed, pitch, near);
    if (answer.settled) return answer.placed;
    if (!first) first = answer.placed;
    if (!answer.found || hidden == kHiddenFaces) break;
    known.push_back(*answer.found);
  }
  if (first->kind != VertexKind::averaged) return *first;
  return beside_mean(solid, samples, allowed, pitch, near);
}

}  // namespace frustum::stock
