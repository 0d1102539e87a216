#pragma once

namespace limpid::test {

/// How often any operator new of this program was called.
int allocations();

}  // namespace limpid::test
