#include "studies/samples/sample_folder.hpp"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <string>
#include <system_error>
#include <utility>

#include "core/whole_file.hpp"

namespace frustum::studies {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = "part-";
constexpr std::string_view kPiece = "piece-";
constexpr std::string_view kEnding = ".h5";

// The number in "part-000012.h5"; nothing for other names.
std::optional<std::uint64_t> number_in(const std::string& name, std::string_view beginning) {
  if (!name.starts_with(beginning) || !name.ends_with(kEnding)) return std::nullopt;
  const char* const from = name.data() + beginning.size();
  const char* const to = name.data() + name.size() - kEnding.size();
  std::uint64_t number = 0;
  const auto read = std::from_chars(from, to, number);
  if (read.ec != std::errc{} || read.ptr != to) return std::nullopt;
  return number;
}

std::map<std::uint64_t, fs::path> files_of(const fs::path& samples, std::string_view beginning) {
  std::map<std::uint64_t, fs::path> files;
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(samples, unknown)) {
    if (const auto number = number_in(entry.path().filename().string(), beginning)) {
      files.emplace(*number, entry.path());
    }
  }
  return files;
}

// What a write that was killed has left; others' files are no concern of ours.
bool is_left_over(const std::string& name) {
  const bool ours = name.starts_with(kPart) || name.starts_with(kPiece);
  return ours && name.find(std::string(kEnding) + ".part") != std::string::npos;
}

Diagnostic no_folder(const fs::path& folder, const std::string& why) {
  Diagnostic failure = error("file-unwritable"_id, "the samples cannot be written: " + why,
                             "name a folder that you may make or write to");
  failure.file = folder.string();
  return failure;
}

Diagnostic another_study(const fs::path& file, const SampleMark& own, const SampleMark& its) {
  Diagnostic failure = error(
      "another-study"_id,
      fmt::format("the samples are of another study: it has the fingerprint {:.12}... and seed {}, "
                  "this one {:.12}... and {}",
                  its.study, its.seed, own.study, own.seed),
      "give the study as it was then, or another --out");
  failure.file = file.string();
  return failure;
}

std::optional<SampleBlock> block_in(const fs::path& file, const SampleMark& mark) {
  const auto bytes = read_to_replace(file);
  if (!bytes) return std::nullopt;
  auto samples = decoded(*bytes, file.string());
  if (!samples || samples->mark != mark) return std::nullopt;
  return std::move(samples->block);
}

}  // namespace

SampleFolder SampleFolder::opened(const fs::path& folder, SampleMark mark) {
  return {folder / "samples", std::move(mark)};
}

Result<SampleFolder> SampleFolder::open(const fs::path& folder, SampleMark mark, bool keep) {
  SampleFolder opened_folder = opened(folder, std::move(mark));
  const fs::path& samples = opened_folder.samples_;
  std::error_code failure;
  fs::create_directories(samples, failure);
  if (failure) return no_folder(samples, failure.message());
  std::vector<fs::path> removed;
  for (const auto& entry : fs::directory_iterator(samples, failure)) {
    const std::string name = entry.path().filename().string();
    const bool is_part = number_in(name, kPart) || number_in(name, kPiece);
    if (is_left_over(name) || (is_part && !keep)) removed.push_back(entry.path());
    if (!is_part || !keep) continue;
    const auto bytes = read_to_replace(entry.path());
    const auto range =
        bytes ? range_of(*bytes, entry.path().string()) : Result<SampleRange>(bytes.error());
    if (range && range->mark != opened_folder.mark_) {
      return another_study(entry.path(), opened_folder.mark_, range->mark);
    }
    if (!range) removed.push_back(entry.path());  // not whole: its draws are computed again
  }
  for (const fs::path& file : removed) {
    fs::remove(file, failure);
    if (failure) return no_folder(file, failure.message());
  }
  return opened_folder;
}

fs::path SampleFolder::part_file(std::uint64_t part) const {
  return samples_ / fmt::format("{}{:06}{}", kPart, part, kEnding);
}
fs::path SampleFolder::piece_file(std::uint64_t first_draw) const {
  return samples_ / fmt::format("{}{:012}{}", kPiece, first_draw, kEnding);
}

std::vector<fs::path> SampleFolder::pieces_of(std::uint64_t part) const {
  std::vector<fs::path> pieces;
  for (const auto& [first, file] : files_of(samples_, kPiece)) {
    if (first / kDrawsPerPart == part) pieces.push_back(file);
  }
  return pieces;
}

std::optional<SampleBlock> SampleFolder::read(std::uint64_t part) const {
  std::error_code unknown;
  std::optional<SampleBlock> whole;
  if (fs::is_regular_file(part_file(part), unknown)) whole = block_in(part_file(part), mark_);
  for (const fs::path& file : pieces_of(part)) {
    const auto piece = block_in(file, mark_);
    const std::uint64_t next = whole ? whole->first_draw + whole->count : part * kDrawsPerPart;
    if (!piece || piece->first_draw > next) break;
    if (piece->first_draw < next) continue;  // it is in the part already
    if (whole) {
      append(*whole, *piece);
    } else {
      whole = *piece;
    }
  }
  return whole;
}

std::uint64_t SampleFolder::draws_of(std::uint64_t part) const {
  std::error_code unknown;
  if (!fs::is_regular_file(part_file(part), unknown)) return 0;
  const auto block = block_in(part_file(part), mark_);
  return block ? block->count : 0;
}

Result<fs::path> SampleFolder::write(const SampleBlock& block) const {
  const std::uint64_t part = block.first_draw / kDrawsPerPart;
  const auto bytes = encoded({mark_, block});
  if (!bytes) return bytes.error();
  auto written = write_synced_file(part_file(part), *bytes);
  if (!written) return written;
  for (const fs::path& piece : pieces_of(part)) {
    std::error_code failure;
    fs::remove(piece, failure);
    if (failure) return no_folder(piece, failure.message());
  }
  return written;
}

Result<fs::path> SampleFolder::write_piece(const SampleBlock& block) const {
  const auto bytes = encoded({mark_, block});
  if (!bytes) return bytes.error();
  return write_whole_file(piece_file(block.first_draw), *bytes);
}

Result<std::uint64_t> SampleFolder::end_at(std::uint64_t samples) const {
  for (const auto& [part, file] : files_of(samples_, kPart)) {
    std::error_code failure;
    if (part * kDrawsPerPart >= samples) {
      fs::remove(file, failure);
      if (failure) return no_folder(file, failure.message());
      continue;
    }
    const bool is_last = samples < (part + 1) * kDrawsPerPart;
    auto block = is_last ? block_in(file, mark_) : std::nullopt;
    if (!block || block->first_draw + block->count <= samples) continue;
    const auto written = write(until(*block, samples));
    if (!written) return written.error();
  }
  return samples;
}

Result<std::uint64_t> SampleFolder::merge(std::span<const fs::path> folders) const {
  std::map<std::uint64_t, fs::path> found;
  for (const fs::path& folder : folders) {
    const auto files = files_of(folder / "samples", kPart);
    std::error_code problem;
    // A part of few draws has none: draws are shared out by whole files.
    if (!fs::is_directory(folder / "samples", problem)) {
      Diagnostic failure = error("samples"_id, "there are no samples in this folder",
                                 "name the --out of the study's parts");
      failure.file = folder.string();
      return failure;
    }
    found.insert(files.begin(), files.end());
  }
  std::uint64_t draws = 0;
  for (const auto& [part, file] : found) {
    const auto bytes = read_to_replace(file);
    if (!bytes) return bytes.error();
    const auto range = range_of(*bytes, file.string());
    if (!range) return range.error();
    if (range->mark != mark_) return another_study(file, mark_, range->mark);
    if (range->first_draw != draws || part * kDrawsPerPart != draws) {
      Diagnostic failure =
          error("samples-missing"_id,
                fmt::format("draw {} is missing: the next samples begin with draw {}", draws,
                            range->first_draw),
                "merge the folders of all parts, each run to its end");
      failure.file = file.string();
      return failure;
    }
    draws += range->count;
    std::error_code same;
    if (fs::equivalent(file, part_file(part), same)) continue;
    const auto copied = write_synced_file(part_file(part), *bytes);
    if (!copied) return copied.error();
  }
  return draws;
}

}  // namespace frustum::studies
