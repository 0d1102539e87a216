#include "limpid/core/plane.h"

#include <cstdlib>
#include <memory>
#include <new>
#include <string>

#include "limpid/core/error.h"

namespace limpid {
namespace {
constexpr std::size_t kAlignment = 64;
constexpr std::ptrdiff_t kFloatsPerLine = kAlignment / sizeof(float);
}  // namespace

void Plane::Free::operator()(float*) const { std::free(block); }

Plane::Plane(Rect window) : window_(window) {
  if (window.empty()) {
    throw Error("plane of " + std::to_string(window.width()) + "x" +
                std::to_string(window.height()) + " pixels: expected at least 1x1");
  }
  y_stride_ = (window.width() + kFloatsPerLine - 1) / kFloatsPerLine * kFloatsPerLine;
  const std::size_t bytes = static_cast<std::size_t>(y_stride_) *
                            static_cast<std::size_t>(window.height()) * sizeof(float);
  // Fresh memory is zero already, and is mapped page by page by the threads that fill it: clearing
  // would touch all of it once more, on one thread. calloc() clears only reused memory.
  std::size_t space = bytes + kAlignment;
  void* block = std::calloc(space, 1);
  if (block == nullptr) throw std::bad_alloc();
  void* first = block;
  std::align(kAlignment, bytes, first, space);
  data_ = {static_cast<float*>(first), Free{block}};
}

}  // namespace limpid
