#include "run/each_once.h"

#include <algorithm>
#include <string>

#include "limpid/core/error.h"

namespace limpid {

void expect_each_once(std::span<const Aov> list) {
  for (const Aov aov : list) {
    if (std::count(list.begin(), list.end(), aov) == 1) continue;
    throw Error("the AOV '" + std::string(aovs()[static_cast<std::size_t>(aov)].name) +
                    "' is named twice: expected it once",
                Fault::kUsage);
  }
}

}  // namespace limpid
