#include "lint/finding_list.hpp"

#include <algorithm>
#include <functional>
#include <string_view>
#include <tuple>

namespace frustum::lint {

FindingList::Key FindingList::key_of(const parser::SourcePlace& place) {
  const Key file = place.file ? key_of(*place.file) : 0;
  return (file << 32U) ^ place.line;
}
FindingList::Key FindingList::key_of(double value) { return std::hash<double>()(value); }
FindingList::Key FindingList::key_of(const std::string& text) {
  return std::hash<std::string>()(text);
}

bool FindingList::counted(Check check, Key key, bool taken) {
  const auto known = index_.find({check, key, taken});
  if (known != index_.end()) {
    ++findings_[known->second].count;
    return true;
  }
  if (places_[{check, taken}] < kMostPlaces) return false;
  if (!taken) ++left_out_[check];
  return true;
}

void FindingList::add(Check check, Key key, const parser::SourcePlace& place, Words words,
                      std::optional<Severity> severity, const Suppression* taken) {
  ++places_[{check, taken != nullptr}];
  index_.emplace(Place(check, key, taken != nullptr), findings_.size());
  findings_.push_back({.check = check,
                       .severity = severity.value_or(info_of(check).severity),
                       .file = place.file ? *place.file : file_,
                       .line = place.line,
                       .column = place.column,
                       .message = std::move(words.message),
                       .hint = std::move(words.hint),
                       .diagnostic = words.diagnostic});
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
  raise(
      check, key_of(said.message), place,
      [&] {
        return Words{said.message, said.hint, said.id};
      },
      severity);
}

}  // namespace frustum::lint
