#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "fuzz/harness.h"

namespace limpid::fuzz {

/// How a file is damaged.
enum class Damage { kNone, kBits, kRun, kCut, kSplice, kField };
constexpr Damage kDamages[] = {Damage::kBits, Damage::kRun, Damage::kCut, Damage::kSplice,
                               Damage::kField};
std::string_view name_of(Damage damage);

/// The damage that a number stands for: 0 is none, the others take turns.
Damage damage_of(std::uint64_t number);

/// A damaged copy: flipped bits, a run of equal or random bytes, an early end, a piece of `other`
/// put in or over, or a number of the header replaced by a number at the edge of its range. The
/// same bytes and number give the same copy on every machine.
std::vector<std::uint8_t> damaged(Bytes bytes, Bytes other, std::uint64_t number);

}  // namespace limpid::fuzz
