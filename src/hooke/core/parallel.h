// Threads, for the whole library: no other file knows them. Results never depend on their number: each index
// or piece writes its own slot, and sums run over fixed blocks that are added in order.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace hooke {

/// Limits the threads used while it lives. `threads` < 1 means all that the process may use.
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

/// Calls body(begin, end) on consecutive blocks of `block` indices that cover [0, count), in any order.
/// An exception thrown by the body is rethrown here.
void parallel_for(std::size_t count, std::size_t block,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls both, at the same time where threads allow it. An exception of either is rethrown here; the other
/// may then not have been called.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

/// Calls make() again and again, one call at a time, until it returns no piece of work, and meanwhile
/// use(piece) on those that it has returned, several at once and in any order. Pieces must stay where they
/// are until this returns. An exception of either is rethrown here.
void parallel_pipeline(const std::function<void*()>& make, const std::function<void(void*)>& use);
template <typename Piece>
void parallel_pipeline(const std::function<Piece*()>& make, const std::function<void(Piece&)>& use) {
  parallel_pipeline(std::function<void*()>(make), [&use](void* piece) { use(*static_cast<Piece*>(piece)); });
}

/// Sum of body(begin, end) over the blocks, added in the order of the blocks.
double parallel_sum(std::size_t count, std::size_t block,
                    const std::function<double(std::size_t begin, std::size_t end)>& body);

}  // namespace hooke
