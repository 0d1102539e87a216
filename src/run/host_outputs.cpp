#include "run/host_outputs.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

#include "limpid/core/error.h"

#include "run/shared_bytes.h"

namespace limpid {
namespace {

constexpr int kBandRows = 32;

std::string name_of(int index) {
  if (index < 3) return "color";
  if (index == 3) return "alpha";
  return "AOV " + std::string(aovs()[static_cast<std::size_t>(index - 4) / 3].name);
}

void validate(const HostOutput& view, int index, const Rect& work) {
  if (!view) {
    if (index < 3) throw Error("picture: no color, expected three channels of it");
    return;
  }
  const bool extra =
      index >= 4 && static_cast<std::size_t>(index - 4) % 3 >=
                        aovs()[static_cast<std::size_t>(index - 4) / 3].suffixes.size();
  if (extra) throw Error("picture: " + name_of(index) + " has fewer channels");
  if (!view.window.contains(work)) {
    throw Error("picture: " + name_of(index) + " does not cover the frame");
  }
  if (shares_bytes(view, work)) {
    throw Error("picture: " + name_of(index) +
                " has strides by which pixels share bytes, expected separate memory for each");
  }
}

void store_row(const float* from, const HostOutput& to, const Rect& work, int y,
               const HalfTarget& half) {
  std::byte* row = static_cast<std::byte*>(to.data) + (y - to.window.y0) * to.y_stride +
                   (work.x0 - to.window.x0) * to.x_stride;
  if (to.sample == Sample::kHalf) return half.narrow(from, row, to.x_stride, work.width());
  for (int x = 0; x < work.width(); ++x)
    std::memcpy(row + x * to.x_stride, from + x, sizeof(float));
}

/// Overlapping views would be overwritten by tiles in any order.
void validate_apart(const HostOutputs& host, const Rect& work) {
  for (std::size_t i = 0; i < host.size(); ++i) {
    for (std::size_t j = 0; host[i] && j < i; ++j) {
      if (!host[j] || !share_bytes(host[i], host[j], work)) continue;
      throw Error("picture: " + name_of(static_cast<int>(i)) + " shares bytes with " +
                  name_of(static_cast<int>(j)) + ", expected separate memory");
    }
  }
}

}  // namespace

const Target& HostTarget::prepare(const HostOutputs& host, const Rect& work) {
  for (int i = 0; i < kOutputCount; ++i) {
    validate(host[static_cast<std::size_t>(i)], i, work);
    const int first = i < 4 ? i : i - (i - 4) % 3;
    if (host[static_cast<std::size_t>(i)] && !host[static_cast<std::size_t>(first)]) {
      throw Error("picture: " + name_of(i) + " lacks its first channel");
    }
  }
  validate_apart(host, work);
  work_ = work;
  for (std::size_t i = 0; i < host.size(); ++i) {
    const HostOutput& view = host[i];
    View<float>& place = i < 3    ? target_.color[i]
                         : i == 3 ? target_.alpha
                                  : target_.aovs[(i - 4) / 3][(i - 4) % 3];
    stored_[i] = view && !is_floats(view) ? view : HostOutput{};
    if (stored_[i] && (!planes_[i] || planes_[i].view().window != work)) planes_[i] = Plane(work);
    place = stored_[i] ? planes_[i].view() : view ? floats_of(view) : View<float>{};
  }
  return target_;
}

void HostTarget::store(Executor& executor, const HalfTarget& half) const {
  struct Rows {
    const HostTarget& self;
    const HalfTarget& half;
  } rows{*this, half};
  if (std::none_of(stored_.begin(), stored_.end(), [](const auto& view) { return bool(view); })) {
    return;
  }
  const auto band = [](void* context, int index) {
    const auto& [self, convert] = *static_cast<const Rows*>(context);
    const Rect& work = self.work_;
    const int y0 = work.y0 + index * kBandRows, y1 = std::min(y0 + kBandRows, work.y1);
    for (std::size_t i = 0; i < self.stored_.size(); ++i) {
      if (!self.stored_[i]) continue;
      for (int y = y0; y < y1; ++y) {
        store_row(self.planes_[i].view().row(y), self.stored_[i], work, y, convert);
      }
    }
  };
  executor.run((work_.height() + kBandRows - 1) / kBandRows, band, &rows);
}

}  // namespace limpid
