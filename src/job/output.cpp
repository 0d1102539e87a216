#include "limpid/job/output.h"

#include <algorithm>
#include <iterator>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr std::string_view kRunners[] = {"fused", "reference", "gpu"};

}  // namespace

std::string_view runner_name(Runner runner) { return kRunners[static_cast<std::size_t>(runner)]; }

Runner runner_named(std::string_view name) {
  const std::vector<std::string> known(std::begin(kRunners), std::end(kRunners));
  const auto at = std::find(known.begin(), known.end(), name);
  if (at != known.end()) return static_cast<Runner>(at - known.begin());
  throw Error("'" + std::string(name) + "' is not a runner: expected one of " + join(known) +
                  did_you_mean(name, known),
              Fault::kUsage);
}

}  // namespace limpid
