// What a fuzzer starts from: its seeds, which hold all that it has found too, and its dictionary.
//
// A fuzzer has a folder in tests/fuzz: seeds/, files of its own; seeds.txt, if it is there, files
// of the repository that are seeds too; words.dict.
//
// Units : none
// Errors: none; what is not there is empty
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustum::fuzz {

[[nodiscard]] std::vector<std::filesystem::path> seeds_of(std::string_view fuzzer);
[[nodiscard]] std::string bytes_of(const std::filesystem::path& seed);

// One broken line of the dictionary stops libFuzzer before it begins.
struct Dictionary {
  int words = 0;
  std::vector<std::string> broken{};
};
[[nodiscard]] Dictionary dictionary_of(std::string_view fuzzer);

}  // namespace frustum::fuzz
