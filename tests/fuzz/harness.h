#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "limpid/core/error.h"

/// Harnesses for untrusted input, one for each parser: each takes any bytes and returns. Error is
/// the answer to bad bytes; any other outcome (another exception, a promise that does not hold, a
/// crash, a hang) is a bug.

namespace limpid::fuzz {

using Bytes = std::span<const std::uint8_t>;

void exr(Bytes bytes);    ///< a file: opened, inspected, all channels of all parts read
void scene(Bytes bytes);  ///< a text: read, written, read again
void look(Bytes bytes);   ///< a text; behind "--set " a setting of the command line
void gltf(Bytes bytes);   ///< a .gltf or .glb that has no file beside it
void cli(Bytes bytes);    ///< the words of a command line, a line each; no verb runs

inline std::string text_of(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

/// Throws an exception other than Error when a promise does not hold.
inline void expect(bool holds, const char* promise) {
  if (!holds) throw std::logic_error(promise);
}

/// Whether `work` returned: false when it threw Error. The error's sentence must be readable.
template <class Work>
bool accepts(Work&& work) {
  constexpr std::size_t kMaxSentence = 1 << 16;
  try {
    work();
    return true;
  } catch (const Error& error) {
    const std::size_t size = std::string(error.what()).size();
    expect(size > 0 && size < kMaxSentence, "an Error has a sentence of moderate length");
    return false;
  }
}

}  // namespace limpid::fuzz
