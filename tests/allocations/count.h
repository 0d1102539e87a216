#pragma once

namespace limpid::test {

/// How often any operator new or calloc() of this program was called.
int allocations();

}  // namespace limpid::test
