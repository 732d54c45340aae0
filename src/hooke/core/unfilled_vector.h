// Large arrays whose items are written by all cores. An ordinary vector fills them beforehand, on one core,
// and that costs more than what is written then: memory is handed out as it is first touched.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace hooke {

template <typename T>
struct UnfilledAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnfilledAllocator<U>;
  };
  template <typename U>
  void construct(U*) noexcept {}
  template <typename U, typename... Args>
  void construct(U* place, Args&&... args) {
    std::construct_at(place, std::forward<Args>(args)...);
  }
};

/// Items that are given no value have none: each must be written before it is read. For plain values, which
/// need neither be built nor destroyed.
template <typename T>
using UnfilledVector = std::vector<T, UnfilledAllocator<T>>;

}  // namespace hooke
