// The entry of libFuzzer, for the kind of file that FRUSTUM_FUZZ_FILE names: plan is run_one_plan.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/files/one_file.hpp"

#define FRUSTUM_JOIN(a, b) a##b
#define FRUSTUM_RUN(kind) FRUSTUM_JOIN(run_one_, kind)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  frustum::fuzz::FRUSTUM_RUN(FRUSTUM_FUZZ_FILE)({reinterpret_cast<const char*>(data), size});
  return 0;
}
