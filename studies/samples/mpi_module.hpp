// What the module frustum_mpi offers: four C functions, so that nothing else needs MPI's library.
//
// Units: none. Errors: start returns 0 where MPI cannot be started.
#pragma once

#include <cstdint>

extern "C" {
int frustum_mpi_start(std::uint64_t* rank, std::uint64_t* count);
std::uint64_t frustum_mpi_sum(std::uint64_t own);
std::uint64_t frustum_mpi_from_first(std::uint64_t value);
void frustum_mpi_end(void);
}
