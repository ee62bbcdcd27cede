#include "lint/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/whole_file.hpp"
#include "lint/fingerprints.hpp"

namespace frustum::lint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kVersion = "frustum_baseline";

fs::path folder_of(const fs::path& file) {
  return fs::absolute(file).lexically_normal().parent_path();
}
std::string name_in(const fs::path& folder, const std::string& file) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder);
  return (relative.empty() ? whole : relative).generic_string();
}

Diagnostic no_baseline(const fs::path& file, std::string message) {
  Diagnostic diagnostic =
      error("baseline-unreadable"_id, std::move(message), "write it anew by --write-baseline");
  diagnostic.file = file.string();
  return diagnostic;
}

bool has_text(const Json& entry, const char* key) {
  return entry.is_object() && entry.contains(key) && entry[key].is_string();
}

}  // namespace

Result<Baseline> Baseline::read(const fs::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("findings") || !json["findings"].is_array()) {
    return no_baseline(file, "this is not a baseline of findings");
  }
  if (!json.contains(kVersion) || json[kVersion] != 1) {
    return no_baseline(file, fmt::format("{} is not 1, which this version reads", kVersion));
  }
  Baseline baseline;
  baseline.folder_ = folder_of(file);
  for (const Json& entry : json["findings"]) {
    if (!has_text(entry, "file") || !has_text(entry, "id") || !has_text(entry, "fingerprint")) {
      return no_baseline(file, "a finding has no file, id or fingerprint");
    }
    const Json count = entry.value("count", Json(1U));
    if (!count.is_number_unsigned()) {
      return no_baseline(file, "the count of a finding is no whole number");
    }
    // Those of the first versions were numbered: "1a2b3c4d5e6f7081:2".
    const std::string mark = entry["fingerprint"];
    baseline.known_[{entry["file"], entry["id"], mark.substr(0, mark.find(':'))}] +=
        count.get<std::uint64_t>();
  }
  return baseline;
}

std::vector<Baseline::Entry> Baseline::entries_of(const CheckedFile& checked,
                                                  const fs::path& folder) {
  std::vector<Entry> entries;
  for (const Finding& finding : checked.report.findings) {
    entries.emplace_back(name_in(folder, finding.file), info_of(finding.check).id,
                         fingerprint_of(finding, checked.lines));
  }
  return entries;
}

std::string Baseline::text_of(std::span<const CheckedFile* const> checked, const fs::path& file) {
  const fs::path folder = folder_of(file);
  Counts most;
  for (const CheckedFile* each : checked) {
    Counts counts;
    const auto entries = entries_of(*each, folder);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Finding& finding = each->report.findings[i];
      if (finding.suppressed != Suppressed::by_comment) counts[entries[i]] += finding.places;
    }
    for (const auto& [entry, count] : counts) most[entry] = std::max(most[entry], count);
  }
  Json findings = Json::array();
  for (const CheckedFile* each : checked) {
    const auto entries = entries_of(*each, folder);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Finding& finding = each->report.findings[i];
      const auto count = most.find(entries[i]);
      if (finding.suppressed == Suppressed::by_comment || count == most.end()) continue;
      const auto& [name, id, mark] = entries[i];
      findings.push_back({{"file", name},
                          {"id", id},
                          {"fingerprint", mark},
                          {"count", count->second},
                          {"line", finding.line},
                          {"message", finding.message}});
      most.erase(count);  // written once, at the first
    }
  }
  const Json json{{kVersion, 1}, {"findings", findings}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Baseline::apply(CheckedFile& checked) {
  files_.insert(name_in(folder_, checked.file));
  Counts counts;
  const auto entries = entries_of(checked, folder_);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Finding& finding = checked.report.findings[i];
    const auto known = known_.find(entries[i]);
    if (finding.suppressed != Suppressed::no || known == known_.end()) continue;
    const std::uint64_t with_it = counts[entries[i]] + finding.places;
    if (with_it > known->second) continue;
    counts[entries[i]] = with_it;
    finding.suppressed = Suppressed::by_baseline;
  }
  for (const auto& [entry, count] : counts) met_[entry] = std::max(met_[entry], count);
}

std::size_t Baseline::gone() const {
  std::uint64_t lines = 0;
  for (const auto& [entry, count] : known_) {
    const auto met = met_.find(entry);
    if (files_.contains(std::get<0>(entry))) lines += count - (met == met_.end() ? 0 : met->second);
  }
  return static_cast<std::size_t>(lines);
}

}  // namespace frustum::lint
