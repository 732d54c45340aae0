// A vector of numbers that are often all equal, stored compactly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace hooke {

/// One number per item, stored once if all items have the same.
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

  /// Whether the values differ between items.
  bool is_varying() const { return values_.size() > 1; }

  std::vector<double> values() const {
    return is_varying() || empty() ? values_ : std::vector(size_, values_[0]);
  }

  bool operator==(const UniformVector&) const = default;

 private:
  std::vector<double> values_;
  std::size_t size_ = 0;
  std::size_t mask_ = ~std::size_t{0};  // applied to the index: 0 if a single value is stored
};

}  // namespace hooke
