#include "gpu/spirv.h"

#include <cstddef>
#include <cstring>
#include <iterator>

namespace limpid {
namespace {

// Khronos Group, "SPIR-V Specification", 2.4 and 3.49: instructions in the order of a module.
constexpr std::uint32_t kExtension = 10, kEntryPoint = 15, kExecutionMode = 16, kCapability = 17;
constexpr std::uint32_t kSignedZeroInfNanPreserve = 4466;  ///< the capability
constexpr std::uint32_t kModePreserve = 4461;              ///< the execution mode
constexpr std::size_t kHeader = 5;

std::uint32_t instruction(std::uint32_t op, std::size_t words) {
  return static_cast<std::uint32_t>(words) << 16 | op;
}

}  // namespace

std::vector<std::uint32_t> keeping_infinity(const std::vector<std::uint32_t>& spirv) {
  constexpr char kName[24] = "SPV_KHR_float_controls";
  std::vector<std::uint32_t> made(spirv.begin(), spirv.begin() + kHeader);
  bool declared = false, moded = false;
  std::uint32_t entry = 0;
  for (std::size_t at = kHeader; at < spirv.size();) {
    const std::uint32_t op = spirv[at] & 0xffff;
    const std::size_t words = spirv[at] >> 16;
    if (!declared && op != kCapability) {
      declared = true;
      made.insert(made.end(), {instruction(kCapability, 2), kSignedZeroInfNanPreserve});
      made.push_back(instruction(kExtension, 1 + sizeof kName / 4));
      std::uint32_t name[sizeof kName / 4];
      std::memcpy(name, kName, sizeof kName);
      made.insert(made.end(), std::begin(name), std::end(name));
    }
    if (op == kEntryPoint) entry = spirv[at + 2];
    if (!moded && entry != 0 && op != kEntryPoint) {
      moded = true;
      made.insert(made.end(), {instruction(kExecutionMode, 4), entry, kModePreserve, 32});
    }
    made.insert(made.end(), spirv.begin() + static_cast<std::ptrdiff_t>(at),
                spirv.begin() + static_cast<std::ptrdiff_t>(at + words));
    at += words;
  }
  return made;
}

}  // namespace limpid
