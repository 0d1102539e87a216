#include "judge/compare/grid.h"

#include <gtest/gtest.h>

namespace limpid {
namespace {

template <class T>
Grid<T> grid_of(Size size, const std::vector<T>& values) {
  Grid<T> grid(size);
  for (std::size_t i = 0; i < values.size(); ++i) grid[i] = values[i];
  return grid;
}

template <class T>
std::vector<T> values_of(const Grid<T>& grid) {
  std::vector<T> values;
  for (std::size_t i = 0; i < grid.count(); ++i) values.push_back(grid[i]);
  return values;
}

TEST(Grid, IsCorrelatedAndGoesOnAsItsEdge) {
  const Grid<double> grid = grid_of<double>({3, 2}, {1, 2, 4, 10, 20, 40});
  EXPECT_EQ(values_of(filtered(grid, {1, 10, 100}, {1})),
            (std::vector<double>{211, 421, 442, 2110, 4210, 4420}));
  EXPECT_EQ(values_of(filtered(grid, {1}, {1, 10, 100})),
            (std::vector<double>{1011, 2022, 4044, 1101, 2202, 4404}));
  EXPECT_EQ(values_of(filtered(grid, {1, -1, 0}, {0, 2, 0})),
            (std::vector<double>{0, -2, -4, 0, -20, -40}));
}

TEST(Grid, MayBeSmallerThanTheKernel) {
  const Grid<float> pixel = grid_of<float>({1, 1}, {2});
  EXPECT_EQ(values_of(filtered(pixel, {1, 1, 1, 1, 1}, {1, 1, 1})), std::vector<float>{30});
  EXPECT_EQ(filtered(Grid<float>({0, 3}), {1, 1, 1}, {1}).count(), 0);
}

}  // namespace
}  // namespace limpid
