#include <algorithm>
#include <iostream>
#include <streambuf>
#include <vector>

#include "limpid/files/text/frame_range.h"

#include "../../tools/limpid/arguments.h"
#include "../../tools/limpid/memory_limit.h"
#include "fuzz/harness.h"

namespace limpid::fuzz {
namespace {

/// Drops all printed bytes.
class Silence : public std::streambuf {
 public:
  Silence() : out_(std::cout.rdbuf(this)), error_(std::cerr.rdbuf(this)) {}
  ~Silence() override {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
  }

 private:
  int_type overflow(int_type letter) override { return traits_type::not_eof(letter); }
  std::streamsize xsputn(const char*, std::streamsize count) override { return count; }

  std::streambuf *out_, *error_;
};

/// The lines of a text without NUL, which no word of a command line can hold.
std::vector<std::string> words_of(std::string text) {
  std::replace(text.begin(), text.end(), '\0', '\n');
  std::vector<std::string> words = {"limpid"};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

void number_frames(const tool::FrameOptions& frames, const tool::WaterOptions& water) {
  accepts([&] {
    const std::vector<int> numbers = frames_of(frames.range);
    expect(!numbers.empty(), "a range has frames");
    name_of_frame(water.output, numbers.back());
  });
}

}  // namespace

void cli(Bytes bytes) {
  std::vector<std::string> words = words_of(text_of(bytes));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const Silence silence;
  const tool::Parsed parsed = tool::parse(static_cast<int>(arguments.size()) - 1, arguments.data());
  if (parsed.exit_code) {
    expect(*parsed.exit_code == 0 || *parsed.exit_code == 2, "parsing exits with 0 or 2");
    return;
  }
  const tool::Arguments& a = parsed.arguments;
  expect(a.verb != tool::Verb::kNone, "there is a verb to run, or an exit code");
  accepts([&] {
    expect(tool::memory_named(a.common.max_memory.value_or("")) >= 64 << 20,
           "memory is 64M at least");
  });
  number_frames(a.composite.frames, a.composite.water);
  number_frames(a.render.frames, a.render.water);
}

}  // namespace limpid::fuzz
