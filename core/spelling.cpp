#include "core/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace frustum {
namespace {

// Letters that are wrong, missing or too many; two neighbours that changed places count as one, but
// in a word of three letters, where that makes another word (zyx, zxy).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const auto same = [&](char c, char d) { return lower(c) == lower(d); };
  std::vector<std::size_t> row(b.size() + 1), above, second;
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    second = std::move(above);
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      if (a.size() > 3 && i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
        row[j] = std::min(row[j], second[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::string> nearest_word(std::string_view word,
                                        std::span<const std::string> candidates) {
  if (word.empty()) return std::nullopt;
  const std::string* best = nullptr;
  // A word is "meant" when at most a third of it, and at least one letter, is wrong.
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  const auto between = [](std::size_t a, std::size_t b) { return a < b ? b - a : a - b; };
  for (const std::string& candidate : candidates) {
    if (between(word.size(), candidate.size()) >= best_distance) continue;  // no nearer than that
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = &candidate;
      best_distance = distance;
    }
  }
  if (best == nullptr) return std::nullopt;
  return *best;
}

std::string suggestion(std::string_view word, std::span<const std::string> candidates) {
  if (const auto nearest = nearest_word(word, candidates)) return "did you mean " + *nearest + "?";
  constexpr std::size_t kMostToRead = 40;
  std::string known;
  for (const std::string& candidate : candidates.first(std::min(candidates.size(), kMostToRead))) {
    known += (known.empty() ? "known: " : ", ") + candidate;
  }
  if (candidates.size() <= kMostToRead) return known;
  return known + fmt::format(" and {} more", candidates.size() - kMostToRead);
}

}  // namespace frustum
