#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace limpid::bench {

/// A row of a table: something to time.
struct Row {
  std::string name;
  std::function<double()> run;  ///< does the work once and returns its seconds
  int most_rounds = std::numeric_limits<int>::max();  ///< a lower limit for slow rows
  double best_seconds = 1e30;
};

template <class Body>
double seconds_of(Body&& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Rounds go over all rows in turn, so that other load on the machine affects all rows; the fastest
/// round counts.
template <class Rows>
void time_rows(Rows& rows, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (auto& row : rows) {
      if (round < row.most_rounds) row.best_seconds = std::min(row.best_seconds, row.run());
    }
  }
}

}  // namespace limpid::bench
