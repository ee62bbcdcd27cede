// The entry of libFuzzer, for the dialect that FRUSTUM_FUZZ_DIALECT names.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/one_program.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static const auto kDialect = frustum::parser::dialect_named(FRUSTUM_FUZZ_DIALECT);
  frustum::parser::run_one_program(text, *kDialect);
  return 0;
}
