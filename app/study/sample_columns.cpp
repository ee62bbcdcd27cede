#include "app/study/sample_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/whole_file.hpp"
#include "report/csv_field.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using studies::kDrawsPerPart;
using studies::SampleBlock;

bool is_table_column(const std::string& name) {
  for (const char* kept : {"characteristics/", "amounts/", "phases/", "peaks/", "coefficients/"}) {
    if (name.starts_with(kept)) return true;
  }
  return false;
}

Diagnostic not_whole(const fs::path& file) {
  Diagnostic failure = error("samples-missing"_id, "these samples are missing or not whole",
                             "run the study again with --resume");
  failure.file = file.string();
  return failure;
}

Result<SampleBlock> part_of(const studies::SampleFolder& folder, std::uint64_t part,
                            std::uint64_t samples, const WantedColumn& wanted) {
  const fs::path file = folder.part_file(part);
  const auto bytes = read_to_replace(file);  // a study goes on with its samples
  if (!bytes) return bytes.error();
  auto read = studies::decoded(*bytes, file.string(), wanted);
  if (!read) return read.error();
  const std::uint64_t first = part * kDrawsPerPart;
  const std::uint64_t count = std::min(samples - first, kDrawsPerPart);
  if (read->mark != folder.mark() || read->block.count < count) return not_whole(file);
  return read->block.count > count ? studies::until(read->block, samples) : std::move(read->block);
}

template <typename Each>
Result<std::uint64_t> for_each_part(const studies::SampleFolder& folder, std::uint64_t samples,
                                    const WantedColumn& wanted, Each&& each) {
  for (std::uint64_t part = 0; part * kDrawsPerPart < samples; ++part) {
    auto block = part_of(folder, part, samples, wanted);
    if (!block) return block.error();
    each(*std::move(block));
  }
  return samples;
}

}  // namespace

const std::vector<double>* SampleColumns::find(const std::string& name) const {
  const auto found = std::ranges::find(columns, name, &studies::SampleColumn::name);
  return found == columns.end() ? nullptr : &found->values;
}

Result<SampleColumns> read_columns(const studies::SampleFolder& folder, std::uint64_t samples,
                                   const WantedColumn& wanted) {
  SampleColumns all;
  const auto read = for_each_part(folder, samples, wanted, [&](SampleBlock block) {
    all.draws.insert(all.draws.end(), block.draws.begin(), block.draws.end());
    std::ranges::move(block.failed, std::back_inserter(all.failed));
    if (block.draws.empty()) return;
    if (all.columns.empty()) {
      all.columns = std::move(block.columns);
      for (auto& column : all.columns) column.values.reserve(samples);
      return;
    }
    for (std::size_t c = 0; c < std::min(all.columns.size(), block.columns.size()); ++c) {
      const std::vector<double>& more = block.columns[c].values;
      all.columns[c].values.insert(all.columns[c].values.end(), more.begin(), more.end());
    }
  });
  if (!read) return read.error();
  return all;
}

Result<std::uint64_t> write_samples_csv(const studies::SampleFolder& folder, std::uint64_t samples,
                                        const fs::path& file) {
  if (auto problem = unwritable(file)) return *problem;
  // Beside the file and renamed over it once it is whole; a device is written to as it is.
  std::error_code unknown;
  const bool is_device = fs::exists(file, unknown) && !fs::is_regular_file(file, unknown);
  const fs::path beside = is_device ? file : fs::path(file.string() + ".part");
  std::ofstream out(beside, std::ios::binary | std::ios::trunc);
  bool has_head = false;
  std::string text;
  const auto read = for_each_part(folder, samples, is_table_column, [&](const SampleBlock& block) {
    if (!has_head && !block.draws.empty()) {
      text = "draw";
      for (const auto& column : block.columns) text += "," + report::csv_field(column.name);
      text += "\n";
      has_head = true;
    }
    for (std::size_t row = 0; row < block.draws.size(); ++row) {
      fmt::format_to(std::back_inserter(text), "{}", block.draws[row]);
      for (const auto& column : block.columns) {
        fmt::format_to(std::back_inserter(text), ",{}", column.values[row]);
      }
      text += '\n';
    }
    out << text;
    text.clear();
  });
  out.close();
  std::error_code failure;
  if (read && out.good() && !is_device) fs::rename(beside, file, failure);
  if (!read || !out.good() || failure) {
    if (!is_device) fs::remove(beside, unknown);
    if (!read) return read.error();
    return cannot_write(file, failure ? failure.message() : "no space, or a fault of the disk");
  }
  return samples;
}

}  // namespace frustum::app
