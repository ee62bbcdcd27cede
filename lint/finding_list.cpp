#include "lint/finding_list.hpp"

#include <algorithm>
#include <functional>
#include <string_view>
#include <tuple>

namespace frustum::lint {
namespace {

constexpr FindingList::Key kOtherLine = 1'099'511'628'211;  // odd: lines stay unlike

}  // namespace

FindingList::Key FindingList::key_of(const parser::SourcePlace& place) {
  const Key file = place.file ? key_of(*place.file) : 0;
  return (file << 32U) ^ place.line;
}
FindingList::Key FindingList::key_of(double value) { return std::hash<double>()(value); }
FindingList::Key FindingList::key_of(const std::string& text) {
  return std::hash<std::string>()(text);
}

bool FindingList::counted(const Place& at, Severity severity, const parser::SourcePlace& place) {
  const auto known = index_.find(at);
  if (known != index_.end()) {
    Finding& finding = findings_[known->second];
    ++finding.count;
    if (lines_[known->second].insert(place)) ++finding.places;
    return true;
  }
  const auto& [check, key, taken] = at;
  if (places_[{check, severity, taken}] < most_places_) return false;
  if (!taken) ++left_out_[check];
  return true;
}

void FindingList::add(const Place& at, Severity severity, const parser::SourcePlace& place,
                      Words words, const Suppression* taken) {
  const Check check = std::get<Check>(at);
  ++places_[{check, severity, taken != nullptr}];
  index_.emplace(at, findings_.size());
  findings_.push_back({.check = check,
                       .severity = severity,
                       .file = place.file ? *place.file : file_,
                       .line = place.line,
                       .column = place.column,
                       .message = std::move(words.message),
                       .hint = std::move(words.hint),
                       .places = words.places,
                       .alike = std::move(words.alike),
                       .diagnostic = words.diagnostic});
  lines_.emplace_back().insert(place);
  if (taken == nullptr) return;
  findings_.back().suppressed = Suppressed::by_comment;
  findings_.back().reason = taken->reason;
}

std::vector<Finding> FindingList::sorted() const {
  std::vector<Finding> findings = findings_;
  const auto order = [this](const Finding& f) {
    return std::tuple(f.file != file_, std::string_view(f.file), f.line, f.column, f.check);
  };
  std::stable_sort(findings.begin(), findings.end(),
                   [&](const Finding& a, const Finding& b) { return order(a) < order(b); });
  return findings;
}

void FindingList::raise(Check check, const Diagnostic& said, const parser::SourcePlace& place,
                        std::optional<Severity> severity) {
  const Key key = key_of(place) * kOtherLine ^ key_of(said.message);
  raise(
      check, key, place,
      [&] {
        return Words{said.message, said.hint, said.id};
      },
      severity);
}

void FindingList::raise_alike(Check check, const Diagnostic& said,
                              const parser::SourcePlace& place) {
  raise(check, key_of(said.message), place, [&] {
    return Words{said.message, said.hint, said.id, said.message};
  });
}

}  // namespace frustum::lint
