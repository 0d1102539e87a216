#pragma once

namespace limpid::test {

/// How often any operator new or calloc() of this program was called.
int allocations();

/// While an object of this type lives, every operator new of this program throws std::bad_alloc.
struct NoMemory {
  NoMemory();
  ~NoMemory();
};

}  // namespace limpid::test
