#include "files/picture/jpeg.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <new>
#include <vector>

#include <jpeglib.h>
// After jpeglib.h, whose types it needs.
#include <jerror.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using namespace std::string_view_literals;

/// Each scan of a progressive file covers the whole picture: few bytes may take hours.
constexpr int kMaxScans = 500;

/// The last message of libjpeg. libjpeg leaves its functions by longjmp(), so its callers, step()
/// and the functions passed to it, have no locals with destructors.
class Session {
 public:
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 protected:
  Session() {
    jpeg_std_error(&manager_.base);
    manager_.base.error_exit = on_error;
    manager_.base.emit_message = on_message;
    manager_.base.output_message = [](j_common_ptr) {};
  }

  /// Runs `work`, a function without captures. False if libjpeg has left it by longjmp().
  template <class Self>
  static bool step(Self& self, void (*work)(Self&)) {
    if (setjmp(self.manager_.jump) != 0) return false;
    work(self);
    return true;
  }

  bool no_memory() const { return manager_.base.msg_code == JERR_OUT_OF_MEMORY; }
  bool ended() const { return manager_.base.msg_code == JWRN_JPEG_EOF; }
  std::string said() const { return manager_.said.data(); }

  [[noreturn]] static void leave(j_common_ptr jpeg, const char* said) {
    auto& manager = *reinterpret_cast<Manager*>(jpeg->err);
    std::snprintf(manager.said.data(), manager.said.size(), "%s", said);
    std::longjmp(manager.jump, 1);
  }

  struct Manager {
    jpeg_error_mgr base;  // first: libjpeg passes a pointer to it
    std::jmp_buf jump;
    std::array<char, JMSG_LENGTH_MAX> said;
  } manager_{};

 private:
  [[noreturn]] static void on_error(j_common_ptr jpeg) {
    char said[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, said);
    leave(jpeg, said);
  }

  /// A warning for which libjpeg invents pixels is an error.
  static void on_message(j_common_ptr jpeg, int level) {
    if (level >= 0) return;
    switch (jpeg->err->msg_code) {
      case JWRN_ARITH_BAD_CODE:
      case JWRN_HIT_MARKER:
      case JWRN_HUFF_BAD_CODE:
      case JWRN_JPEG_EOF:
      case JWRN_MUST_RESYNC:
        on_error(jpeg);
      default:
        return;
    }
  }
};

class Reader : public Session {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    jpeg_.err = &manager_.base;
    if (!step<Reader>(*this, [](Reader& r) { jpeg_create_decompress(&r.jpeg_); })) {
      jpeg_destroy_decompress(&jpeg_);
      throw limpid::no_memory(name);
    }
    progress_.progress_monitor = on_progress;
    jpeg_.progress = &progress_;
  }
  ~Reader() { jpeg_destroy_decompress(&jpeg_); }

  Samples decode(const CheckHeader& check) {
    run([](Reader& r) {
      jpeg_mem_src(&r.jpeg_, reinterpret_cast<const unsigned char*>(r.bytes_.data()),
                   r.bytes_.size());
      jpeg_read_header(&r.jpeg_, TRUE);
    });
    Samples samples;
    samples.width = static_cast<int>(jpeg_.image_width);
    samples.height = static_cast<int>(jpeg_.image_height);
    const bool inks = jpeg_.out_color_space == JCS_CMYK;
    const int stored = inks ? 4 : jpeg_.out_color_space == JCS_RGB ? 3 : 1;
    if (stored != jpeg_.num_components) {
      throw Error(name_ + ": has " + std::to_string(jpeg_.num_components) +
                  " channels: expected 1, 3 or 4");
    }
    samples.channels = inks ? 3 : stored;
    check(samples);
    samples.bytes.resize(std::size_t{jpeg_.image_width} * jpeg_.image_height * samples.channels);
    row_.resize(std::size_t{jpeg_.image_width} * stored);
    run([](Reader& r) { jpeg_start_decompress(&r.jpeg_); });
    std::uint8_t* to = samples.bytes.data();
    while (jpeg_.output_scanline < jpeg_.output_height) {
      run([](Reader& r) {
        JSAMPROW row = r.row_.data();
        jpeg_read_scanlines(&r.jpeg_, &row, 1);
      });
      to = inks ? add_of_inks(to) : std::copy(row_.begin(), row_.end(), to);
    }
    run([](Reader& r) { jpeg_finish_decompress(&r.jpeg_); });
    return samples;
  }

 private:
  void run(void (*work)(Reader&)) {
    if (step(*this, work)) return;
    if (no_memory()) throw limpid::no_memory(name_);
    if (ended()) throw Error(name_ + ": ends too early: expected the rest of its pixels");
    throw Error(name_ + ": cannot be decoded: " + said());
  }

  /// Color is the light that passes the three inks and the black ink.
  std::uint8_t* add_of_inks(std::uint8_t* to) const {
    for (std::size_t i = 0; i < row_.size(); i += 4) {
      for (std::size_t c = 0; c < 3; ++c) {
        *to++ = static_cast<std::uint8_t>((row_[i + c] * row_[i + 3] + 127) / 255);
      }
    }
    return to;
  }

  static void on_progress(j_common_ptr jpeg) {
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMaxScans) {
      leave(jpeg, "it has more than 500 scans");
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  jpeg_decompress_struct jpeg_{};
  jpeg_progress_mgr progress_{};
  std::vector<std::uint8_t> row_;
};

class Writer : public Session {
 public:
  explicit Writer(const std::string& name) : name_(name) {
    jpeg_.err = &manager_.base;
    if (!step<Writer>(*this, [](Writer& w) { jpeg_create_compress(&w.jpeg_); })) {
      jpeg_destroy_compress(&jpeg_);
      throw limpid::no_memory(name);
    }
    target_.init_destination = [](j_compress_ptr jpeg) { self(jpeg).offer_block(); };
    target_.empty_output_buffer = [](j_compress_ptr jpeg) {
      self(jpeg).take_block(kBlockBytes);
      self(jpeg).offer_block();
      return TRUE;
    };
    target_.term_destination = [](j_compress_ptr jpeg) {
      self(jpeg).take_block(kBlockBytes - self(jpeg).target_.free_in_buffer);
    };
    jpeg_.dest = &target_;
    jpeg_.client_data = this;
  }
  ~Writer() { jpeg_destroy_compress(&jpeg_); }

  std::string encode(int width, int height, const std::uint8_t* rgb, int quality) {
    jpeg_.image_width = static_cast<JDIMENSION>(width);
    jpeg_.image_height = static_cast<JDIMENSION>(height);
    jpeg_.input_components = 3;
    jpeg_.in_color_space = JCS_RGB;
    rgb_ = rgb;
    quality_ = quality;
    const bool done = step<Writer>(*this, [](Writer& w) {
      jpeg_set_defaults(&w.jpeg_);
      jpeg_set_quality(&w.jpeg_, w.quality_, TRUE);
      jpeg_start_compress(&w.jpeg_, TRUE);
      while (w.jpeg_.next_scanline < w.jpeg_.image_height) {
        const std::size_t before = std::size_t{3} * w.jpeg_.image_width * w.jpeg_.next_scanline;
        JSAMPROW row = const_cast<JSAMPROW>(w.rgb_ + before);
        jpeg_write_scanlines(&w.jpeg_, &row, 1);
      }
      jpeg_finish_compress(&w.jpeg_);
    });
    if (!done && no_memory()) throw limpid::no_memory(name_);
    if (!done) throw Error(name_ + ": cannot be encoded as JPEG: " + said());
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 14;

  static Writer& self(j_compress_ptr jpeg) { return *static_cast<Writer*>(jpeg->client_data); }

  void offer_block() {
    target_.next_output_byte = block_.data();
    target_.free_in_buffer = block_.size();
  }

  void take_block(std::size_t bytes) {
    bool taken = true;
    try {
      out_.append(reinterpret_cast<const char*>(block_.data()), bytes);
    } catch (const std::bad_alloc&) {
      taken = false;
    }
    if (!taken) ERREXIT1(&jpeg_, JERR_OUT_OF_MEMORY, 0);
  }

  const std::string& name_;
  jpeg_compress_struct jpeg_{};
  jpeg_destination_mgr target_{};
  std::array<JOCTET, kBlockBytes> block_;
  const std::uint8_t* rgb_ = nullptr;
  int quality_ = 0;
  std::string out_;
};

}  // namespace

bool begins_as_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"sv); }

Samples decode_jpeg(std::string_view bytes, const std::string& name, const CheckHeader& check) {
  return Reader(bytes, name).decode(check);
}

std::string encode_jpeg(int width, int height, const std::uint8_t* rgb, int quality,
                        const std::string& name) {
  return Writer(name).encode(width, height, rgb, quality);
}

}  // namespace limpid
