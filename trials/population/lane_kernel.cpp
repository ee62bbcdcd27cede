#include "trials/population/lane_kernel.hpp"

#include <cstddef>

// Code that is compiled for a processor must not meet inline functions of the library that others
// share: nothing of it is used below.
namespace frustum::trials {
namespace any_processor {
inline constexpr std::size_t kWidth = 2;
#include "trials/population/lane_operations.inc"
// In this order.
#include "trials/population/lane_pose_kernel.inc"
// The contact comes last.
#include "trials/population/lane_contact_kernel.inc"
}  // namespace any_processor

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define FRUSTUM_WIDE_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
namespace with_avx2 {
inline constexpr std::size_t kWidth = 4;
#include "trials/population/lane_operations.inc"
// In this order.
#include "trials/population/lane_pose_kernel.inc"
// The contact comes last.
#include "trials/population/lane_contact_kernel.inc"
}  // namespace with_avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,prefer-vector-width=512")
namespace with_avx512 {
inline constexpr std::size_t kWidth = 8;
#include "trials/population/lane_operations.inc"
// In this order.
#include "trials/population/lane_pose_kernel.inc"
// The contact comes last.
#include "trials/population/lane_contact_kernel.inc"
}  // namespace with_avx512
#pragma GCC pop_options
#endif

namespace {

// The widest registers that the processor has, as far as they are wanted.
[[maybe_unused]] Registers found(Registers wanted) {
#ifdef FRUSTUM_WIDE_LANES
  if (wanted == Registers::widest && __builtin_cpu_supports("avx512f") != 0 &&
      __builtin_cpu_supports("avx512dq") != 0) {
    return Registers::avx512;
  }
  if (wanted == Registers::widest && __builtin_cpu_supports("avx2") != 0) return Registers::avx2;
#endif
  return wanted == Registers::widest ? Registers::any : wanted;
}

}  // namespace

void find_poses(const LaneChainTables& chain, const LaneMachines& machines,
                std::span<const std::uint32_t> places, std::span<LanePose> poses,
                Registers registers) {
  switch (found(registers)) {
#ifdef FRUSTUM_WIDE_LANES
    case Registers::avx512:
      return with_avx512::find_poses_here(chain, machines, places, poses);
    case Registers::avx2:
      return with_avx2::find_poses_here(chain, machines, places, poses);
#endif
    default:
      return any_processor::find_poses_here(chain, machines, places, poses);
  }
}

void find_contacts(std::span<const ProbeWindow> windows, const WindowTables& tables,
                   std::span<const LanePose> poses, const LaneFrame& frame, const Lanes& scale,
                   std::span<LaneContact> contacts, Registers registers) {
  switch (found(registers)) {
#ifdef FRUSTUM_WIDE_LANES
    case Registers::avx512:
      return with_avx512::find_contacts_here(windows, tables, poses, frame, scale, contacts);
    case Registers::avx2:
      return with_avx2::find_contacts_here(windows, tables, poses, frame, scale, contacts);
#endif
    default:
      return any_processor::find_contacts_here(windows, tables, poses, frame, scale, contacts);
  }
}

}  // namespace frustum::trials
