#include "limpid/files/exr/exr_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <mutex>
#include <new>
#include <set>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfThreading.h>

#include "core/threads.h"
#include "files/content_hash.h"
#include "files/exr/exr_deep.h"
#include "files/exr/exr_header.h"
#include "files/exr/exr_pixels.h"
#include "files/exr/exr_scanlines.h"
#include "files/exr/exr_unpack.h"
#include "files/file_hash.h"
#include "files/want_of_memory.h"

namespace limpid {
namespace {

constexpr std::size_t kMaxNamesInError = 40;

/// OpenEXR's message without the leading file name, as part of a sentence.
std::string cause(const std::string& message, const std::string& path) {
  const std::string quoted = "\"" + path + "\". ";
  const std::size_t at = message.rfind(quoted);
  std::string text = at == std::string::npos ? message : message.substr(at + quoted.size());
  while (!text.empty() &&
         (text.back() == '.' || std::isspace(static_cast<unsigned char>(text.back()))))
    text.pop_back();
  for (std::size_t dot = text.find(". "); dot != std::string::npos; dot = text.find(". ")) {
    text[dot] = ',';
  }
  if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1]))) {
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  }
  return text;
}

/// Names in a damaged header may contain any bytes: control characters become '?'.
std::string printable(std::string text) {
  for (char& c : text) {
    if (std::iscntrl(static_cast<unsigned char>(c))) c = '?';
  }
  return text;
}

/// Runs `work`; rethrows any exception as an Error that begins with the path.
template <class Work>
void with_path(const std::filesystem::path& path, Work work) {
  const std::string name = path.string();
  try {
    work();
  } catch (const Error& error) {
    const std::string text = error.what(), prefix = name + ": ";
    const bool prefixed = text.starts_with(prefix);
    throw Error(prefix + printable(prefixed ? text.substr(prefix.size()) : text), error.fault());
  } catch (const std::bad_alloc&) {
    throw no_memory(name);
  } catch (const std::exception& error) {
    if (is_for_want_of_memory(error)) throw no_memory(name);
    throw Error(name + ": truncated or damaged (" + printable(cause(error.what(), name)) + ")");
  } catch (...) {
    throw Error(name + ": truncated or damaged");
  }
}

/// Little-endian, like all numbers in the file.
template <class Bits>
Bits bits_of(const char* bytes) {
  Bits bits = 0;
  for (std::size_t i = sizeof(Bits); i-- > 0;) {
    bits = (bits << 8) | static_cast<unsigned char>(bytes[i]);
  }
  return bits;
}

float f32_of(const char* bytes) { return std::bit_cast<float>(bits_of<std::uint32_t>(bytes)); }
double f64_of(const char* bytes) { return std::bit_cast<double>(bits_of<std::uint64_t>(bytes)); }

std::string label(const std::vector<ExrPart>& parts, int part) {
  const std::string& name = parts[part].name;
  return "part " + std::to_string(part) + (name.empty() ? "" : " ('" + name + "')");
}

/// Throws Error if there is no such part.
const ExrPart& checked_part(const std::vector<ExrPart>& parts, int part) {
  if (part < 0 || part >= static_cast<int>(parts.size())) {
    throw Error("part " + std::to_string(part) + ": expected 0 ... " +
                std::to_string(parts.size() - 1));
  }
  return parts[part];
}

/// Throws Error unless the part has such a channel, without subsampling.
void check_channel(const ExrPart& part, const std::string& where, const std::string& name) {
  const auto channel = std::find_if(part.channels.begin(), part.channels.end(),
                                    [&](const ExrChannel& c) { return c.name == name; });
  if (channel == part.channels.end()) {
    std::vector<std::string> known, listed;
    for (const ExrChannel& c : part.channels) known.push_back(c.name);
    listed.assign(known.begin(), known.begin() + std::min(known.size(), kMaxNamesInError));
    if (listed.size() < known.size()) {
      listed.push_back("... (" + std::to_string(known.size()) + " in all)");
    }
    throw Error("no channel '" + name + "' in " + where + ": expected one of " + join(listed) +
                did_you_mean(name, known));
  }
  if (channel->x_sampling != 1 || channel->y_sampling != 1) {
    throw Error("channel '" + name + "' is stored for every " +
                std::to_string(channel->x_sampling) + "x" + std::to_string(channel->y_sampling) +
                " pixels, which is supported for Y RY BY only");
  }
}

/// Throws Error unless the requests fit the file.
void check_requests(const std::vector<ExrPart>& parts, std::span<const ExrRequest> requests,
                    const Limits& limits) {
  std::int64_t bytes = 0;
  for (const ExrRequest& request : requests) {
    const ExrPart& part = checked_part(parts, request.part);
    const std::string where = label(parts, request.part);
    if (part.deep) throw Error(where + " holds deep samples: expected flat pixels");
    check_channel(part, where, request.channel);
    if (!request.into) throw Error("channel '" + request.channel + "' has no memory to be read to");
    bytes += request.into.window.area() * std::int64_t{sizeof(float)};
    if (bytes > limits.max_memory) {
      throw Error("the channels need more memory than the limit of " +
                  std::to_string(limits.max_memory) + " bytes");
    }
  }
}

/// limpid's own parse of the headers decides allocations: OpenEXR's parse must be equal.
void check_same(const Imf::MultiPartInputFile& image, const std::vector<ExrHeader>& headers) {
  bool same = static_cast<std::size_t>(image.parts()) == headers.size();
  for (int i = 0; same && i < image.parts(); ++i) {
    const Imath::Box2i& data = image.header(i).dataWindow();
    same = headers[i].part.data == Rect{data.min.x, data.min.y, data.max.x + 1, data.max.y + 1};
  }
  if (!same) throw Error("damaged header (it is ambiguous)");
}

}  // namespace

struct __attribute__((visibility("hidden"))) ExrFile::State {
  State(const std::filesystem::path& path, const Limits& chosen)
      : file(std::make_shared<FileHandle>(path)), stream(file), limits(chosen) {
    headers = read_exr_headers(stream, limits);
    header_end = stream.tellg();
    check_exr_headers(headers, limits, header_end, file->size());
    stream.seekg(0);
    threads = threads_for(headers, limits);
    image.emplace(stream, threads, /*reconstructChunkOffsetTable=*/false);
    check_same(*image, headers);
    for (const ExrHeader& header : headers) parts.push_back(shown_part(header.part));
  }

  void read(std::span<const ExrRequest> requests) {
    std::map<int, std::vector<ExrRequest>> by_part;
    std::set<int> decoded = decoded_parts;
    for (const ExrRequest& request : requests) {
      by_part[request.part].push_back(request);
      decoded.insert(request.part);
    }
    check_decoded_parts(headers, decoded, limits);
    decoded_parts = std::move(decoded);
    for (const auto& [part, wanted] : by_part) read_part(wanted);
  }

  void read_lines(int part, std::span<const std::string> channels, LineRange lines,
                  std::span<char* const> into) {
    const ExrHeader& header = headers[part];
    for (const std::string& name : channels) {
      if (find_channel(header.part, name) == nullptr) {
        throw Error("channel '" + name + "' in " + label(parts, part) +
                    " is computed from luminance and chroma: expected a stored channel");
      }
    }
    std::set<int> decoded = decoded_parts;
    decoded.insert(part);
    check_decoded_parts(headers, decoded, limits);
    decoded_parts = std::move(decoded);
    limpid::read_lines(*image, header, part, channels, lines, into);
  }

  void read_part(std::span<const ExrRequest> requests) {
    const ExrHeader& header = headers[requests[0].part];
    fill_outside(header.part.data, requests);
    std::vector<ExrRequest> stored;
    std::map<std::string, std::vector<ExrRequest>> luma;  // by layer
    for (const ExrRequest& request : requests) {
      const std::string layer = layer_of(request.channel);
      const std::string name = request.channel.substr(layer.size());
      const bool color = name == "R" || name == "G" || name == "B";
      const bool is_luma = color && is_luminance_chroma(header.part, layer);
      (is_luma ? luma[layer] : stored).push_back(request);
    }
    if (!luma.empty() && requests[0].part > 0) {
      throw Error("luminance-chroma channels in " + label(parts, requests[0].part) +
                  ": expected them in the first part");
    }
    if (!stored.empty() && ExrUnpacker::knows(header)) {
      read_scanlines(*image, header, stored, threads);
    } else if (!stored.empty()) {
      limpid::read_stored(*image, header, stored);
    }
    for (const auto& [layer, wanted] : luma) {
      FileStream own(file);
      read_luminance_chroma(own, header, layer, wanted);
    }
  }

  void read_deep(int part, std::span<const std::string> channels,
                 const std::function<void(const DeepBlock&)>& sink) {
    FileStream own(file);
    own.seekg(header_end);
    read_deep_stored(*image, own, {headers, part, channels, limits}, sink);
  }

  /// The attribute's bytes if it exists with that type and enough bytes, else null.
  const std::vector<char>* find(int part, const std::string& name, std::string_view type,
                                std::size_t bytes) const {
    const auto& attributes = headers[checked(part)].attributes;
    const auto found = attributes.find(name);
    const bool fits = found != attributes.end() && found->second.type == type &&
                      found->second.bytes.size() >= bytes;
    return fits ? &found->second.bytes : nullptr;
  }

  int checked(int part) const {
    with_path(file->path(), [&] { checked_part(parts, part); });
    return part;
  }

  std::shared_ptr<const FileHandle> file;
  FileStream stream;
  Limits limits;
  std::vector<ExrHeader> headers;
  std::uint64_t header_end = 0;
  std::vector<ExrPart> parts;
  int threads = 0;
  std::optional<Imf::MultiPartInputFile> image;
  std::set<int> decoded_parts;  ///< parts whose buffers `image` keeps
  std::mutex mutex;
};

ExrFile::ExrFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
ExrFile::ExrFile(ExrFile&&) noexcept = default;
ExrFile& ExrFile::operator=(ExrFile&&) noexcept = default;
ExrFile::~ExrFile() = default;

ExrFile ExrFile::open(const std::filesystem::path& path, const Limits& limits) {
  std::unique_ptr<State> state;
  with_path(path, [&] { state = std::make_unique<State>(path, limits); });
  return ExrFile(std::move(state));
}

const std::filesystem::path& ExrFile::path() const { return state_->file->path(); }

const std::vector<ExrPart>& ExrFile::parts() const { return state_->parts; }

const Limits& ExrFile::limits() const { return state_->limits; }

void ExrFile::read(std::span<const ExrRequest> requests) const {
  if (requests.empty()) return;
  with_path(path(), [&] {
    check_requests(state_->parts, requests, state_->limits);
    const std::lock_guard lock(state_->mutex);
    state_->read(requests);
  });
}

void ExrFile::read_stored(int part, std::span<const std::string> channels, int y0, int y1,
                          std::span<char* const> into) const {
  if (channels.empty() || y0 >= y1) return;
  with_path(path(), [&] {
    const ExrPart& asked = checked_part(parts(), part);
    const std::string where = label(parts(), part);
    if (asked.deep) throw Error(where + " holds deep samples: expected flat pixels");
    for (const std::string& channel : channels) check_channel(asked, where, channel);
    const std::lock_guard lock(state_->mutex);
    state_->read_lines(part, channels, {y0, y1}, into);
  });
}

void ExrFile::read_deep(int part, std::span<const std::string> channels,
                        const std::function<void(const DeepBlock&)>& sink) const {
  with_path(path(), [&] {
    const ExrPart& asked = checked_part(parts(), part);
    const std::string where = label(parts(), part);
    if (!asked.deep) throw Error(where + " holds flat pixels: expected deep samples");
    for (const std::string& channel : channels) check_channel(asked, where, channel);
    const std::lock_guard lock(state_->mutex);
    state_->read_deep(part, channels, sink);
  });
}

bool ExrFile::is_whole() const {
  const std::vector<ExrHeader>& headers = state_->headers;
  const auto is_tiled = [](const ExrHeader& header) { return header.part.tiled; };
  if (std::any_of(headers.begin(), headers.end(), is_tiled)) return false;
  FileStream own(state_->file);
  own.seekg(state_->header_end);
  try {
    return has_all_chunks(own, headers);
  } catch (const Iex::InputExc&) {
    return false;  // truncated
  }
}

std::optional<bool> ExrFile::is_as_written() const {
  const std::optional<FileHash> hash = file_hash(*state_->file, state_->header_end);
  if (!hash) return std::nullopt;
  return hash->said == hash->found;
}

std::string ExrFile::content_hash() const { return hash_of(*state_->file); }

std::optional<std::array<float, 16>> ExrFile::matrix_attribute(int part,
                                                               const std::string& name) const {
  std::array<float, 16> matrix;
  if (const std::vector<char>* floats = state_->find(part, name, "m44f", 64)) {
    for (std::size_t i = 0; i < 16; ++i) matrix[i] = f32_of(floats->data() + 4 * i);
  } else if (const std::vector<char>* doubles = state_->find(part, name, "m44d", 128)) {
    for (std::size_t i = 0; i < 16; ++i) {
      matrix[i] = static_cast<float>(f64_of(doubles->data() + 8 * i));
    }
  } else {
    return std::nullopt;
  }
  return matrix;
}

std::optional<double> ExrFile::number_attribute(int part, const std::string& name) const {
  if (const std::vector<char>* bytes = state_->find(part, name, "float", 4)) {
    return f32_of(bytes->data());
  }
  if (const std::vector<char>* bytes = state_->find(part, name, "double", 8)) {
    return f64_of(bytes->data());
  }
  if (const std::vector<char>* bytes = state_->find(part, name, "int", 4)) {
    return static_cast<std::int32_t>(bits_of<std::uint32_t>(bytes->data()));
  }
  return std::nullopt;
}

std::optional<std::string> ExrFile::text_attribute(int part, const std::string& name) const {
  const std::vector<char>* bytes = state_->find(part, name, "string", 0);
  if (bytes == nullptr) return std::nullopt;
  return std::string(bytes->begin(), bytes->end());
}

std::map<std::string, ExrFile::Attribute> ExrFile::attributes(int part) const {
  std::map<std::string, Attribute> passed = state_->headers[state_->checked(part)].attributes;
  std::erase_if(passed, [](const auto& entry) { return is_structural(entry.first); });
  return passed;
}

void set_file_threads(int count) {
  const int threads = count > 1 ? threads_to_be_had(count, usual_stack_bytes()) : 0;
  Imf::setGlobalThreadCount(threads > 1 ? threads : 0);
}

}  // namespace limpid
