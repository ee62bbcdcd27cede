#include "parser/reading/program_text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "core/files_read.hpp"

namespace frustum::parser {
namespace {

// Small enough for the processor's own memory.
constexpr std::size_t kWindow = std::size_t{1} << 18U;
constexpr const char* kStandardInput = "-";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

Diagnostic unreadable(const std::filesystem::path& file, std::string hint) {
  Diagnostic failure = error("file-unreadable"_id, "the file cannot be read", std::move(hint));
  failure.file = file.string();
  return failure;
}

// A pipe, which can be read only once, is kept in memory.
constexpr std::size_t kLongestPipe = std::size_t{1} << 29U;

Result<std::string> text_of_stream(std::FILE* stream, const std::filesystem::path& file) {
  std::string text;
  std::array<char, 1U << 16U> some{};
  while (const std::size_t count = std::fread(some.data(), 1, some.size(), stream)) {
    if (text.size() + count > kLongestPipe) {
      return unreadable(file,
                        "more than 512 MiB come through this pipe; write it to a file before");
    }
    text.append(some.data(), count);
  }
  if (std::ferror(stream) != 0) return unreadable(file, std::strerror(errno));
  return text;
}

// Where an LF has to be by to end the lines, which no line of a program reaches to.
constexpr std::size_t kLineFeedBy = std::size_t{1} << 16U;

// Length of the line at the front of `text`, and of its end; no end in `text`: npos.
struct LineLength {
  std::size_t line = 0;
  std::size_t with_end = std::string_view::npos;
};
LineLength first_line(std::string_view text, bool carriages_end) {
  const auto find = [](std::string_view in, char wanted) {
    const void* found = std::memchr(in.data(), wanted, in.size());
    return found == nullptr ? in.size()
                            : static_cast<std::size_t>(static_cast<const char*>(found) - in.data());
  };
  if (text.empty()) return {};
  const std::size_t feed = find(text, '\n');
  if (carriages_end) {
    const std::size_t carriage = find(text.substr(0, feed), '\r');
    if (carriage + 1 < text.size() && carriage < feed) {
      return {carriage, carriage + (carriage + 1 == feed ? 2U : 1U)};
    }
  }
  std::size_t line = feed;
  while (line > 0 && text[line - 1] == '\r') --line;
  if (feed < text.size()) return {line, feed + 1};
  return {line, std::string_view::npos};
}

}  // namespace

Result<ProgramText> ProgramText::open(const std::filesystem::path& file) {
  const auto kept = [](Result<std::string> bytes) -> Result<ProgramText> {
    if (!bytes) return bytes.error();
    return ProgramText(*std::move(bytes));
  };
  if (file == kStandardInput) return kept(text_of_stream(stdin, "standard input"));
  std::error_code failed;
  if (std::filesystem::is_directory(file, failed)) return unreadable(file, "it is a folder");
  if (std::filesystem::exists(file, failed) && !std::filesystem::is_regular_file(file, failed)) {
    std::FILE* stream = std::fopen(file.c_str(), "rb");
    if (stream == nullptr) return unreadable(file, std::strerror(errno));
    auto bytes = text_of_stream(stream, file);
    std::fclose(stream);
    return kept(std::move(bytes));
  }
  if (!std::ifstream(file, std::ios::binary)) {
    return unreadable(file, "check the path and permissions");
  }
  note_read(file);
  ProgramText text;
  text.file_ = file;
  return text;
}

std::string ProgramText::head(std::size_t count) const {
  if (file_.empty()) return text_->substr(0, count);
  std::string bytes(count, '\0');
  std::ifstream in(file_, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

LineReader::LineReader(ProgramText text) : text_(std::move(text)) {
  if (text_.file_.empty()) {
    window_ = *text_.text_;
  } else {
    file_.open(text_.file_, std::ios::binary);
  }
  go_to({});
  carriages_end_ = rest().substr(0, kLineFeedBy).find('\n') == std::string_view::npos;
}

void LineReader::go_to(TextPlace place) {
  if (text_.file_.empty()) {
    in_window_ = std::min<std::size_t>(place.offset, window_.size());
  } else {
    const std::uint64_t window_start = place_.offset - in_window_;
    if (place.offset >= window_start && place.offset < window_start + window_.size()) {
      in_window_ = static_cast<std::size_t>(place.offset - window_start);
    } else {
      file_.clear();
      file_.seekg(static_cast<std::streamoff>(place.offset));
      file_ended_ = false;
      window_ = {};
      in_window_ = 0;
    }
  }
  place_ = place;
  after_feed_ = false;
  if (place.offset != 0) return;
  if (rest().size() < kByteOrderMark.size()) refill();
  if (rest().starts_with(kByteOrderMark)) {
    take(kByteOrderMark.size());
  }
}

bool LineReader::refill() {
  if (file_ended_) return false;
  const std::size_t kept = rest().size();
  if (kept > 0) std::memmove(buffer_.data(), rest().data(), kept);
  in_window_ = 0;
  // It stays as large as it is, so that what is read over is not cleared before.
  if (buffer_.size() < kept + kWindow) buffer_.resize(kept + kWindow);
  file_.read(buffer_.data() + kept, static_cast<std::streamsize>(kWindow));
  const auto read = static_cast<std::size_t>(file_.gcount());
  window_ = std::string_view(buffer_).substr(0, kept + read);
  file_ended_ = read < kWindow;
  return read > 0;
}

bool LineReader::at_end() { return rest().empty() && !refill(); }

std::string_view LineReader::next() {
  if (after_feed_ && rest().starts_with('\r')) take(1);
  LineLength length = first_line(rest(), carriages_end_);
  while (length.with_end == std::string_view::npos && refill()) {
    length = first_line(rest(), carriages_end_);
  }
  const std::string_view line = rest().substr(0, length.line);
  const std::size_t taken = std::min(length.with_end, rest().size());
  after_feed_ = taken > length.line && rest()[taken - 1] == '\n' && taken == length.line + 1;
  take(taken);
  ++place_.line;
  return line;
}

void LineReader::take(std::size_t bytes) {
  in_window_ += bytes;
  place_.offset += bytes;
}

}  // namespace frustum::parser
