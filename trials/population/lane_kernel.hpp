// What is computed for eight machines at a time, once for every processor and once for those with
// 256-bit registers; the bits are the same.
//
// Units  : mm, rad
// Errors : none
#pragma once

#include <cstdint>
#include <span>

#include "trials/population/lane_chain.hpp"
#include "trials/population/lane_contact.hpp"

namespace frustum::trials {

// Which registers the kernel takes: the widest that this processor has, or others for tests, which
// it must have.
enum class Registers { widest, any, avx2, avx512 };

void find_poses(const LaneChainTables& chain, const LaneMachines& machines,
                std::span<const std::uint32_t> places, std::span<LanePose> poses,
                Registers registers = Registers::widest);

void find_contacts(std::span<const ProbeWindow> windows, const WindowTables& tables,
                   std::span<const LanePose> poses, const LaneFrame& frame, const Lanes& scale,
                   std::span<LaneContact> contacts, Registers registers = Registers::widest);

}  // namespace frustum::trials
