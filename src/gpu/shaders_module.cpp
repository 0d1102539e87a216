// The only source that includes glslang and SPIRV-Cross; built as limpid_shaders.so, which
// shader.cpp loads.
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/ResourceLimits.h>
#include <spirv_cross/spirv_cross_c.h>

#include "gpu/shaders_abi.h"

namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

template <class T, class Release>
auto owned(T* object, Release* release) {
  if (!object) throw std::runtime_error("no memory");
  return std::unique_ptr<T, Release*>(object, release);
}

std::vector<std::uint32_t> spirv_of(const std::string& text, bool compute) {
  static const bool begun = glslang_initialize_process() != 0;
  if (!begun) throw std::runtime_error("glslang does not start");
  glslang_input_t input{};
  input.language = GLSLANG_SOURCE_GLSL;
  input.stage = compute ? GLSLANG_STAGE_COMPUTE : GLSLANG_STAGE_FRAGMENT;
  input.client = GLSLANG_CLIENT_VULKAN;
  input.client_version = GLSLANG_TARGET_VULKAN_1_0;
  input.target_language = GLSLANG_TARGET_SPV;
  input.target_language_version = GLSLANG_TARGET_SPV_1_0;
  input.code = text.c_str();
  input.default_version = 450;
  input.default_profile = GLSLANG_NO_PROFILE;
  input.messages =
      static_cast<glslang_messages_t>(GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT);
  input.resource = reinterpret_cast<const glslang_resource_t*>(GetDefaultResources());
  const auto shader = owned(glslang_shader_create(&input), glslang_shader_delete);
  const auto refuse = [](const char* log) {
    throw std::runtime_error("the shader does not compile: " + first_line(log ? log : ""));
  };
  if (!glslang_shader_preprocess(shader.get(), &input) ||
      !glslang_shader_parse(shader.get(), &input)) {
    refuse(glslang_shader_get_info_log(shader.get()));
  }
  const auto program = owned(glslang_program_create(), glslang_program_delete);
  glslang_program_add_shader(program.get(), shader.get());
  if (!glslang_program_link(program.get(), input.messages)) {
    refuse(glslang_program_get_info_log(program.get()));
  }
  glslang_program_SPIRV_generate(program.get(), input.stage);
  std::vector<std::uint32_t> words(glslang_program_SPIRV_get_size(program.get()));
  glslang_program_SPIRV_get(program.get(), words.data());
  return words;
}

std::string crossed(const std::vector<std::uint32_t>& spirv, bool compute,
                    ShadersLanguage language) {
  spvc_context made = nullptr;
  if (spvc_context_create(&made) != SPVC_SUCCESS) throw std::runtime_error("no memory");
  const auto context = owned(made, spvc_context_destroy);
  const auto expect = [&](spvc_result result) {
    if (result == SPVC_SUCCESS) return;
    throw std::runtime_error("SPIRV-Cross: " +
                             first_line(spvc_context_get_last_error_string(context.get())));
  };
  const spvc_backend backend = language == kShadersHlsl  ? SPVC_BACKEND_HLSL
                               : language == kShadersMsl ? SPVC_BACKEND_MSL
                                                         : SPVC_BACKEND_GLSL;
  spvc_parsed_ir ir = nullptr;
  spvc_compiler compiler = nullptr;
  spvc_compiler_options options = nullptr;
  expect(spvc_context_parse_spirv(context.get(), spirv.data(), spirv.size(), &ir));
  expect(spvc_context_create_compiler(context.get(), backend, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                      &compiler));
  expect(spvc_compiler_create_compiler_options(compiler, &options));
  const auto number = [&](spvc_compiler_option option, unsigned value) {
    expect(spvc_compiler_options_set_uint(options, option, value));
  };
  const auto yes = [&](spvc_compiler_option option) {
    expect(spvc_compiler_options_set_bool(options, option, SPVC_TRUE));
  };
  if (language == kShadersHlsl) {
    number(SPVC_COMPILER_OPTION_HLSL_SHADER_MODEL, 50);
  } else if (language == kShadersMsl) {
    number(SPVC_COMPILER_OPTION_MSL_VERSION, SPVC_MAKE_MSL_VERSION(2, 0, 0));
  } else {
    number(SPVC_COMPILER_OPTION_GLSL_VERSION, compute ? 310 : 300);
    yes(SPVC_COMPILER_OPTION_GLSL_ES);
    yes(SPVC_COMPILER_OPTION_GLSL_ES_DEFAULT_FLOAT_PRECISION_HIGHP);
  }
  expect(spvc_compiler_install_compiler_options(compiler, options));
  const char* text = nullptr;
  expect(spvc_compiler_compile(compiler, &text));
  return text;
}

}  // namespace

unsigned limpid_shaders_abi() { return kShadersAbi; }

int limpid_shaders_translate(const char* glsl, std::size_t size, int compute,
                             ShadersLanguage language, ShadersPut* put, void* to) {
  static std::mutex mutex;  // glslang has tables that all threads share
  try {
    const std::lock_guard lock(mutex);
    const std::vector<std::uint32_t> spirv = spirv_of(std::string(glsl, size), compute != 0);
    if (language == kShadersSpirv) {
      put(to, reinterpret_cast<const char*>(spirv.data()), 4 * spirv.size());
    } else {
      const std::string text = crossed(spirv, compute != 0, language);
      put(to, text.data(), text.size());
    }
    return 0;
  } catch (const std::exception& error) {
    const std::string sentence = error.what();
    put(to, sentence.data(), sentence.size());
    return 1;
  }
}
