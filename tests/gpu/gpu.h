#pragma once
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/gpu/gpu_runner.h"

#include "sanitized.h"

namespace limpid::test {

/// A test on a device under Vulkan's validation layer, which prints the errors that it finds.
class GpuTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 1); }

  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "drivers are not instrumented";
    try {
      if (gpu_devices().empty()) GTEST_SKIP() << "no GPU: install mesa-vulkan-drivers";
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  GpuTest() { testing::internal::CaptureStdout(); }
  ~GpuTest() override {
    const std::string said = testing::internal::GetCapturedStdout();
    std::fputs(said.c_str(), stdout);
    EXPECT_EQ(said.find("VUID"), std::string::npos);
    EXPECT_EQ(said.find("Validation"), std::string::npos);
  }
};

}  // namespace limpid::test
