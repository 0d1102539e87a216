#pragma once
#include <cstddef>
#include <string>

#include "limpid/core/error.h"

namespace limpid::tool {

/// An option of a verb, and whether the command line gives it.
struct Given {
  const char* option;
  bool is_given;
};

/// Throws the usage Error for the first that is given: "VERB OPTION: EXPECTED".
template <std::size_t N>
void refuse_given(const std::string& verb, const Given (&options)[N], const std::string& expected) {
  for (const Given& option : options) {
    if (option.is_given) {
      throw Error(verb + " " + option.option + ": " + expected, Fault::kUsage);
    }
  }
}

}  // namespace limpid::tool
