#include <algorithm>
#include <cstdio>

#include "judge/hard/hard.h"

namespace limpid {
namespace {

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

}  // namespace

std::string to_text(std::span<const HardRow> rows) {
  std::size_t name = 0, quantity = 0, passed = 0;
  for (const HardRow& row : rows) {
    name = std::max(name, row.group.size() + 2 + row.name.size());
    quantity = std::max(quantity, row.quantity.size());
    passed += row.passed();
  }
  std::string text;
  for (const HardRow& row : rows) {
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, "  %9.3g of %9.3g  margin %6.1f %%  %8lld values",
                  row.measured, row.bound, 100 * row.margin(), static_cast<long long>(row.values));
    text += padded(row.group + ": " + row.name, name) + "  " + padded(row.quantity, quantity) +
            numbers + (row.passed() ? "" : "  FAILED: " + row.worst) + "\n";
  }
  return text + std::to_string(passed) + " of " + std::to_string(rows.size()) +
         " hard cases are within their bounds\n";
}

}  // namespace limpid
