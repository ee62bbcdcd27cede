#include "studies/samples/ranks.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>
#include <utility>

#include "studies/samples/mpi_module.hpp"

namespace frustum::studies {

struct Ranks::Library {
  void* module = nullptr;
  std::uint64_t rank = 0, count = 1;
  decltype(&frustum_mpi_start) start = nullptr;
  decltype(&frustum_mpi_sum) sum = nullptr;
  decltype(&frustum_mpi_from_first) from_first = nullptr;
  decltype(&frustum_mpi_end) end = nullptr;

  template <class Function>
  bool find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(::dlsym(module, name));
    return function != nullptr;
  }
  [[nodiscard]] bool find_all() {
    return find(start, "frustum_mpi_start") && find(sum, "frustum_mpi_sum") &&
           find(from_first, "frustum_mpi_from_first") && find(end, "frustum_mpi_end");
  }
};

Ranks::Ranks() = default;
Ranks::Ranks(Ranks&&) noexcept = default;
Ranks& Ranks::operator=(Ranks&&) noexcept = default;

// The module stays loaded: MPI leaves threads and handlers behind.
Ranks::~Ranks() {
  if (library_) library_->end();
}

Result<Ranks> Ranks::launched(std::span<const std::filesystem::path> modules) {
  auto library = std::make_unique<Library>();
  std::string why = "it is not installed";
  for (const auto& file : modules) {
    std::error_code unknown;
    if (!std::filesystem::exists(file, unknown)) continue;
    // Global: the parts of Open MPI that are loaded later look for its symbols.
    library->module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (library->module != nullptr) break;
    why = ::dlerror();
  }
  const bool started = library->module != nullptr && library->find_all() &&
                       library->start(&library->rank, &library->count) == 1;
  if (!started) {
    return error("mpi"_id, fmt::format("the module frustum_mpi cannot be used: {}", why),
                 "install Open MPI and build again, or run the parts by --part K/N and merge them");
  }
  Ranks ranks;
  ranks.library_ = std::move(library);
  return ranks;
}

std::uint64_t Ranks::rank() const { return library_ ? library_->rank : 0; }
std::uint64_t Ranks::count() const { return library_ ? library_->count : 1; }
std::uint64_t Ranks::sum(std::uint64_t own) const { return library_ ? library_->sum(own) : own; }
std::uint64_t Ranks::from_first(std::uint64_t value) const {
  return library_ ? library_->from_first(value) : value;
}

}  // namespace frustum::studies
