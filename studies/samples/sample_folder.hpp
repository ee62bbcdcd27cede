// The samples of a study on disk: samples/part-000000.h5 and so on, each of 65,536 draws.
//
// A part is written whole and synced under a temporary name and then renamed, so that a kill loses
// the draws of a part and never a file. Of draws that take long, pieces of a part are kept beside
// it until the part is whole. What is kept of an earlier run is of the same study, and whole by its
// checksum; everything else is computed again.
// Units  : none
// Errors : samples of another study, with both fingerprints; a folder or a disk that cannot be
//          written to; merged parts that leave a gap
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "studies/samples/sample_file.hpp"

namespace frustum::studies {

class SampleFolder {
 public:
  // `folder` is that of the study: the samples are in `samples` below it. With `keep` its samples
  // are continued, and must be of this study; without, they are removed.
  [[nodiscard]] static Result<SampleFolder> open(const std::filesystem::path& folder,
                                                 SampleMark mark, bool keep);
  // As others of the same run see it that has been opened before.
  [[nodiscard]] static SampleFolder opened(const std::filesystem::path& folder, SampleMark mark);

  // What there is of a part from its first draw on: the part, or its pieces without a gap. None
  // where nothing is whole.
  [[nodiscard]] std::optional<SampleBlock> read(std::uint64_t part) const;
  // Draws of the part that is on disk; 0 where there is none or one that is not whole.
  [[nodiscard]] std::uint64_t draws_of(std::uint64_t part) const;
  // The part that begins with the block's first draw; its pieces are removed.
  [[nodiscard]] Result<std::filesystem::path> write(const SampleBlock& block) const;
  // A piece of a part that is not whole yet. It is not synced: it spares work, nothing rests on it.
  [[nodiscard]] Result<std::filesystem::path> write_piece(const SampleBlock& block) const;
  // Removes the parts that hold nothing before `samples`, and shortens the last one to it.
  [[nodiscard]] Result<std::uint64_t> end_at(std::uint64_t samples) const;

  // Copies the parts of these folders of studies, each part from the first that has it; returns how
  // many draws there are then.
  [[nodiscard]] Result<std::uint64_t> merge(std::span<const std::filesystem::path> folders) const;

  [[nodiscard]] std::filesystem::path part_file(std::uint64_t part) const;
  [[nodiscard]] const SampleMark& mark() const { return mark_; }

 private:
  SampleFolder(std::filesystem::path samples, SampleMark mark)
      : samples_(std::move(samples)), mark_(std::move(mark)) {}
  [[nodiscard]] std::filesystem::path piece_file(std::uint64_t first_draw) const;
  [[nodiscard]] std::vector<std::filesystem::path> pieces_of(std::uint64_t part) const;

  std::filesystem::path samples_;
  SampleMark mark_;
};

}  // namespace frustum::studies
