#include "files/exr/exr_deep.h"

#include <algorithm>
#include <numeric>

#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>

#include "files/exr/exr_deep_chunks.h"

namespace limpid {
namespace {

constexpr std::int64_t kMaxLines = 32;
constexpr std::int64_t kMaxSamples = std::int64_t{1} << 20;

/// The address of pixel (0, 0) if that of the window's first pixel is `memory`. It may lie outside
/// the memory, so it is computed in integers.
char* origin_of(void* memory, const Rect& window, std::ptrdiff_t bytes) {
  const std::ptrdiff_t before = window.x0 + std::ptrdiff_t{window.y0} * window.width();
  return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(memory) -
                                 static_cast<std::uintptr_t>(before * bytes));
}

/// Reads one block of whole chunks: the counts first, then, after checking them against each
/// chunk's claim, the samples.
class BlockReader {
 public:
  BlockReader(std::span<const std::string> channels, const Limits& limits)
      : channels_(channels), limits_(limits), pointers_(channels.size()) {
    block_.values.resize(channels.size());
  }

  /// `claimed`: sample counts of the chunks, which all have the same size.
  Imf::DeepFrameBuffer begin(const Rect& window, std::span<const std::int64_t> claimed) {
    const std::int64_t samples = std::reduce(claimed.begin(), claimed.end());
    const auto pixels = static_cast<std::size_t>(window.area());
    const std::int64_t bytes =
        window.area() * (4 + 8 + 8 * std::ssize(channels_)) + samples * 4 * std::ssize(channels_);
    if (bytes > limits_.max_memory) {
      throw Error("deep pixels of " + std::to_string(bytes) +
                  " bytes in one piece need more memory than the limit of " +
                  std::to_string(limits_.max_memory) + " bytes");
    }
    block_.window = window;
    claimed_ = claimed;
    counts_.assign(pixels, 0);
    const auto slice_width = static_cast<std::size_t>(window.width());
    Imf::DeepFrameBuffer frame;
    frame.insertSampleCountSlice({Imf::UINT, origin_of(counts_.data(), window, sizeof(unsigned)),
                                  sizeof(unsigned), sizeof(unsigned) * slice_width});
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      pointers_[c].assign(pixels, nullptr);
      frame.insert(channels_[c],
                   {Imf::FLOAT, origin_of(pointers_[c].data(), window, sizeof(float*)),
                    sizeof(float*), sizeof(float*) * slice_width, sizeof(float)});
    }
    return frame;
  }

  void allocate() {
    block_.first.assign(counts_.size() + 1, 0);
    std::inclusive_scan(counts_.begin(), counts_.end(), block_.first.begin() + 1, std::plus<>(),
                        std::size_t{0});
    const std::size_t chunk = counts_.size() / claimed_.size();
    for (std::size_t i = 0; i < claimed_.size(); ++i) {
      const std::size_t counted = block_.first[(i + 1) * chunk] - block_.first[i * chunk];
      if (counted != static_cast<std::size_t>(claimed_[i])) {
        throw Error("truncated or damaged (" + std::to_string(counted) + " deep samples where " +
                    std::to_string(claimed_[i]) + " are stored)");
      }
    }
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      block_.values[c].resize(block_.first.back());
      for (std::size_t i = 0; i < counts_.size(); ++i) {
        pointers_[c][i] = block_.values[c].data() + block_.first[i];
      }
    }
  }

  const DeepBlock& block() const { return block_; }

 private:
  std::span<const std::string> channels_;
  const Limits& limits_;
  std::span<const std::int64_t> claimed_;
  std::vector<unsigned> counts_;
  std::vector<std::vector<float*>> pointers_;
  DeepBlock block_;
};

void read_lines(Imf::MultiPartInputFile& file, const DeepRequest& request,
                std::span<const std::int64_t> line_samples,
                const std::function<void(const DeepBlock&)>& sink) {
  const Rect& data = request.headers[request.part].part.data;
  Imf::DeepScanLineInputPart part(file, request.part);
  BlockReader reader(request.channels, request.limits);
  for (Rect lines = data; lines.y0 < data.y1; lines.y0 = lines.y1) {
    std::int64_t samples = 0;
    lines.y1 = lines.y0;
    while (lines.y1 < data.y1 && lines.y1 - lines.y0 < kMaxLines) {
      const std::int64_t more = line_samples[static_cast<std::size_t>(lines.y1 - data.y0)];
      if (lines.y1 > lines.y0 && samples + more > kMaxSamples) break;
      samples += more;
      ++lines.y1;
    }
    part.setFrameBuffer(
        reader.begin(lines, line_samples.subspan(static_cast<std::size_t>(lines.y0 - data.y0),
                                                 static_cast<std::size_t>(lines.height()))));
    part.readPixelSampleCounts(lines.y0, lines.y1 - 1);
    reader.allocate();
    part.readPixels(lines.y0, lines.y1 - 1);
    sink(reader.block());
  }
}

void read_tiles(Imf::MultiPartInputFile& file, const DeepRequest& request,
                std::span<const std::int64_t> tile_samples,
                const std::function<void(const DeepBlock&)>& sink) {
  const ExrHeader& header = request.headers[request.part];
  Imf::DeepTiledInputPart part(file, request.part);
  BlockReader reader(request.channels, request.limits);
  for (std::size_t tile = 0; tile < tile_samples.size(); ++tile) {
    const Rect window = deep_chunk_window(header, static_cast<std::int64_t>(tile));
    const auto column = static_cast<int>((window.x0 - header.part.data.x0) / header.tile_width);
    const auto row = static_cast<int>((window.y0 - header.part.data.y0) / header.tile_height);
    part.setFrameBuffer(reader.begin(window, tile_samples.subspan(tile, 1)));
    part.readPixelSampleCount(column, row);
    reader.allocate();
    part.readTile(column, row);
    sink(reader.block());
  }
}

}  // namespace

void read_deep_stored(Imf::MultiPartInputFile& file, FileStream& stream, const DeepRequest& request,
                      const std::function<void(const DeepBlock&)>& sink) {
  const std::string& compression = request.headers[request.part].part.compression;
  if (compression != "none" && compression != "rle" && compression != "zips") {
    throw Error("deep samples with compression '" + compression +
                "': expected one of none, rle, zips");
  }
  const std::vector<std::int64_t> samples =
      deep_chunk_samples(stream, request.headers, request.part, request.limits);
  if (request.headers[request.part].part.tiled) {
    read_tiles(file, request, samples, sink);
  } else {
    read_lines(file, request, samples, sink);
  }
}

}  // namespace limpid
