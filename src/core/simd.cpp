#include "limpid/core/simd.h"

#include <cstdint>

#include <hwy/targets.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

struct Candidate {
  const char* name;
  std::int64_t highway;  ///< 0 for the baseline that every machine has
};

constexpr Candidate kCandidates[] = {
#define LIMPID_TARGET(name, highway) {#name, highway},
#include "core/targets.inc"
#undef LIMPID_TARGET
};

bool supported(const Candidate& c) {
  return c.highway == 0 || (hwy::SupportedTargets() & c.highway) != 0;
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const Candidate& c : kCandidates) {
    if (supported(c)) names.emplace_back(c.name);
  }
  return names;
}

int simd_index(const std::string& name) {
  int index = 0;
  for (const Candidate& c : kCandidates) {
    if (supported(c) && (name.empty() || name == c.name)) return index;
    ++index;
  }
  throw Error("simd = " + name + ": expected one of " + join(simd_targets()) + " on this machine");
}

}  // namespace limpid
