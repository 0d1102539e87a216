#include "plate/plate_file.h"

#include <algorithm>
#include <string>

#include "limpid/core/error.h"

#include "files/content_hash.h"
#include "plate/primaries.h"

namespace limpid {
namespace {

/// Premultiplies the color of a picture with straight alpha, in place: the chain needs
/// premultiplied color.
void premultiply(ImageFile& image) {
  const auto found = std::find(image.channels.begin(), image.channels.end(), "A");
  if (found == image.channels.end()) return;
  const std::size_t alpha = static_cast<std::size_t>(found - image.channels.begin());
  const Rect& w = image.window;
  for (std::size_t i = 0; i < image.planes.size(); ++i) {
    if (i == alpha) continue;
    const View<float> color = image.planes[i].view(), a = image.planes[alpha].view();
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) color.at(x, y) *= a.at(x, y);
    }
  }
}

}  // namespace

PlateFile PlateFile::open(const std::filesystem::path& path, const Limits& limits) {
  PlateFile file;
  file.path = path;
  if (holds_exr(path)) {
    file.exr = ExrFile::open(path, limits);
    file.parts = file.exr->parts();
    return file;
  }
  file.image = read_image(path, limits);
  if (file.image->straight_alpha) premultiply(*file.image);
  ExrPart part;
  part.data = part.display = file.image->window;
  part.compression = "none";
  for (const std::string& name : file.image->channels) {
    part.channels.push_back({name, SampleType::kFloat, 1, 1});
  }
  file.parts = {part};
  return file;
}

std::string PlateFile::content_hash() const {
  return exr ? exr->content_hash() : hash_of_file(path);
}

std::string PlateFile::color_space() const {
  if (!exr) return "";
  try {
    const auto told = told_primaries(exr->attributes(0));
    return told ? to_string(*told) : "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::map<std::string, std::string> PlateFile::made() const {
  std::map<std::string, std::string> texts;
  if (exr) {
    for (const auto& [name, attribute] : exr->attributes(0)) {
      if (attribute.type == "string") {
        texts[name] = {attribute.bytes.begin(), attribute.bytes.end()};
      }
    }
  } else {
    texts = read_image_texts(path);
  }
  std::erase_if(texts, [](const auto& text) { return !text.first.starts_with("limpid/"); });
  return texts;
}

void PlateFile::read(std::span<const ExrRequest> requests) const {
  if (exr) return exr->read(requests);
  for (const ExrRequest& r : requests) {
    const auto found = std::find(image->channels.begin(), image->channels.end(), r.channel);
    const View<const float> from =
        image->planes[static_cast<std::size_t>(found - image->channels.begin())].view();
    const Rect& w = r.into.window;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        const bool inside = from.window.contains({x, y, x + 1, y + 1});
        r.into.at(x, y) = inside ? from.at(x, y) : r.missing;
      }
    }
  }
}

}  // namespace limpid
