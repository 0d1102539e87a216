#pragma once
#include <string>

#include "limpid/composite.h"
#include "limpid/core/error.h"

#include "arguments.h"

/// What composite and water have in common: look, output, report line.

namespace limpid::tool {

/// What is wrong with a word of the command line is wrong usage, whatever it is elsewhere.
template <class Work>
auto as_usage(Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.what(), Fault::kUsage);
  }
}

Look look_of(const WaterOptions& options);

/// Throws the usage Error for no name, or one that is not an EXR's.
void expect_output(const std::string& path);
OutputChoice output_of(const WaterOptions& options);

void print_report(const CompositeReport& report, const Look& look, const OutputChoice& output,
                  const CommonArguments& common);

}  // namespace limpid::tool
