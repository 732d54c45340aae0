// UniformVector that mostly are all the same.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace hooke {

/// A length per item, kept once where all items have the same.
class UniformVector {
 public:
  UniformVector() = default;
  UniformVector(std::vector<double> values) : values_(std::move(values)), size_(values_.size()) {
    if (size_ > 0 && are_equal(values_)) *this = UniformVector(size_, values_[0]);
  }
  /// Pre-condition: size > 0.
  UniformVector(std::size_t size, double value) : values_(1, value), size_(size), mask_(0) {}

  static bool are_equal(const std::vector<double>& values) {
    return std::ranges::adjacent_find(values, std::ranges::not_equal_to()) == values.end();
  }

  double operator[](std::size_t item) const { return values_[item & mask_]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// Are there several lengths?
  bool vary() const { return values_.size() > 1; }

  std::vector<double> values() const { return vary() || empty() ? values_ : std::vector(size_, values_[0]); }

  bool operator==(const UniformVector&) const = default;

 private:
  std::vector<double> values_;
  std::size_t size_ = 0;
  std::size_t mask_ = ~std::size_t{0};  // of the item's number
};

}  // namespace hooke
