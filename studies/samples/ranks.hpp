// The processes that share the draws of a study, from what started them: mpirun, or nobody.
//
// A rank computes every P-th part. What they say to each other is one number at a time: how many
// are done, whether one has failed, whether the first has seen enough. The library of MPI is loaded
// only where a launcher has started the program, by the module frustum_mpi (mpi_ranks.cpp).
// Units  : none
// Errors : a launcher without the module, or a module that cannot be started
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "core/result.hpp"

namespace frustum::studies {

class Ranks {
 public:
  // One process by itself.
  Ranks();
  // Of a launcher: `modules` are the places where the module may be.
  [[nodiscard]] static Result<Ranks> launched(std::span<const std::filesystem::path> modules);
  Ranks(Ranks&&) noexcept;
  Ranks& operator=(Ranks&&) noexcept;
  ~Ranks();

  [[nodiscard]] std::uint64_t rank() const;
  [[nodiscard]] std::uint64_t count() const;
  [[nodiscard]] bool is_first() const { return rank() == 0; }

  // Each waits for all of the others; every rank gets the sum, or what the first one gives.
  [[nodiscard]] std::uint64_t sum(std::uint64_t own) const;
  [[nodiscard]] std::uint64_t from_first(std::uint64_t value) const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;  // none: one process
};

}  // namespace frustum::studies
