#include "files/picture/png.h"

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include <png.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n"sv;
constexpr std::size_t kMaxKey = 79, kMaxTexts = 1 << 20;
constexpr std::string_view kPrefix = "limpid/";  ///< of keys that are read
constexpr const char* kTooMuch = "records of how it was made: expected at most 1 MiB of text";
/// After the keyword: its end, not compressed, no method, no language, no translation.
constexpr std::string_view kBetween = "\0\0\0\0\0"sv;

/// The last message of libpng, and its cause. libpng leaves its functions by longjmp(), so its
/// callers, step() and the functions passed to it, have no locals with destructors.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 protected:
  static void* allocate(png_structp png, png_alloc_size_t size) {
    void* memory = std::malloc(size);
    if (memory == nullptr) static_cast<Session*>(png_get_mem_ptr(png))->no_memory_ = true;
    return memory;
  }
  static void release(png_structp, void* memory) { std::free(memory); }
  [[noreturn]] static void on_error(png_structp png, const char* said) {
    auto& self = *static_cast<Session*>(png_get_error_ptr(png));
    std::snprintf(self.said_.data(), self.said_.size(), "%s", said);
    png_longjmp(png, 1);
  }

  /// Runs `work`, a function without captures. False if libpng has left it by longjmp().
  template <class Self>
  static bool step(Self& self, png_structp png, void (*work)(Self&)) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    work(self);
    return true;
  }

  bool no_memory_ = false;
  std::array<char, 128> said_{};
};

class Reader : public Session {
 public:
  Reader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), left_(bytes), name_(name) {
    png_ = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, this, on_error, on_warning, this,
                                    allocate, release);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw no_memory(name);
    }
    png_set_read_fn(png_, this, read_bytes);
    // limpid has its own limits; those of libpng concern kinds of chunks that are not read.
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  Samples decode(const CheckHeader& check) {
    run([](Reader& r) {
      png_set_keep_unknown_chunks(r.png_, PNG_HANDLE_CHUNK_AS_DEFAULT,
                                  reinterpret_cast<png_const_bytep>("oFFs"), 1);
      png_read_info(r.png_, r.info_);
    });
    samples_ = header();
    check(samples_);
    const std::size_t row_bytes = std::size_t{static_cast<unsigned>(samples_.width)} *
                                  samples_.channels * (samples_.largest == 255 ? 1 : 2);
    samples_.bytes.resize(row_bytes * samples_.height);
    rows_.resize(samples_.height);
    for (std::size_t y = 0; y < rows_.size(); ++y) rows_[y] = samples_.bytes.data() + y * row_bytes;
    run([](Reader& r) {
      png_set_expand(r.png_);
      if (r.samples_.largest > 255 && std::endian::native == std::endian::little)
        png_set_swap(r.png_);
      png_set_interlace_handling(r.png_);
      png_read_update_info(r.png_, r.info_);
      if (png_get_rowbytes(r.png_, r.info_) * r.rows_.size() != r.samples_.bytes.size())
        png_error(r.png_, "the size of its rows is not that of its header");
      png_read_image(r.png_, r.rows_.data());
      png_read_end(r.png_, nullptr);
    });
    return std::move(samples_);
  }

  std::map<std::string, std::string> texts() {
    texts_only_ = true;
    run([](Reader& r) {
      // The limit covers pixel chunks, too, and no chunk is larger than its file.
      png_set_keep_unknown_chunks(r.png_, PNG_HANDLE_CHUNK_NEVER,
                                  reinterpret_cast<png_const_bytep>("IDAT"), 1);
      png_set_read_user_chunk_fn(r.png_, &r, take_chunk);
      png_set_chunk_malloc_max(r.png_, r.bytes_.size());
      png_read_info(r.png_, r.info_);
      png_read_end(r.png_, nullptr);
    });
    return std::move(texts_);
  }

 private:
  void run(void (*work)(Reader&)) {
    if (!step(*this, png_, work)) refuse();
  }

  [[noreturn]] void refuse() const {
    constexpr std::string_view kBadSum = ": CRC error";
    const std::string_view said = said_.data();
    if (no_memory_) throw no_memory(name_);
    if (too_many_texts_) throw Error(name_ + ": " + kTooMuch);
    if (ended_) throw Error(name_ + ": ends too early: expected the rest of its pixels");
    if (said.ends_with(kBadSum)) {
      throw Error(name_ + ": is damaged: wrong checksum of a chunk " +
                  std::string(said.substr(0, said.size() - kBadSum.size())));
    }
    if (said == "IDAT: Too much image data") {
      throw Error(name_ + ": is damaged: its pixels decompress to more than its size allows");
    }
    throw Error(name_ + ": is damaged: " + std::string(said));
  }

  Samples header() const {
    Samples header;
    header.width = static_cast<int>(png_get_image_width(png_, info_));
    header.height = static_cast<int>(png_get_image_height(png_, info_));
    const int type = png_get_color_type(png_, info_);
    const bool alpha =
        (type & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
    header.channels = ((type & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1) + (alpha ? 1 : 0);
    header.largest = png_get_bit_depth(png_, info_) == 16 ? 65535 : 255;
    png_int_32 x = 0, y = 0;
    int unit = PNG_OFFSET_PIXEL;
    if (png_get_oFFs(png_, info_, &x, &y, &unit) != 0 && unit == PNG_OFFSET_PIXEL) {
      header.x0 = x;
      header.y0 = y;
    }
    return header;
  }

  static void read_bytes(png_structp png, png_bytep to, std::size_t count) {
    auto& self = *static_cast<Reader*>(png_get_io_ptr(png));
    if (count > self.left_.size()) {
      self.ended_ = true;
      png_error(png, "ends too early");
    }
    std::memcpy(to, self.left_.data(), count);
    self.left_.remove_prefix(count);
  }

  /// libpng only warns of invalid data after the last pixel that it needs.
  static void on_warning(png_structp png, const char* said) {
    const std::string_view text = said;
    const bool of_pixels = text.starts_with("IDAT: ") && text != "IDAT: Extra compressed data";
    if (of_pixels && !static_cast<Reader*>(png_get_error_ptr(png))->texts_only_)
      on_error(png, said);
  }

  /// 1 to continue, -1 to stop.
  static int take_chunk(png_structp png, png_unknown_chunkp chunk) {
    auto& self = *static_cast<Reader*>(png_get_user_chunk_ptr(png));
    const std::string_view data(reinterpret_cast<const char*>(chunk->data), chunk->size);
    if (std::memcmp(chunk->name, "iTXt", 4) != 0 || !data.starts_with(kPrefix)) return 1;
    self.text_bytes_ += data.size();
    self.too_many_texts_ = self.text_bytes_ > kMaxTexts;
    if (self.too_many_texts_) return -1;
    const std::size_t end = data.find(kBetween);
    if (end == data.npos) return 1;
    try {
      self.texts_.insert_or_assign(std::string(data.substr(0, end)),
                                   std::string(data.substr(end + kBetween.size())));
    } catch (const std::bad_alloc&) {
      self.no_memory_ = true;
    }
    return self.no_memory_ ? -1 : 1;
  }

  std::string_view bytes_, left_;
  const std::string& name_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  Samples samples_;
  std::vector<png_bytep> rows_;
  std::map<std::string, std::string> texts_;
  std::size_t text_bytes_ = 0;
  bool texts_only_ = false, too_many_texts_ = false, ended_ = false;
};

class Writer : public Session {
 public:
  explicit Writer(const std::string& name) : name_(name) {
    png_ = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, this, on_error, on_warning, this,
                                     allocate, release);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw no_memory(name);
    }
    png_set_write_fn(png_, this, write_bytes, [](png_structp) {});
  }
  ~Writer() { png_destroy_write_struct(&png_, &info_); }

  std::string encode(int width, int height, int channels, const std::uint8_t* pixels,
                     const std::map<std::string, std::string>& texts) {
    for (const auto& [key, text] : texts) add(key, text);
    width_ = width;
    height_ = height;
    channels_ = channels;
    pixels_ = pixels;
    const bool done = step<Writer>(*this, png_, [](Writer& w) {
      png_set_IHDR(w.png_, w.info_, w.width_, w.height_, 8,
                   w.channels_ == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                   PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      png_set_sRGB(w.png_, w.info_, PNG_sRGB_INTENT_PERCEPTUAL);
      png_set_text(w.png_, w.info_, w.texts_.data(), static_cast<int>(w.texts_.size()));
      png_set_compression_level(w.png_, 2);  // of 9: a quarter of the time, files 10 % larger
      png_write_info(w.png_, w.info_);
      const std::size_t row_bytes = std::size_t{static_cast<unsigned>(w.width_)} * w.channels_;
      for (int y = 0; y < w.height_; ++y) png_write_row(w.png_, w.pixels_ + y * row_bytes);
      png_write_end(w.png_, nullptr);
    });
    if (!done && no_memory_) throw no_memory(name_);
    if (!done) throw Error(name_ + ": cannot be encoded as PNG: " + std::string(said_.data()));
    return std::move(out_);
  }

 private:
  void add(const std::string& key, const std::string& text) {
    const bool ascii =
        std::all_of(key.begin(), key.end(), [](char c) { return c > ' ' && c < '\x7f'; });
    if (key.empty() || key.size() > kMaxKey || !ascii) {
      throw Error(name_ + ": text '" + key + "': expected a name of 1 ... 79 letters of ASCII");
    }
    text_bytes_ += key.size() + text.size() + kBetween.size();
    if (text_bytes_ > kMaxTexts) throw Error(name_ + ": " + kTooMuch);
    png_text& chunk = texts_.emplace_back();
    chunk.compression = PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<char*>(key.c_str());  // libpng copies both
    chunk.text = const_cast<char*>(text.c_str());
    chunk.itxt_length = text.size();
  }

  static void on_warning(png_structp, const char*) {}

  static void write_bytes(png_structp png, png_bytep from, std::size_t count) {
    auto& self = *static_cast<Writer*>(png_get_io_ptr(png));
    try {
      self.out_.append(reinterpret_cast<const char*>(from), count);
    } catch (const std::bad_alloc&) {
      self.no_memory_ = true;
    }
    if (self.no_memory_) png_error(png, "no memory");
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  const std::string& name_;
  int width_ = 0, height_ = 0, channels_ = 0;
  const std::uint8_t* pixels_ = nullptr;
  std::vector<png_text> texts_;
  std::size_t text_bytes_ = 0;
  std::string out_;
};

}  // namespace

bool begins_as_png(std::string_view bytes) { return bytes.starts_with(kSignature); }

Samples decode_png(std::string_view bytes, const std::string& name, const CheckHeader& check) {
  return Reader(bytes, name).decode(check);
}

std::string encode_png(int width, int height, int channels, const std::uint8_t* pixels,
                       const std::map<std::string, std::string>& texts, const std::string& name) {
  return Writer(name).encode(width, height, channels, pixels, texts);
}

std::map<std::string, std::string> png_texts(std::string_view bytes, const std::string& name) {
  return Reader(bytes, name).texts();
}

}  // namespace limpid
