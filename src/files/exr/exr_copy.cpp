#include "files/exr/exr_copy.h"

#include <algorithm>
#include <cstring>

#include "limpid/core/error.h"

namespace limpid {

Imf::PixelType pixel_type_of(SampleType type) {
  switch (type) {
    case SampleType::kHalf:
      return Imf::HALF;
    case SampleType::kFloat:
      return Imf::FLOAT;
    case SampleType::kUint:
      return Imf::UINT;
  }
  return Imf::FLOAT;
}

CopiedRows::CopiedRows(const ExrCopy& copy) : copy_(copy) {
  const ExrPart& part = copy.from->parts().at(static_cast<std::size_t>(copy.part));
  data_ = part.data;
  for (const std::string& name : copy.channels) {
    const auto found = std::find_if(part.channels.begin(), part.channels.end(),
                                    [&](const ExrChannel& c) { return c.name == name; });
    if (found == part.channels.end()) {
      throw Error("no channel '" + name + "' to copy in " + copy.from->path().string());
    }
    types_.push_back(found->type);
    pixel_bytes_ += found->type == SampleType::kHalf ? 2 : 4;
  }
}

std::size_t CopiedRows::bytes_of(std::size_t channel) const {
  return types_[channel] == SampleType::kHalf ? 2 : 4;
}

void CopiedRows::read(const Rect& block, std::span<char* const> into) {
  const Rect inside = intersection(block, data_);
  if (inside == block && block.width() == data_.width()) {
    copy_.from->read_stored(copy_.part, copy_.channels, block.y0, block.y1, into);
    return;
  }
  for (std::size_t i = 0; i < types_.size(); ++i) {
    std::memset(into[i], 0, static_cast<std::size_t>(block.area()) * bytes_of(i));
  }
  if (inside.empty()) return;
  rows_.resize(static_cast<std::size_t>(line_bytes() * inside.height()));
  std::vector<char*> from;
  char* place = rows_.data();
  for (std::size_t i = 0; i < types_.size(); ++i) {
    from.push_back(place);
    place +=
        std::ptrdiff_t{data_.width()} * inside.height() * static_cast<std::ptrdiff_t>(bytes_of(i));
  }
  copy_.from->read_stored(copy_.part, copy_.channels, inside.y0, inside.y1, from);
  for (std::size_t i = 0; i < types_.size(); ++i) {
    const auto bytes = static_cast<std::ptrdiff_t>(bytes_of(i));
    for (int y = inside.y0; y < inside.y1; ++y) {
      const char* row = from[i] + bytes * (std::ptrdiff_t{y - inside.y0} * data_.width() +
                                           (inside.x0 - data_.x0));
      char* to =
          into[i] + bytes * (std::ptrdiff_t{y - block.y0} * block.width() + (inside.x0 - block.x0));
      std::memcpy(to, row, static_cast<std::size_t>(bytes * inside.width()));
    }
  }
}

}  // namespace limpid
