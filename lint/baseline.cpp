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
    baseline.entries_.emplace(entry["file"], entry["id"], entry["fingerprint"]);
  }
  return baseline;
}

std::string Baseline::text_of(std::span<const CheckedFile> checked, const fs::path& file) {
  const fs::path folder = folder_of(file);
  Json findings = Json::array();
  for (const CheckedFile& each : checked) {
    const auto marks = fingerprints_of(each.report.findings, each.lines);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const Finding& finding = each.report.findings[i];
      if (finding.suppressed == Suppressed::by_comment) continue;
      findings.push_back({{"file", name_in(folder, finding.file)},
                          {"id", info_of(finding.check).id},
                          {"fingerprint", marks[i]},
                          {"line", finding.line},
                          {"message", finding.message}});
    }
  }
  const Json json{{kVersion, 1}, {"findings", findings}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Baseline::apply(CheckedFile& checked) {
  const auto marks = fingerprints_of(checked.report.findings, checked.lines);
  files_.insert(name_in(folder_, checked.file));
  for (std::size_t i = 0; i < marks.size(); ++i) {
    Finding& finding = checked.report.findings[i];
    const Entry entry{name_in(folder_, finding.file), std::string(info_of(finding.check).id),
                      marks[i]};
    if (finding.suppressed != Suppressed::no || !entries_.contains(entry)) continue;
    finding.suppressed = Suppressed::by_baseline;
    met_.insert(entry);
  }
}

std::size_t Baseline::gone() const {
  return static_cast<std::size_t>(
      std::count_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return files_.contains(std::get<0>(entry)) && !met_.contains(entry);
      }));
}

}  // namespace frustum::lint
