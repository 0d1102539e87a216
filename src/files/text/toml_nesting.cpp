#include "files/text/toml_nesting.h"

#include <algorithm>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr int kDeepest = 16;

/// Goes over a text token by token; what is no TOML is left for the parser to refuse.
class Nesting {
 public:
  Nesting(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void check() {
    while (at_ < text_.size()) {
      const char letter = text_[at_];
      if (letter == '"' || letter == '\'') {
        skip_string(letter);
        continue;
      }
      if (letter == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ < text_.size()) take(text_[at_++]);
    }
  }

 private:
  void take(char letter) {
    switch (letter) {
      case '.':  // of a key, or of a number, where another cannot follow
        if (++dots_ > kDeepest) refuse("a key of more than " + std::to_string(kDeepest) + " dots");
        break;
      case '[':
      case '{':
        dots_ = 0;
        if (++depth_ > kDeepest) {
          refuse("brackets nested more than " + std::to_string(kDeepest) + " deep");
        }
        break;
      case ']':
      case '}':
        dots_ = 0;
        depth_ = std::max(depth_ - 1, 0);
        break;
      case '\n':
      case ',':
      case '=':
        dots_ = 0;
        break;
    }
  }

  /// A string ends at its quote or, in error, with the line; one of three quotes at three.
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool long_one = text_.substr(at_).starts_with(three);
    const std::string_view end = std::string_view(three).substr(0, long_one ? 3 : 1);
    at_ += end.size();
    while (at_ < text_.size() && !text_.substr(at_).starts_with(end)) {
      if (text_[at_] == '\n' && !long_one) return;
      at_ += text_[at_] == '\\' && quote == '"' ? 2 : 1;
    }
    at_ = std::min(at_ + end.size(), text_.size());
    // The last three of up to five quotes are the end.
    for (int more = 0; long_one && more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) {
      ++at_;
    }
  }

  [[noreturn]] void refuse(const std::string& what) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<long>(at_ - 1), '\n');
    throw Error(name_ + ":" + std::to_string(line) + ": " + what);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int dots_ = 0, depth_ = 0;
};

}  // namespace

void check_toml_nesting(std::string_view text, const std::string& name) {
  Nesting(text, name).check();
}

}  // namespace limpid
