#include "core/program_version.hpp"

namespace frustum {

std::string_view program_version() { return FRUSTUM_VERSION; }

}  // namespace frustum
