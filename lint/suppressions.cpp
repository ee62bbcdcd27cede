#include "lint/suppressions.hpp"

#include <algorithm>
#include <utility>

#include "parser/language/letter_case.hpp"
#include "parser/reading/block_reader.hpp"

namespace frustum::lint {
namespace {

using parser::Block;

constexpr std::string_view kCommentMark = "frustum:";
constexpr std::string_view kIgnoreLine = "ignore";
constexpr std::string_view kIgnoreFile = "ignore-file";
// Between the ids.
constexpr std::string_view kIdBlanks = " \t,";

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(kIdBlanks), text.size());
  text.remove_prefix(first);
  return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

// The first word, taken off the text.
std::string_view take_word(std::string_view& text) {
  text = without_blanks(text);
  const std::size_t end = std::min(text.find_first_of(kIdBlanks), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

// Cheap, for the many lines that have none.
bool may_have_mark(std::string_view line) {
  for (std::size_t at = line.find(':'); at != std::string_view::npos; at = line.find(':', at + 1)) {
    if (at + 1 < kCommentMark.size()) continue;
    if (parser::lower_case(line.substr(at + 1 - kCommentMark.size(), kCommentMark.size())) ==
        kCommentMark)
      return true;
  }
  return false;
}

// What a comment says after the mark, in small letters.
std::optional<std::string> said_in(std::string_view comment) {
  const std::string text = parser::lower_case(comment);
  const std::size_t at = text.find(kCommentMark);
  if (at == std::string::npos) return std::nullopt;
  return text.substr(at + kCommentMark.size());
}

void read_suppression(std::string_view said, const parser::SourcePlace& place, std::uint32_t line,
                      std::vector<Suppression>& found) {
  const std::size_t end = std::min(said.find("--"), said.find(';'));
  std::string reason;
  if (end != std::string_view::npos) {
    const std::size_t behind = said.find_first_not_of("-;", end);
    if (behind != std::string_view::npos) reason = without_blanks(said.substr(behind));
  }
  said = said.substr(0, end);
  const std::string_view verb = take_word(said);
  if (verb != kIgnoreLine && verb != kIgnoreFile) {
    found.push_back({place, line, std::string(verb), std::nullopt, reason});
    return;
  }
  const std::uint32_t covered = verb == kIgnoreFile ? 0 : line;
  const std::size_t before = found.size();
  for (auto id = take_word(said); !id.empty(); id = take_word(said)) {
    found.push_back({place, covered, std::string(id), check_named(id), reason});
  }
  if (found.size() == before) found.push_back({place, covered, {}, std::nullopt, reason});
}

// What the control shows to the operator, not what people write for each other.
bool is_message(const parser::Comment& comment) {
  return comment.event != nullptr || parser::lower_case(comment.text).starts_with("msg,");
}

bool only_comments(const Block& block) {
  return !block.tape_mark && !block.program && block.words.empty() && block.assignments.empty() &&
         !block.flow;
}

}  // namespace

std::vector<Suppression> suppressions_of(const parser::Program& program) {
  std::vector<Suppression> found;
  std::size_t waiting = 0;  // the first of those that the next block will have
  parser::LineReader lines(program.text);
  while (!lines.at_end()) {
    const std::uint32_t line = lines.place().line;
    const std::string_view text = lines.next();
    const bool marked = may_have_mark(text);
    if (!marked && waiting == found.size()) continue;
    // A line that cannot be read is a block too.
    const auto block = parser::reader_of(program.dialect)(text, line);
    const bool acts = !block || !only_comments(*block);
    if (block && block->empty()) continue;
    if (acts) {
      for (; waiting < found.size(); ++waiting) {
        if (found[waiting].line != 0) found[waiting].line = line;
      }
    }
    if (!marked) continue;
    if (!block) {
      const std::string said = *said_in(text);
      read_suppression(said.substr(0, said.find(')')), {line, 1, nullptr}, line, found);
    } else {
      for (const parser::Comment& comment : block->comments) {
        if (is_message(comment)) continue;
        const auto said = said_in(comment.text);
        if (said) read_suppression(*said, {line, comment.column, nullptr}, line, found);
      }
    }
    if (acts) waiting = found.size();
  }
  return found;
}

Suppressions::OfFile::OfFile(std::vector<Suppression> found) : list(std::move(found)) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].check) by_line[{list[i].line, *list[i].check}].push_back(i);
  }
}

Suppressions::Suppressions(const parser::Program& main)
    : dialect_(main.dialect), main_(suppressions_of(main)) {}

Suppressions::OfFile& Suppressions::of_file(const parser::SourcePlace& place) {
  if (place.file == nullptr) return main_;
  const auto [at, fresh] = others_.try_emplace(*place.file);
  if (!fresh) return at->second;
  if (auto program = parser::open_program(*place.file, dialect_)) {
    auto found = suppressions_of(*program);
    for (Suppression& each : found) each.place.file = place.file;
    at->second = OfFile(std::move(found));
  }
  return at->second;
}

const Suppression* Suppressions::taking(Check check, const parser::SourcePlace& place) {
  OfFile& file = of_file(place);
  if (file.list.empty()) return nullptr;
  std::size_t first = file.list.size();
  for (const std::uint32_t line : {0U, place.line}) {
    const auto found = file.by_line.find({line, check});
    if (found == file.by_line.end()) continue;
    first = std::min(first, found->second.front());
    // All of them at once.
    if (file.list[found->second.front()].used) continue;
    for (const std::size_t i : found->second) file.list[i].used = true;
  }
  return first == file.list.size() ? nullptr : &file.list[first];
}

std::vector<Suppression> Suppressions::all() const {
  std::vector<Suppression> found = main_.list;
  for (const auto& [name, file] : others_) {
    found.insert(found.end(), file.list.begin(), file.list.end());
  }
  return found;
}

}  // namespace frustum::lint
