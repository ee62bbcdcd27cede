// Draws machines and has them evaluated: the columns of a study's samples.
//
// Units  : those of the columns: um, urad; phases deg
// Shape  : a block of consecutive draws; the same for any blocks
// Errors : a scheme with too many dimensions
#pragma once

#include <cstdint>
#include <vector>

#include "app/study/study_model.hpp"
#include "core/result.hpp"
#include "studies/engine/engine_controls.hpp"
#include "studies/laws/scheme.hpp"
#include "studies/samples/sample_block.hpp"

namespace frustum::app {

// Names of columns.
inline constexpr const char* kCharacteristics = "characteristics/";
inline constexpr const char* kPasses = "pass/";
inline constexpr const char* kLargestMove = "controls/largest_move";  // of the linear engine

class Sampler {
 public:
  // Both outlive it. `engine`: linear or full.
  [[nodiscard]] static Result<Sampler> make(const StudyFile& study, const StudyModel& model,
                                            studies::EngineKind engine);

  [[nodiscard]] studies::SampleBlock sample(std::uint64_t first, std::uint64_t count) const;
  // Draws that are worth one call.
  [[nodiscard]] std::uint64_t step() const;
  [[nodiscard]] std::vector<DrawnMachine> machines(std::uint64_t first, std::uint64_t count) const;
  [[nodiscard]] const studies::Scheme& scheme() const { return scheme_; }

 private:
  Sampler(const StudyFile& study, const StudyModel& model, studies::EngineKind engine,
          studies::Scheme scheme)
      : study_(&study), model_(&model), engine_(engine), scheme_(std::move(scheme)) {}
  void add_columns(studies::SampleBlock& block) const;
  void add_amounts(const std::vector<DrawnMachine>& drawn, studies::SampleBlock& block) const;
  void add_passes(studies::SampleBlock& block) const;
  [[nodiscard]] studies::SampleBlock in_lanes(const studies::LinearEngine& engine,
                                              std::uint64_t first, std::uint64_t count) const;

  const StudyFile* study_;
  const StudyModel* model_;
  studies::EngineKind engine_;
  studies::Scheme scheme_;
};

[[nodiscard]] Result<studies::Scheme> scheme_of(const StudyFile& study, const StudyModel& model);

}  // namespace frustum::app
