// The only source that knows MPI; a module of its own, which the program loads when it was started
// by a launcher.
#include <mpi.h>

#include "studies/samples/mpi_module.hpp"

int frustum_mpi_start(std::uint64_t* rank, std::uint64_t* count) {
  int provided = 0, own = 0, all = 0;
  // Only the thread that started it speaks to the others.
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS) return 0;
  if (provided < MPI_THREAD_FUNNELED) return 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  MPI_Comm_size(MPI_COMM_WORLD, &all);
  *rank = static_cast<std::uint64_t>(own);
  *count = static_cast<std::uint64_t>(all);
  return 1;
}

std::uint64_t frustum_mpi_sum(std::uint64_t own) {
  std::uint64_t all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

std::uint64_t frustum_mpi_from_first(std::uint64_t value) {
  MPI_Bcast(&value, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  return value;
}

void frustum_mpi_end() { MPI_Finalize(); }
