#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "raster/clip.h"
#include "raster/raster_job.h"

namespace limpid::raster {

/// An array that keeps its memory and does not clear it.
template <class T>
class Buffer {
 public:
  /// At least `count` elements; growing discards the content.
  T* take(std::size_t count) {
    if (count > size_) {
      data_ = std::make_unique_for_overwrite<T[]>(count);
      size_ = count;
    }
    return data_.get();
  }
  T* data() { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t size_ = 0;
};

/// A range of an instance's triangles, set up and sorted into tiles by one task.
class Group {
 public:
  Group(const DrawnInstance& instance, int first, int count)
      : instance_(&instance), first_(first), count_(count) {}
  /// Reuses the memory for another draw.
  void reset(const DrawnInstance& instance, int first, int count);

  void set_up(const RasterTarget& target, const Screen& screen, const Corner* corners);
  /// Corners made by clipping are in `corners` from `first` on. `more` may be null.
  void place_new_corners(std::uint32_t first, Corner* corners, Attributes* attributes,
                         MoreAttributes* more);

  std::uint32_t new_corners() const { return static_cast<std::uint32_t>(clipped_.corners.size()); }
  const GroupView& view() const { return view_; }
  AlphaMode alpha() const { return instance_->alpha; }

 private:
  struct TileBox {
    std::int16_t x0, y0, x1, y1;  ///< inclusive; x1 < x0 if empty
  };
  void sort_into_tiles();

  const DrawnInstance* instance_;
  int first_, count_;
  int whole_ = 0, total_ = 0;
  Buffer<Triangle> triangles_;
  Buffer<TileBox> boxes_;
  Buffer<std::uint32_t> entries_, offsets_;
  ClippedPieces clipped_;
  GroupView view_{};
};

}  // namespace limpid::raster
