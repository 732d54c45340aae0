// Parallel loops, sums and pipelines; no other module uses threads directly. Results do not depend on the
// number of threads: each index or piece writes its own slot, and sums add fixed blocks in order.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace hooke {

/// Limits the number of threads during its lifetime. `threads` < 1 means all that the process may use.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Number of threads in use now.
int thread_count();

/// Calls body(begin, end) on consecutive blocks of `block` indices that cover [0, count), in any order. An
/// exception thrown by the body is rethrown to the caller.
void parallel_for(std::size_t count, std::size_t block,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls both functions, concurrently if there is more than one thread. An exception of either is rethrown to
/// the caller; the other function may then not have been called.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

/// Calls make() repeatedly, one call at a time, until it returns null, and concurrently use(piece) on the
/// pieces of work that it has returned, several at once and in any order. Pieces must stay at their addresses
/// until this function returns. An exception of either function is rethrown to the caller.
void parallel_pipeline(const std::function<void*()>& make, const std::function<void(void*)>& use);
template <typename Piece>
void parallel_pipeline(const std::function<Piece*()>& make, const std::function<void(Piece&)>& use) {
  parallel_pipeline(std::function<void*()>(make), [&use](void* piece) { use(*static_cast<Piece*>(piece)); });
}

/// Sum of body(begin, end) over consecutive blocks of `block` indices that cover [0, count), added in order.
double parallel_sum(std::size_t count, std::size_t block,
                    const std::function<double(std::size_t begin, std::size_t end)>& body);

}  // namespace hooke
