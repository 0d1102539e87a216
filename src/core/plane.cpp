#include "limpid/core/plane.h"

#include <cstring>
#include <new>
#include <string>

#include "limpid/core/error.h"

namespace limpid {
namespace {
constexpr std::size_t kAlignment = 64;
constexpr std::ptrdiff_t kFloatsPerLine = kAlignment / sizeof(float);
}  // namespace

void Plane::Free::operator()(float* p) const {
  ::operator delete (p, std::align_val_t{kAlignment});
}

Plane::Plane(Rect window) : window_(window) {
  if (window.empty()) {
    throw Error("plane of " + std::to_string(window.width()) + "x" +
                std::to_string(window.height()) + " pixels: expected at least 1x1");
  }
  y_stride_ = (window.width() + kFloatsPerLine - 1) / kFloatsPerLine * kFloatsPerLine;
  const std::size_t bytes = static_cast<std::size_t>(y_stride_) *
                            static_cast<std::size_t>(window.height()) * sizeof(float);
  data_.reset(static_cast<float*>(::operator new (bytes, std::align_val_t{kAlignment})));
  std::memset(data_.get(), 0, bytes);
}

}  // namespace limpid
