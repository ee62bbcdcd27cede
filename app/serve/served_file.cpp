#include "app/serve/served_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

bool is_name(std::string_view part) {
  constexpr std::size_t kLongest = 255;
  return !part.empty() && part.size() <= kLongest && !part.starts_with('.') &&
         std::ranges::all_of(part, [](char c) {
           const auto byte = static_cast<unsigned char>(c);
           return byte >= 0x20U && byte != 0x7fU && c != '\\';
         });
}

}  // namespace

std::optional<fs::path> served_file(const fs::path& folder, std::string_view path) {
  if (!path.starts_with('/')) return std::nullopt;
  path.remove_prefix(1);
  fs::path file = folder;
  while (true) {
    const auto end = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, end);
    if (!is_name(part)) return std::nullopt;
    file /= part;
    if (end == path.size()) break;
    path.remove_prefix(end + 1);
  }
  std::error_code problem;
  if (!fs::is_regular_file(file, problem)) return std::nullopt;
  const fs::path root = fs::canonical(folder, problem);
  if (problem) return std::nullopt;
  const fs::path real = fs::canonical(file, problem);
  if (problem) return std::nullopt;
  const auto [in_root, in_real] = std::mismatch(root.begin(), root.end(), real.begin(), real.end());
  if (in_root != root.end()) return std::nullopt;
  return real;
}

std::string url_of(std::string_view name) {
  std::string url;
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') ||
                          std::string_view("/-_.~").find(c) != std::string_view::npos;
    url += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

std::string_view content_type(const fs::path& file) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kTypes{{
      {".html", "text/html; charset=utf-8"},
      {".json", "application/json"},
      {".csv", "text/csv; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".txt", "text/plain; charset=utf-8"},
      {".toml", "text/plain; charset=utf-8"},
      {".nc", "text/plain; charset=utf-8"},
      {".qif", "application/xml"},
  }};
  const std::string extension = file.extension().string();
  for (const auto& [known, type] : kTypes) {
    if (extension == known) return type;
  }
  return "application/octet-stream";
}

bool is_own_host(std::string_view host, int port) {
  for (const char* name : {"127.0.0.1", "localhost", "[::1]"}) {
    if (host == fmt::format("{}:{}", name, port)) return true;
    if (port == 80 && host == name) return true;
  }
  return false;
}

}  // namespace frustum::app
