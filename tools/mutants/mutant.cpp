// Compiled into the tree that holds its mutants. LIMPID_MUTANT is the number of the active mutant,
// and LIMPID_MUTANTS_REACHED a file that gets a byte for each place when the process ends.
#include "mutant.h"

#include <cstdio>
#include <cstdlib>

#ifndef LIMPID_MUTANT_COUNT
#define LIMPID_MUTANT_COUNT 65536
#endif

namespace limpid_mutants {

int active = -1;
unsigned char reached[LIMPID_MUTANT_COUNT];

namespace {

void write_reached() {
  std::FILE* file = std::fopen(std::getenv("LIMPID_MUTANTS_REACHED"), "wb");
  if (!file) std::abort();
  std::fwrite(reached, 1, sizeof(reached), file);
  std::fclose(file);
}

// This runs before the constructors of static objects, which hold mutants, too.
__attribute__((constructor(101))) void begin() {
  if (const char* number = std::getenv("LIMPID_MUTANT")) active = std::atoi(number);
  if (std::getenv("LIMPID_MUTANTS_REACHED")) {
    active = kRecording;
    std::atexit(write_reached);
  }
}

}  // namespace
}  // namespace limpid_mutants
