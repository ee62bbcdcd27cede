#include "stock/mesh/surface_sequence.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "stock/mesh/surface_mesh_placing.hpp"

namespace frustum::stock {
namespace {

// Rays are asked a little beyond the blank (1e-3 mm, Workpiece); this is more.
constexpr double kBeyond = 2e-3;  // mm

std::vector<Box> swept_boxes(const cutter::SweptCutter& swept, std::uint32_t from,
                             std::uint32_t until) {
  std::vector<Box> boxes;
  boxes.reserve(until - from);
  for (std::uint32_t segment = from; segment < until; ++segment) {
    const Box box = swept.box(segment);
    boxes.push_back({box.min - Vec3::Constant(kBeyond), box.max + Vec3::Constant(kBeyond)});
  }
  return boxes;
}

}  // namespace

struct SurfaceSequence::Stages {
  std::uint32_t segments = 0;  // have cut
  TriDexel dexels;
  Crossings crossings;
  Cells cells;
  PlacedVertices placed;
};

SurfaceSequence::SurfaceSequence(const Workpiece& workpiece, Mm pitch)
    : workpiece_(&workpiece), pitch_(pitch) {}
SurfaceSequence::~SurfaceSequence() = default;
SurfaceSequence::SurfaceSequence(SurfaceSequence&&) noexcept = default;
SurfaceSequence& SurfaceSequence::operator=(SurfaceSequence&&) noexcept = default;

Result<SurfaceMesh> SurfaceSequence::at(const ProgramState& state) {
  const WorkpieceAt part(*workpiece_, state);
  const bool follows = last_ != nullptr && last_->segments <= state.segments;
  std::optional<ReachedRays> reached;
  std::optional<TriDexel> dexels;
  Crossings::Known crossings_before;
  KnownVertices before;
  if (follows) {
    reached.emplace(last_->dexels.grid(),
                    swept_boxes(workpiece_->removed(), last_->segments, state.segments));
    dexels = last_->dexels.sampled_again(part, *reached);
    crossings_before = {&last_->crossings, &last_->dexels};
    before = {&last_->cells, &last_->placed, &*reached};
  } else {
    last_.reset();
    auto sampled = TriDexel::sample(part, workpiece_->blank().bounds(), pitch_);
    if (!sampled) return std::move(sampled).error();
    dexels = *std::move(sampled);
  }
  Crossings crossings(part, *dexels, crossings_before);
  Cells cells(crossings);
  PlacedVertices placed = place_vertices(part, crossings, cells, before);
  work_ = {placed.points.size(), placed.points.size() - placed.kept()};
  SurfaceMesh mesh = surface_of(part, crossings, cells, placed);
  last_ = std::make_unique<const Stages>(Stages{state.segments, *std::move(dexels),
                                                std::move(crossings), std::move(cells),
                                                std::move(placed)});
  return mesh;
}

}  // namespace frustum::stock
