#include "files/want_of_memory.h"

#include <initializer_list>
#include <string_view>

#include "core/memory.h"

namespace limpid {

bool is_for_want_of_memory(const std::exception& error) {
  const std::string_view text = error.what();
  // OpenEXR passes on a thread's exception as text, with sentences of its own.
  for (const std::string_view words : {"bad_alloc", "allocate memory"}) {
    if (text.find(words) != text.npos) return true;
  }
  return !has_memory(kPlentyOfMemory);
}

}  // namespace limpid
