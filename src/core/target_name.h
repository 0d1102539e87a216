#pragma once

/// Names in files that are compiled once for each instruction set: LIMPID_OF_TARGET(kFused_) is
/// kFused_avx2 in the copy for avx2.

#define LIMPID_JOIN_(a, b) a##b
#define LIMPID_JOIN(a, b) LIMPID_JOIN_(a, b)
#define LIMPID_OF_TARGET(prefix) LIMPID_JOIN(prefix, LIMPID_LANES_TARGET)
