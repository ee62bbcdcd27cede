#include "studies/samples/sample_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/sha256.hpp"
#include "studies/samples/hdf5_image.hpp"

namespace frustum::studies {
namespace {

constexpr std::string_view kPass = "pass/";
constexpr const char* kDraw = "draw";
constexpr const char* kPoints = "points";
constexpr const char* kFailedSample = "failed/draw";
constexpr const char* kFailedMessage = "failed/message";

// After the bytes of the file, where readers of HDF5 do not look: the SHA-256 of all before it. The
// library itself must not be given a file that is not whole: it ends the program at some of them.
constexpr std::string_view kSealed = "\nfrustum sha256 ";
constexpr std::size_t kSealLength = kSealed.size() + 64;

std::string seal_of(std::string_view bytes) { return std::string(kSealed) + sha256(bytes); }

Diagnostic no_samples(const std::string& name, const std::string& why) {
  Diagnostic failure = error("samples"_id, "no samples of a study: " + why,
                             "remove the file; its draws are computed again");
  failure.file = name;
  return failure;
}

}  // namespace

Result<std::string> encoded(const SampleFile& file) {
  const SampleBlock& block = file.block;
  Hdf5Writer writer;
  writer.attribute("frustum.study", file.mark.study);
  writer.attribute("seed", file.mark.seed);
  writer.attribute("first_draw", block.first_draw);
  writer.attribute("count", block.count);
  writer.write(kDraw, block.draws);
  for (const SampleColumn& c : block.columns) writer.write(c.name, c.values, c.unit);
  for (const PassColumn& c : block.passes) writer.write(c.name, c.values);
  if (block.points > 0) writer.write(kPoints, block.deviations, "um", block.points);
  std::vector<std::int64_t> failed;
  std::vector<std::string> messages;
  for (const FailedSample& f : block.failed) {
    failed.push_back(static_cast<std::int64_t>(f.draw));
    messages.push_back(f.message);
  }
  writer.write(kFailedSample, failed);
  writer.write(kFailedMessage, messages);
  return writer.bytes().transform([](std::string bytes) { return bytes + seal_of(bytes); });
}

namespace {

Result<Hdf5Reader> open(std::string_view bytes, const std::string& name) {
  const std::size_t length = bytes.size() - std::min(bytes.size(), kSealLength);
  if (bytes.substr(length) != seal_of(bytes.substr(0, length))) {
    return no_samples(name, "it is not whole, or was changed after it had been written");
  }
  auto reader = Hdf5Reader::open(bytes.substr(0, length));
  if (!reader) return no_samples(name, "it is no HDF5 file");
  return *std::move(reader);
}

Result<SampleRange> read_range(const Hdf5Reader& reader, const std::string& name) {
  const auto study = reader.text_attribute("frustum.study");
  const auto seed = reader.number_attribute("seed");
  const auto first = reader.number_attribute("first_draw");
  const auto count = reader.number_attribute("count");
  if (!study || !seed || !first || !count) {
    return no_samples(name, "frustum.study, seed, first_draw or count is missing");
  }
  return SampleRange{{*study, *seed}, *first, *count};
}

}  // namespace

Result<SampleRange> range_of(std::string_view bytes, const std::string& name) {
  const auto reader = open(bytes, name);
  if (!reader) return reader.error();
  return read_range(*reader, name);
}

Result<SampleFile> decoded(std::string_view bytes, const std::string& name,
                           const std::function<bool(const std::string&)>& wanted) {
  const auto reader = open(bytes, name);
  if (!reader) return reader.error();
  const auto range = read_range(*reader, name);
  if (!range) return range.error();
  SampleFile file{.mark = range->mark};
  SampleBlock& block = file.block;
  block.first_draw = range->first_draw;
  block.count = range->count;
  std::vector<std::int64_t> failed;
  std::vector<std::string> messages;
  const auto take = [](auto& target, auto&& read) {
    if (read) target = *std::move(read);
    return !target.empty();
  };
  for (const std::string& dataset : reader->datasets()) {
    const bool always = dataset == kDraw || dataset == kFailedSample || dataset == kFailedMessage;
    if (!always && !wanted(dataset)) continue;
    bool whole = false;
    if (dataset == kDraw) {
      whole = take(block.draws, reader->whole_numbers(dataset));
    } else if (dataset == kFailedSample) {
      whole = take(failed, reader->whole_numbers(dataset));
    } else if (dataset == kFailedMessage) {
      whole = take(messages, reader->texts(dataset));
    } else if (dataset == kPoints) {
      block.points = reader->columns(dataset);
      whole = take(block.deviations, reader->reals(dataset));
    } else if (dataset.starts_with(kPass)) {
      block.passes.push_back({dataset, {}});
      whole = take(block.passes.back().values, reader->flags(dataset));
    } else {
      block.columns.push_back({dataset, reader->unit(dataset), {}});
      whole = take(block.columns.back().values, reader->reals(dataset));
    }
    if (!whole) return no_samples(name, fmt::format("the dataset '{}' cannot be read", dataset));
  }
  if (failed.size() != messages.size()) return no_samples(name, "failed draws without messages");
  for (std::size_t i = 0; i < failed.size(); ++i) {
    block.failed.push_back({static_cast<std::uint64_t>(failed[i]), std::move(messages[i])});
  }
  const auto as_long = [&](const auto& column) {
    return column.values.size() == block.draws.size();
  };
  if (!std::ranges::all_of(block.columns, as_long) || !std::ranges::all_of(block.passes, as_long) ||
      block.deviations.size() != block.points * block.draws.size() ||
      block.draws.size() + block.failed.size() != block.count) {
    return no_samples(name, "datasets of different lengths");
  }
  return file;
}

}  // namespace frustum::studies
