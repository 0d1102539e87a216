#pragma once
#include <string>
#include <vector>

#include "show/shown.h"

namespace limpid {

struct SheetCell {
  std::string label;
  Shown shown;
};

/// Pictures of one size in rows, each with its label below, on a dark background: about one and a
/// half times as wide as high.
Shown contact_sheet(const std::vector<SheetCell>& cells);

}  // namespace limpid
