#include "report/exchange/dmis_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace frustum::report {
namespace {

// So long that "FA(" and ")=FEAT/CYLNDR,$" fit in a line with them, the number of a point too.
constexpr std::size_t kLongestLabel = 48;
constexpr std::size_t kLongestPointLabel = 60;

std::string in_capitals(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    const bool kept = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    plain += kept ? c : c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : '_';
  }
  return plain.empty() ? "_" : plain;
}

// A to Z, then AA, AB ..
std::string letters_of(std::size_t n) {
  std::string letters;
  for (++n; n > 0; n = (n - 1) / 26) {
    letters.insert(letters.begin(), static_cast<char>('A' + (n - 1) % 26));
  }
  return letters;
}

// Empty where the name has none.
std::string own_letters(std::string_view name) {
  const std::string plain = in_capitals(name);
  std::string_view rest = plain;
  for (const std::string_view before : {"DATUM_", "DAT_"}) {
    if (rest.starts_with(before)) {
      rest.remove_prefix(before.size());
      break;
    }
  }
  const bool is_letters = std::ranges::all_of(rest, [](char c) { return c >= 'A' && c <= 'Z'; });
  return is_letters && !rest.empty() && rest.size() <= 2 ? std::string(rest) : std::string();
}

}  // namespace

std::string shortened_to(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return std::string(text);
  const auto is_inside = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U;
  };
  while (bytes > 0 && is_inside(bytes)) --bytes;
  return std::string(text.substr(0, bytes));
}

std::string dmis_statement(std::string_view whole) {
  std::string lines;
  while (whole.size() > kDmisColumns) {
    // The comma and the $ after it are within the line.
    const std::size_t comma = whole.rfind(',', kDmisColumns - 2);
    if (comma == whole.npos) break;
    lines += fmt::format("{}$\n", whole.substr(0, comma + 1));
    whole.remove_prefix(comma + 1);
  }
  return lines + std::string(whole) + "\n";
}

std::string dmis_comment(std::string_view content) {
  constexpr std::size_t kRoom = kDmisColumns - std::string_view("$$ ").size();
  std::string lines;
  while (content.size() > kRoom) {
    const std::size_t blank = content.rfind(' ', kRoom);
    const bool has_blank = blank != content.npos && blank > 0;
    const std::string line =
        has_blank ? std::string(content.substr(0, blank)) : shortened_to(content, kRoom);
    lines += fmt::format("$$ {}\n", line);
    content.remove_prefix(line.size() + (has_blank ? 1 : 0));
  }
  return lines + fmt::format("$$ {}\n", content);
}

std::string DmisLabels::of(std::string_view name) { return once(in_capitals(name), kLongestLabel); }

std::string DmisLabels::of_point(const std::string& label, std::size_t number) {
  return once(fmt::format("{}_P{}", label, number), kLongestPointLabel);
}

std::string DmisLabels::once(const std::string& plain, std::size_t longest) {
  std::string label = plain.substr(0, longest);
  int& next = next_.try_emplace(label, 2).first->second;
  const std::string base = label;
  while (!used_.insert(label).second) {
    const std::string number = fmt::format("_{}", next++);
    label = base.substr(0, longest - number.size()) + number;
  }
  return label;
}

DmisDatums::DmisDatums(const std::vector<std::string>& datums,
                       const std::vector<std::string>& features) {
  std::set<std::string> used;
  // Of two with the same letters the first has them.
  const auto take_own = [&](const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const std::string own = own_letters(name);
      if (!own.empty() && !letters_.contains(name) && used.insert(own).second) {
        letters_[name] = own;
      }
    }
  };
  take_own(datums);
  take_own(features);
  std::size_t n = 0;
  for (const std::string& feature : datums) {
    if (letters_.contains(feature)) continue;
    while (!used.insert(letters_of(n)).second) ++n;
    letters_[feature] = letters_of(n);
  }
}

std::string DmisDatums::of(const std::string& feature) const {
  const auto at = letters_.find(feature);
  return at == letters_.end() ? std::string() : at->second;
}

}  // namespace frustum::report
