#include "stock/mesh/decimate_surface.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "stock/mesh/near_numbers.hpp"
#include "stock/mesh/near_triangle.hpp"
#include "stock/mesh/quadric.hpp"
#include "stock/mesh/surface_blocks.hpp"
#include "stock/mesh/triangle_links.hpp"
#include "stock/mesh/vertex_fan.hpp"

namespace frustum::stock {
namespace {

// Faces that turn more than this (cosine of 0.3 rad) at an edge between feature vertices make it
// sharp: three times what extraction takes for smooth, since triangles on a bent face turn too.
constexpr double kSharpCosine = 0.955336;
// Within the tolerance a triangle may still turn over; 20 degrees keeps wrinkles out.
constexpr double kMostTurnCosine = 0.939693;
// Of the tolerance, for the vertices taken away; what is between those vertices gets the rest.
constexpr double kVertexShare = 0.5;
// Lower than this share of its longest side, a triangle is a needle: a hundred times what
// measure() counts as degenerate.
constexpr double kNeedle = 1e-4;
// Collapses that cost the same take the shortest edge first: a share of the tolerance.
constexpr double kShortFirst = 1e-3;
// A round ends in a block when this share of its vertices is left: the blocks of the next round
// have other borders, so that all of the surface keeps pace.
constexpr double kLeftByRound = 0.3;
constexpr int kMostBlockRounds = 24;

class Decimation {
 public:
  Decimation(const SurfaceMesh& mesh, NearNumbers numbers, TriangleLinks links, double tolerance)
      : mesh_(mesh),
        numbers_(std::move(numbers)),
        links_(std::move(links)),
        tolerance_(tolerance),
        quadrics_(std::make_unique_for_overwrite<Quadric[]>(mesh.vertices.size())),
        own_(mesh.vertices.size(), 0.0),
        bound_(mesh.triangles.size(), 0.0),
        held_(mesh.triangles.size(), kNone),
        held_next_(mesh.vertices.size(), kNone),
        block_(mesh.vertices.size(), kNone),
        inner_(mesh.vertices.size(), 0),
        open_(mesh.vertices.size(), 1) {}

  void run();
  [[nodiscard]] SurfaceMesh left() const;

 private:
  static constexpr std::uint32_t kNone = TriangleLinks::kGone;
  // The next collapses of one block.
  struct Turn {
    double cost;
    std::uint32_t vertex;
    // The cheapest on top; among equals the vertex decides.
    bool operator<(const Turn& other) const {
      return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
  };
  // What may be taken away.
  struct Leaver {
    Quadric quadric;
    Vec3 at;
  };
  struct Target {
    double cost;
    std::size_t spoke;
  };
  // A vertex that a fan stands for, and the place of a triangle that is near it.
  struct Held {
    std::uint32_t vertex;
    std::uint32_t triangle;  // of the fan
    std::uint32_t place;     // of those that stay
    Vec3 seen;
  };
  // What a collapse leaves of a fan: the triangles that stay, by their place in the fan.
  struct Rest {
    std::size_t target = 0;
    double given_bound = 0.0;  // of the triangles before
    double bound = 0.0;
    bool is_proven = false;  // the bound is true
    std::vector<std::uint32_t> places{};
    std::vector<NearTriangle> triangles{};
    std::vector<Vec3> slopes{};  // of their heights, seen from above
    bool is_gathered = false;    // the points of this fan
    std::vector<Held> points{};
  };

  [[nodiscard]] const Vec3& point(std::uint32_t v) const { return numbers_.points[v]; }
  [[nodiscard]] bool is_feature(std::uint32_t v) const {
    return !mesh_.kinds.empty() && mesh_.kinds[numbers_.given[v]] == VertexKind::feature;
  }
  [[nodiscard]] Vec3 area_of(std::uint32_t t) const {
    const auto& [a, b, c] = links_.triangles[t];
    return (point(b) - point(a)).cross(point(c) - point(a));
  }
  void make_quadrics();
  [[nodiscard]] std::size_t work(std::span<const std::uint32_t> block, std::uint32_t number);
  void find_inner(std::span<const std::uint32_t> block, std::uint32_t number);
  [[nodiscard]] double cost(const Leaver& from, std::uint32_t to) const;
  [[nodiscard]] double least_cost(std::uint32_t vertex) const;
  [[nodiscard]] bool may_take(const VertexFan& fan, std::size_t spoke) const;
  [[nodiscard]] bool keeps_shape(const VertexFan& fan, std::size_t target) const;
  [[nodiscard]] bool is_held(const VertexFan& fan, Rest& rest) const;
  [[nodiscard]] bool is_near_given(const VertexFan& fan, const Rest& rest) const;
  [[nodiscard]] bool is_near_given(const Vec3& at, std::uint32_t start) const;
  void gather(const VertexFan& fan, Rest& rest) const;
  [[nodiscard]] bool is_legal(const VertexFan& fan, std::size_t target, Rest& rest) const;
  void collapse(const VertexFan& fan, const Rest& rest);

  const SurfaceMesh& mesh_;
  const NearNumbers numbers_;
  TriangleLinks given_{};
  TriangleLinks links_;
  double tolerance_;
  std::unique_ptr<Quadric[]> quadrics_;  // by vertex; filled on all cores
  std::vector<double> own_;              // by vertex: its quadric where it is
  // By triangle: it and what it stands for of the given mesh are nowhere farther apart.
  std::vector<double> bound_;
  std::vector<std::uint32_t> held_;  // by triangle: the first vertex taken away that is near it
  std::vector<std::uint32_t> held_next_;  // by vertex taken away: the next on the same triangle
  std::vector<std::uint32_t> block_;      // by vertex, in this round
  std::vector<std::uint8_t> inner_;       // by vertex: so are all around it
  // By vertex. 0: stays, unless what is around it changes; 1: has its turn; 2: that is out of date.
  std::vector<std::uint8_t> open_;
};

void Decimation::make_quadrics() {
  tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(own_.size()),
                    [&](std::uint32_t v) {
                      Quadric sum{};
                      links_.for_each_leaving(v, [&](std::uint32_t half) {
                        const Vec3 area = area_of(half / 3);
                        const double length = area.norm();
                        if (!(length > 0.0)) return;
                        const Vec3 normal = area / length;
                        sum.add_plane(normal, -normal.dot(point(v)), 0.5 * length);
                      });
                      quadrics_[v] = sum;
                      own_[v] = sum.at(point(v));
                    });
}

// Collapses within a block leave that as it is: a vertex gets no neighbours but those in its block,
// and keeps all others.
void Decimation::find_inner(std::span<const std::uint32_t> block, std::uint32_t number) {
  for (const std::uint32_t v : block) {
    bool inner = true;
    links_.for_each_leaving(
        v, [&](std::uint32_t half) { inner = inner && block_[links_.to(half)] == number; });
    inner_[v] = inner ? 1 : 0;
  }
}

inline double Decimation::cost(const Leaver& from, std::uint32_t to) const {
  const double share = kShortFirst * tolerance_;
  const Vec3& there = point(to);
  return from.quadric.at(there) + own_[to] + share * share * (there - from.at).squaredNorm();
}

double Decimation::least_cost(std::uint32_t vertex) const {
  const Leaver from{quadrics_[vertex], point(vertex)};
  double least = std::numeric_limits<double>::infinity();
  links_.for_each_leaving(
      vertex, [&](std::uint32_t half) { least = std::min(least, cost(from, links_.to(half))); });
  return least;
}

// Corners stay, and sharp edges are only shortened along themselves.
bool Decimation::may_take(const VertexFan& fan, std::size_t spoke) const {
  if (!is_feature(fan.vertex)) return true;
  if (!is_feature(fan.spoke[spoke])) return false;
  int sharp = 0;
  bool along = false;
  for (std::size_t i = 0; i < fan.size; ++i) {
    if (!is_feature(fan.spoke[i])) continue;
    const Vec3& left = fan.normal[i];
    const Vec3& right = fan.normal[i == 0 ? fan.size - 1 : i - 1];
    if (left.dot(right) > kSharpCosine * left.norm() * right.norm()) continue;
    ++sharp;
    along = along || i == spoke;
  }
  return along && sharp == 2;
}

bool Decimation::keeps_shape(const VertexFan& fan, std::size_t target) const {
  const Vec3& to = point(fan.spoke[target]);
  for (std::size_t i = fan.after(target); fan.after(i) != target; i = fan.after(i)) {
    const Vec3 a = point(fan.spoke[i]) - to;
    const Vec3 b = point(fan.spoke[fan.after(i)]) - to;
    const Vec3 normal = a.cross(b);
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    const double square = normal.squaredNorm();
    if (!(square > kNeedle * kNeedle * longest * longest)) return false;
    const double along = normal.dot(fan.normal[i]);
    if (!(along > 0.0 && along * along >= kMostTurnCosine * kMostTurnCosine * square *
                                              fan.normal[i].squaredNorm())) {
      return false;
    }
  }
  return true;
}

// Every vertex that the fan stands for is within its share of a triangle that stays.
bool Decimation::is_held(const VertexFan& fan, Rest& rest) const {
  constexpr auto kNowhere = static_cast<std::uint32_t>(-1);
  const double share = kVertexShare * tolerance_;
  const auto count = static_cast<std::uint32_t>(rest.places.size());
  for (std::size_t k = 0; k < rest.points.size(); ++k) {
    Held& held = rest.points[k];
    if (rest.is_proven) {
      held.place = fan.sector(rest.target, held.seen, held.triangle);
      const Vec3& from = fan.seen[rest.target];
      const Vec3& slope = rest.slopes[held.place];
      const double height = from.z() + slope.x() * (held.seen.x() - from.x()) +
                            slope.y() * (held.seen.y() - from.y());
      if (std::abs(held.seen.z() - height) <= share) continue;
    }
    std::uint32_t found = kNowhere;
    for (std::uint32_t i = 0; i < count && found == kNowhere; ++i) {
      if (rest.triangles[i].distance2(point(held.vertex)) <= share * share) found = i;
    }
    if (found == kNowhere) {
      // What does not fit here does not fit the next target either, as a rule.
      std::swap(rest.points[k], rest.points.front());
      return false;
    }
    held.place = found;
  }
  return true;
}

// From a vertex of the given mesh to the one next to the point, and what is around that.
bool Decimation::is_near_given(const Vec3& at, std::uint32_t start) const {
  const double most = tolerance_ * tolerance_;
  std::uint32_t here = start;
  double least = (point(here) - at).squaredNorm();
  for (bool moved = true; moved;) {
    moved = false;
    given_.for_each_leaving(here, [&, centre = here](std::uint32_t half) {
      const std::uint32_t to = given_.to(half);
      const double distance = (point(to) - at).squaredNorm();
      if (to == centre || distance >= least) return;
      least = distance;
      here = to;
      moved = true;
    });
  }
  if (least <= most) return true;
  bool found = false;
  given_.for_each_leaving(here, [&](std::uint32_t half) {
    if (found) return;
    const auto& [a, b, c] = given_.triangles[half / 3];
    found = NearTriangle(point(a), point(b), point(c)).distance2(at) <= most;
  });
  return found;
}

bool Decimation::is_near_given(const VertexFan& fan, const Rest& rest) const {
  const std::uint32_t to = fan.spoke[rest.target];
  for (std::uint32_t k = 0; k < rest.places.size(); ++k) {
    const std::size_t i = rest.places[k];
    const std::uint32_t a = fan.spoke[i];
    const std::uint32_t b = fan.spoke[fan.after(i)];
    const Vec3 centre = (point(to) + point(a) + point(b)) / 3.0;
    std::uint32_t start = to;
    double least = (point(to) - centre).squaredNorm();
    const auto offer = [&](std::uint32_t vertex) {
      const double distance = (point(vertex) - centre).squaredNorm();
      if (distance >= least) return;
      least = distance;
      start = vertex;
    };
    offer(a);
    offer(b);
    for (const Held& held : rest.points) {
      if (held.place == k) offer(held.vertex);
    }
    if (!is_near_given(centre, start)) return false;
  }
  return true;
}

// What the fan stands for, as it is seen from above.
void Decimation::gather(const VertexFan& fan, Rest& rest) const {
  rest.points.clear();
  rest.is_gathered = true;
  const Vec3& centre = point(fan.vertex);
  rest.points.push_back({fan.vertex, 0, 0, Vec3::Zero()});
  for (std::uint32_t i = 0; i < fan.size; ++i) {
    for (std::uint32_t v = held_[fan.half[i] / 3]; v != kNone; v = held_next_[v]) {
      const Vec3 arm = point(v) - centre;
      rest.points.push_back({v, i, 0, {arm.dot(fan.x), arm.dot(fan.y), arm.dot(fan.up)}});
    }
  }
}

bool Decimation::is_legal(const VertexFan& fan, std::size_t target, Rest& rest) const {
  if (!may_take(fan, target) || !keeps_shape(fan, target)) return false;
  if (fan.size + links_.valence(fan.spoke[target]) > VertexFan::kMostSpokes + 4 ||
      !links_.may_collapse(fan.half[target])) {
    return false;
  }
  rest.target = target;
  const double apart = fan.departure(target);
  rest.bound = rest.given_bound + apart;
  rest.is_proven = std::isfinite(apart);
  rest.places.clear();
  for (std::size_t i = fan.after(target); fan.after(i) != target; i = fan.after(i)) {
    rest.places.push_back(static_cast<std::uint32_t>(i));
  }
  if (!rest.is_gathered) gather(fan, rest);
  if (rest.bound <= kVertexShare * tolerance_) {
    for (Held& held : rest.points) held.place = fan.sector(target, held.seen, held.triangle);
    return true;
  }
  rest.triangles.clear();
  rest.slopes.clear();
  const Vec3& to = fan.seen[target];
  for (const std::uint32_t i : rest.places) {
    rest.triangles.emplace_back(point(fan.spoke[target]), point(fan.spoke[i]),
                                point(fan.spoke[fan.after(i)]));
    const Vec3 normal = (fan.seen[i] - to).cross(fan.seen[fan.after(i)] - to);
    rest.slopes.emplace_back(-normal.x() / normal.z(), -normal.y() / normal.z(), 0.0);
  }
  return is_held(fan, rest) && is_near_given(fan, rest);
}

void Decimation::collapse(const VertexFan& fan, const Rest& rest) {
  const std::uint32_t to = fan.spoke[rest.target];
  for (std::size_t i = 0; i < fan.size; ++i) held_[fan.half[i] / 3] = kNone;
  for (const Held& held : rest.points) {
    const std::uint32_t triangle = fan.half[rest.places[held.place]] / 3;
    held_next_[held.vertex] = held_[triangle];
    held_[triangle] = held.vertex;
  }
  for (const std::uint32_t i : rest.places) bound_[fan.half[i] / 3] = rest.bound;
  links_.collapse(fan.half[rest.target]);
  quadrics_[to].add(quadrics_[fan.vertex]);
  own_[to] = quadrics_[to].at(point(to));
}

// Collapses within a block, cheapest first; how many.
std::size_t Decimation::work(std::span<const std::uint32_t> block, std::uint32_t number) {
  find_inner(block, number);
  std::vector<Turn> turns;
  for (const std::uint32_t v : block) {
    if (open_[v] != 0 && inner_[v] != 0) turns.push_back({least_cost(v), v});
  }
  std::make_heap(turns.begin(), turns.end());
  const auto most = static_cast<std::size_t>(
      (1.0 - kLeftByRound) * static_cast<double>(std::max<std::size_t>(block.size(), 64)));
  VertexFan fan;
  Rest rest;
  std::array<Target, VertexFan::kMostSpokes> targets;
  std::size_t done = 0;
  while (!turns.empty() && done < most) {
    const Turn turn = turns.front();
    std::pop_heap(turns.begin(), turns.end());
    turns.pop_back();
    if (links_.leaving[turn.vertex] == kNone || open_[turn.vertex] == 0) continue;
    if (open_[turn.vertex] == 2) {
      open_[turn.vertex] = 1;
      const double now = least_cost(turn.vertex);
      if (!turns.empty() && now > turns.front().cost) {
        turns.push_back({now, turn.vertex});
        std::push_heap(turns.begin(), turns.end());
        continue;
      }
    }
    open_[turn.vertex] = 0;
    if (!fan.look(numbers_.points, links_, turn.vertex)) continue;
    double bound = 0.0;
    for (std::size_t i = 0; i < fan.size; ++i) bound = std::max(bound, bound_[fan.half[i] / 3]);
    rest.given_bound = bound;
    const Leaver from{quadrics_[fan.vertex], point(fan.vertex)};
    for (std::size_t i = 0; i < fan.size; ++i) targets[i] = {cost(from, fan.spoke[i]), i};
    std::sort(targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(fan.size),
              [](const Target& a, const Target& b) {
                return a.cost != b.cost ? a.cost < b.cost : a.spoke < b.spoke;
              });
    rest.is_gathered = false;
    for (std::size_t k = 0; k < fan.size; ++k) {
      if (!is_legal(fan, targets[k].spoke, rest)) continue;
      collapse(fan, rest);
      ++done;
      for (std::size_t i = 0; i < fan.size; ++i) {
        const std::uint32_t v = fan.spoke[i];
        const bool waits = open_[v] != 0;
        open_[v] = 2;
        if (waits || inner_[v] == 0) continue;
        turns.push_back({least_cost(v), v});
        std::push_heap(turns.begin(), turns.end());
        open_[v] = 1;
      }
      break;
    }
  }
  return done;
}

void Decimation::run() {
  tbb::parallel_invoke([&] { given_ = links_; }, [&] { make_quadrics(); });
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < numbers_.points.size(); ++v) {
    if (links_.leaving[v] != kNone) order.push_back(v);
  }
  int idle = 0;
  for (int round = 0; round < kMostBlockRounds && idle < 2; ++round) {
    const std::vector<SurfaceBlock> blocks = surface_blocks(numbers_.points, order, round);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
      for (std::size_t k = blocks[b].first; k < blocks[b].last; ++k) {
        block_[order[k]] = static_cast<std::uint32_t>(b);
      }
    });
    std::vector<std::size_t> done(blocks.size(), 0);
    tbb::parallel_for(
        std::size_t{0}, blocks.size(),
        [&](std::size_t b) {
          const std::span all(order);
          done[b] = work(all.subspan(blocks[b].first, blocks[b].last - blocks[b].first),
                         static_cast<std::uint32_t>(b));
        },
        tbb::simple_partitioner());
    const std::size_t taken = std::accumulate(done.begin(), done.end(), std::size_t{0});
    // What a hundredth would still gain is not worth a round.
    idle = 100 * taken < order.size() ? idle + 1 : 0;
    std::erase_if(order, [&](std::uint32_t v) { return links_.leaving[v] == kNone; });
  }
}

SurfaceMesh Decimation::left() const {
  SurfaceMesh left;
  std::vector<std::uint32_t> number(mesh_.vertices.size(), kNone);  // by what it was here
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    if (links_.leaving[numbers_.near[v]] == kNone) continue;
    number[numbers_.near[v]] = static_cast<std::uint32_t>(left.vertices.size());
    left.vertices.push_back(mesh_.vertices[v]);
    if (!mesh_.normals.empty()) left.normals.push_back(mesh_.normals[v]);
    if (!mesh_.kinds.empty()) left.kinds.push_back(mesh_.kinds[v]);
    if (!mesh_.deviation.empty()) left.deviation.push_back(mesh_.deviation[v]);
  }
  for (std::uint32_t t = 0; t < links_.triangles.size(); ++t) {
    if (links_.is_gone(t)) continue;
    const auto& [a, b, c] = links_.triangles[t];
    left.triangles.push_back({number[a], number[b], number[c]});
  }
  return left;
}

}  // namespace

Result<SurfaceMesh> decimate_surface(const SurfaceMesh& mesh, Mm tolerance) {
  if (!std::isfinite(tolerance.value) || tolerance.value <= 0.0) {
    return error("mesh-tolerance"_id,
                 fmt::format("the decimation tolerance is {} mm", tolerance.value),
                 "it must be a finite number above 0");
  }
  NearNumbers numbers = near_numbers(mesh);
  auto links = linked(std::move(numbers.triangles), mesh.vertices.size());
  if (!links) {
    const bool is_closed = measure(mesh).is_closed;
    return error(
        "mesh-open"_id,
        fmt::format("the mesh to be decimated is {}", is_closed ? "not manifold" : "not closed"),
        "only closed surfaces without self-contact are decimated");
  }
  Decimation decimation(mesh, std::move(numbers), *std::move(links), tolerance.value);
  decimation.run();
  return decimation.left();
}

}  // namespace frustum::stock
