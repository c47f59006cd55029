#include "mc/export/hdf5_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace drift::hdf5_box_test {
namespace {

using mc::Box;
using mc::largest_box;

/// Numbers of a box in the order in which HDF5 visits it.
std::vector<hsize_t> places(const std::vector<hsize_t>& shape, const Box& box) {
  std::vector<hsize_t> found{0};
  for (std::size_t k = 0; k < shape.size(); ++k) {
    std::vector<hsize_t> longer;
    for (const hsize_t before : found)
      for (hsize_t i = 0; i < box.count[k]; ++i)
        longer.push_back(before * shape[k] + box.start[k] + i);
    found = longer;
  }
  return found;
}

TEST(Hdf5Box, BoxesFollowTheOrderOfTheNumbersFromAnyPlaceInAnyPortion) {
  for (const std::vector<hsize_t>& shape :
       {std::vector<hsize_t>{7}, {4, 5}, {1, 3, 1, 2}, {3, 2, 4, 1}, {2, 3, 2, 2, 3}}) {
    const hsize_t all =
        std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
    for (hsize_t from = 0; from < all; ++from)
      for (hsize_t most = 1; most <= all; ++most) {
        const Box box = largest_box(shape, from, most);
        std::vector<hsize_t> expected(box.numbers);
        std::iota(expected.begin(), expected.end(), from);
        ASSERT_EQ(places(shape, box), expected);
        ASSERT_GE(box.numbers, 1u);
        ASSERT_LE(box.numbers, most);
      }
    EXPECT_EQ(largest_box(shape, 0, all).numbers, all) << "whole arrays move at once";
    EXPECT_EQ(largest_box(shape, all, 5).numbers, 0u);
  }
}

TEST(Hdf5Box, RowsMoveTogether) {
  EXPECT_EQ(largest_box({10, 4, 3}, 24, 40).numbers, 36u) << "three whole rows of twelve";
  EXPECT_EQ(largest_box({2, 10, 4, 3}, 9 * 12, 1000).numbers, 12u) << "up to the end of a point";
  EXPECT_EQ(largest_box({0, 3}, 0, 10).numbers, 0u);
}

}  // namespace
}  // namespace drift::hdf5_box_test
