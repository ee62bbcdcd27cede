#include "tests/fuzz/seeds.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace frustum::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kRepository = FRUSTUM_SOURCE_DIR;

fs::path folder_of(std::string_view fuzzer) { return kRepository / "tests" / "fuzz" / fuzzer; }

}  // namespace

std::vector<fs::path> seeds_of(std::string_view fuzzer) {
  std::vector<fs::path> seeds;
  for (const auto& own : fs::directory_iterator(folder_of(fuzzer) / "seeds")) {
    seeds.push_back(own.path());
  }
  std::sort(seeds.begin(), seeds.end());
  std::ifstream listed(folder_of(fuzzer) / "seeds.txt");
  for (std::string line; std::getline(listed, line);) seeds.push_back(kRepository / line);
  return seeds;
}

std::string bytes_of(const fs::path& seed) {
  std::ifstream in(seed, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Dictionary dictionary_of(std::string_view fuzzer) {
  Dictionary dictionary;
  std::ifstream in(folder_of(fuzzer) / "words.dict");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    ++dictionary.words;
    const bool quoted = line.size() > 2 && line.front() == '"' && line.back() == '"';
    if (!quoted) dictionary.broken.push_back(line);
  }
  return dictionary;
}

}  // namespace frustum::fuzz
