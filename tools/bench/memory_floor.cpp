#include "memory_floor.h"

#include <algorithm>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace limpid::bench {
namespace {

constexpr PlaneId kPlanes[3][3] = {
    {PlaneId::kColorR, PlaneId::kReflectionR, PlaneId::kDepth},
    {PlaneId::kColorG, PlaneId::kReflectionG, PlaneId::kSurfaceDepth},
    {PlaneId::kColorB, PlaneId::kReflectionB, PlaneId::kShadow}};
/// One output plane at a time: as fast as whole cache lines of all twelve planes by AVX-512.
constexpr int kRun = 256;
constexpr int kBandRows = 16;

void add(const float* a, const float* b, const float* c, float* out, int count) {
  int i = 0;
#ifdef __SSE__
  for (; i + 4 <= count; i += 4) {
    const __m128 sum = _mm_add_ps(_mm_load_ps(a + i), _mm_load_ps(b + i));
    _mm_stream_ps(out + i, _mm_add_ps(sum, _mm_load_ps(c + i)));
  }
#endif
  for (; i < count; ++i) out[i] = a[i] + b[i] + c[i];
}

struct Bands {
  const Frame& frame;
  const Target& target;

  static void run(void* context, int index) {
    const Bands& bands = *static_cast<const Bands*>(context);
    const Rect& w = bands.frame.display;
    const int end = std::min(w.y0 + (index + 1) * kBandRows, w.y1);
    for (int y = w.y0 + index * kBandRows; y < end; ++y) {
      for (int x = w.x0; x < w.x1; x += kRun) {
        for (int c = 0; c < 3; ++c) {
          const auto from = [&](int i) { return &bands.frame.plane(kPlanes[c][i]).at(x, y); };
          add(from(0), from(1), from(2), &bands.target.color[c].at(x, y), std::min(kRun, w.x1 - x));
        }
      }
    }
  }
};

}  // namespace

void run_memory_floor(const Frame& frame, const Target& target, Executor& executor) {
  Bands bands{frame, target};
  executor.run((frame.display.height() + kBandRows - 1) / kBandRows, Bands::run, &bands);
}

}  // namespace limpid::bench
