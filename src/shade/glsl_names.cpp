#include "limpid/core/error.h"

#include "shade/glsl.h"

namespace limpid {
namespace {

const Role& role_of(PlaneId plane) {
  for (const Role& role : roles()) {
    if (role.planes().has(plane)) return role;
  }
  throw Error("a plane without a role");
}

}  // namespace

std::string glsl_name(const std::string& name) {
  std::string word;
  for (const char c : name) {
    if (c == ']') continue;
    word += c == '.' || c == '[' ? '_' : c;
  }
  return word;
}

std::string role_word(PlaneId plane) { return std::string(role_of(plane).name); }

char channel_letter(PlaneId plane) {
  return "rgba"[index_of(plane) - index_of(role_of(plane).first)];
}

}  // namespace limpid
