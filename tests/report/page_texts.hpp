// What a reader sees of a page, and what of the table of texts is left in English on a German one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/phrases.hpp"

namespace frustum::report {

// What is between the tags, and what is read out.
inline std::string texts_of(const std::string& page) {
  const auto begin = page.find("<body>"), end = page.find("<script");
  const std::string body = page.substr(begin, end - begin);
  std::string out;
  bool in_tag = false;
  for (const char c : body) {
    if (c == '<') in_tag = true;
    out += in_tag ? ' ' : c;
    if (c == '>') in_tag = false;
  }
  for (const std::string label : {"aria-label=\"", " alt=\"", "data-label=\""}) {
    for (std::size_t at = body.find(label); at != body.npos; at = body.find(label, at + 1)) {
      const std::size_t from = at + label.size();
      out += '\n' + body.substr(from, body.find('"', from) - from) + '\n';
    }
  }
  return out;
}

// As words of their own: not within a longer word, or a name such as cone.form.
inline bool holds(const std::string& text, std::string_view phrase) {
  const auto is_word = [&](std::size_t at) {
    const char c = at < text.size() ? text[at] : ' ';
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '.';
  };
  for (std::size_t at = text.find(phrase); at != text.npos; at = text.find(phrase, at + 1)) {
    if ((at == 0 || !is_word(at - 1)) && !is_word(at + phrase.size())) return true;
  }
  return false;
}

// Texts of the table that the English text has: how many, and which of them the German one has too.
struct Untranslated {
  std::size_t found = 0;
  std::vector<std::string> left{};
};
inline Untranslated untranslated(const std::string& english, const std::string& german) {
  Untranslated result;
  for (const PhrasePart& part : kPhraseParts) {
    for (std::size_t i = 0; i < part.count; ++i) {
      const auto& [en, de] = part.rows[i];
      const bool is_short = en.size() < 5 || en.find('{') != en.npos;
      if (en == de || is_short || de.find(en) != de.npos) continue;
      if (!holds(english, en)) continue;
      ++result.found;
      if (holds(german, en)) result.left.emplace_back(en);
    }
  }
  return result;
}

}  // namespace frustum::report
