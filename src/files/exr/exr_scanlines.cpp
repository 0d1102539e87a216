#include "files/exr/exr_scanlines.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <limits>
#include <mutex>

#include <OpenEXR/IlmThreadPool.h>
#include <OpenEXR/ImfInputPart.h>

#include "files/exr/exr_unpack.h"
#include "files/exr/half_bits.h"

namespace limpid {
namespace {

constexpr int kLeastLines = 16;  ///< least number of lines per task

template <class T>
T number_at(const char* bytes) {
  T number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// `count` samples as floats, `stride` apart.
template <class T, class Convert>
void convert(const char* from, int count, float* into, std::ptrdiff_t stride, Convert of) {
  if (stride == 1) {
    for (int i = 0; i < count; ++i) {
      into[i] = of(number_at<T>(from + static_cast<std::ptrdiff_t>(sizeof(T)) * i));
    }
  } else {
    for (int i = 0; i < count; ++i, into += stride) {
      *into = of(number_at<T>(from + static_cast<std::ptrdiff_t>(sizeof(T)) * i));
    }
  }
}

void convert(SampleType type, const char* from, int count, float* into, std::ptrdiff_t stride) {
  switch (type) {
    case SampleType::kHalf:
      return convert<std::uint16_t>(from, count, into, stride, float_of_half);
    case SampleType::kFloat:
      return convert<float>(from, count, into, stride, [](float f) { return f; });
    case SampleType::kUint:
      return convert<std::uint32_t>(from, count, into, stride,
                                    [](std::uint32_t u) { return static_cast<float>(u); });
  }
}

/// One stored channel for one of its requests.
struct Wanted {
  std::size_t channel;
  SampleType type;
  View<float> into;
};

/// The tasks of the workers: some lines each, from the top.
class Turns {
 public:
  Turns(const Imf::InputPart& part, const ExrHeader& header, std::vector<Wanted> wanted, Rect lines)
      : part_(part), header_(header), wanted_(std::move(wanted)), lines_(lines) {
    for (const Wanted& w : wanted_) channels_.push_back(w.channel);
    std::sort(channels_.begin(), channels_.end());
    channels_.erase(std::unique(channels_.begin(), channels_.end()), channels_.end());
  }

  /// Work of one worker: tasks until there are none.
  void work() {
    int turn = 0;
    try {
      ExrUnpacker unpacker(header_, channels_);
      const int data_y0 = header_.part.data.y0;
      const int height = std::max(kLeastLines, unpacker.lines_of_chunk());
      const int before = (lines_.y0 - data_y0) / height;
      while ((turn = next_++) < failed_) {
        const std::int64_t y0 = data_y0 + std::int64_t{before + turn} * height;
        if (y0 >= lines_.y1) return;
        read(unpacker, static_cast<int>(y0),
             static_cast<int>(std::min<std::int64_t>(y0 + height, lines_.y1)));
      }
    } catch (...) {
      fail(turn);
    }
  }

  /// After all work: throws the exception of the topmost failed task.
  void finish() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void read(ExrUnpacker& unpacker, int y0, int y1) {
    const Rect& data = header_.part.data;
    for (int y = y0; y < y1; y += unpacker.lines_of_chunk()) {
      const Rect chunk{data.x0, y, data.x1, std::min(y + unpacker.lines_of_chunk(), data.y1)};
      if (chunk.y1 <= lines_.y0) continue;
      int bytes = unpacker.capacity();
      part_.rawPixelDataToBuffer(y, unpacker.packed(), bytes);
      unpacker.unpack(bytes, chunk.height());
      for (const Wanted& w : wanted_) {
        const Rect inside = intersection(chunk, w.into.window);
        const std::ptrdiff_t skip =
            std::ptrdiff_t{inside.x0 - data.x0} * ExrUnpacker::bytes_of(w.type);
        for (int line = inside.y0; line < inside.y1 && !inside.empty(); ++line) {
          convert(w.type, unpacker.row(w.channel, line - y) + skip, inside.width(),
                  &w.into.at(inside.x0, line), w.into.x_stride);
        }
      }
    }
  }

  void fail(int turn) {
    const std::lock_guard lock(mutex_);
    if (turn >= failed_) return;
    failed_ = turn;
    failure_ = std::current_exception();
  }

  const Imf::InputPart& part_;
  const ExrHeader& header_;
  std::vector<Wanted> wanted_;
  std::vector<std::size_t> channels_;
  Rect lines_;
  std::atomic<int> next_ = 0, failed_ = std::numeric_limits<int>::max();
  std::mutex mutex_;
  std::exception_ptr failure_;
};

class Worker : public IlmThread::Task {
 public:
  Worker(IlmThread::TaskGroup* group, Turns& turns) : IlmThread::Task(group), turns_(turns) {}
  void execute() override { turns_.work(); }

 private:
  Turns& turns_;
};

}  // namespace

void read_scanlines(Imf::MultiPartInputFile& file, const ExrHeader& header,
                    std::span<const ExrRequest> requests, int workers) {
  const Rect& data = header.part.data;
  Rect lines{data.x0, data.y1, data.x1, data.y0};
  std::vector<Wanted> wanted;
  for (const ExrRequest& request : requests) {
    const auto& channels = header.part.channels;
    const auto channel = std::find_if(channels.begin(), channels.end(),
                                      [&](const auto& c) { return c.name == request.channel; });
    const Rect part = intersection(data, request.into.window);
    if (part.empty()) continue;
    lines.y0 = std::min(lines.y0, part.y0);
    lines.y1 = std::max(lines.y1, part.y1);
    wanted.push_back(
        {static_cast<std::size_t>(channel - channels.begin()), channel->type, request.into});
  }
  if (wanted.empty()) return;
  const Imf::InputPart part(file, requests[0].part);
  Turns turns(part, header, std::move(wanted), lines);
  if (workers < 2) {
    turns.work();
  } else {
    IlmThread::TaskGroup group;  // its destructor waits for all tasks
    for (int i = 0; i < workers; ++i) {
      IlmThread::ThreadPool::addGlobalTask(new Worker(&group, turns));
    }
  }
  turns.finish();
}

}  // namespace limpid
