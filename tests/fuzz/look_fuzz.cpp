#include <string_view>

#include "limpid/files/text/look_file.h"

#include "fuzz/harness.h"

namespace limpid::fuzz {

void look(Bytes bytes) {
  constexpr std::string_view kSetting = "--set ";
  const std::string text = text_of(bytes);
  if (text.starts_with(kSetting)) {
    Look look;
    accepts([&] { apply_setting(look, std::string_view(text).substr(kSetting.size())); });
  } else {
    accepts([&] { look_from_toml(text, "look.toml"); });
  }
}

}  // namespace limpid::fuzz
