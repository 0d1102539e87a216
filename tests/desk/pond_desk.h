#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "limpid/core/executor.h"

#include "desk/desk.h"
#include "tool/made_plate.h"

/// A desk with the made-up pond (tool/made_plate.h), in a folder for each test.

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
  /// The 8-bit preview of composite() for the same plate and look: rows of R, G, B.
  std::vector<std::uint8_t> previewed(const DeskOptions& options, const Look& look,
                                      std::optional<int> frame = {},
                                      std::optional<double> time = {}) const;
  /// The colors of a desk's picture in the order of previewed().
  static std::vector<std::uint8_t> colors(const Shown& shown);

  std::filesystem::path folder_;
  std::unique_ptr<Executor> executor_ = make_executor(2);
};

}  // namespace limpid::test
