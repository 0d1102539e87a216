#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "limpid/core/executor.h"

#include "desk/desk.h"
#include "tool/made_plate.h"

/// A desk on which the made-up pond lies (tool/made_plate.h), in a folder of its own.

namespace limpid::test {

/// The sentence of the Error that the work throws.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

class PondDesk : public ::testing::Test {
 protected:
  PondDesk();
  ~PondDesk() override;

  /// The pond with its one look, "pond".
  DeskOptions options(const PlateOptions& plate = {}) const;
  /// What composite() makes of the same, as 8 bits by its preview: rows of R, G, B.
  std::vector<std::uint8_t> previewed(const DeskOptions& options, const Look& look,
                                      std::optional<int> frame = {},
                                      std::optional<double> time = {}) const;
  /// The same of what a desk shows.
  static std::vector<std::uint8_t> colors(const Shown& shown);

  std::filesystem::path folder_;
  std::unique_ptr<Executor> executor_ = make_executor(2);
};

}  // namespace limpid::test
