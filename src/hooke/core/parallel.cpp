#include "hooke/core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace hooke {
namespace {

/// What a thread has done before give() another one sees after take(). TBB sees to that; this tells it to the
/// thread sanitizer, with which that library is not built.
struct HandOver {
#ifdef __SANITIZE_THREAD__
  void give() {
    __tsan_release(this);
  }
  void take() {
    __tsan_acquire(this);
  }
#else
  void give() {}
  void take() {}
#endif
};

// Not on a stack: a task must take before it reads its own closure.
HandOver to_tasks, from_tasks;

/// In scope while a task does its work, which may throw.
struct Task {
  Task() { to_tasks.take(); }
  ~Task() { from_tasks.give(); }
};

/// In scope while tasks do their work for this thread.
struct Tasks {
  Tasks() { to_tasks.give(); }
  ~Tasks() { from_tasks.take(); }
};

}  // namespace

struct ThreadLimit::Impl {
  // Constructed in place, because a copy of a global_control is not registered and has no effect.
  explicit Impl(size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads < 1) threads = tbb::this_task_arena::max_concurrency();
  impl_ = std::make_unique<Impl>(threads);
}

ThreadLimit::~ThreadLimit() = default;

int thread_count() {
  const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::min(static_cast<int>(allowed), tbb::this_task_arena::max_concurrency());
}

void parallel_for(std::size_t count, std::size_t block,
                  const std::function<void(std::size_t begin, std::size_t end)>& body) {
  const std::size_t blocks = (count + block - 1) / block;
  if (blocks <= 1 || thread_count() == 1) {
    if (count > 0) body(0, count);
    return;
  }
  const auto do_block = [&](std::size_t b) {
    const Task task;
    body(b * block, std::min(count, (b + 1) * block));
  };
  const Tasks tasks;
  tbb::parallel_for(std::size_t{0}, blocks, do_block);
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
  parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) (k == 0 ? first : second)();
  });
}

void parallel_pipeline(const std::function<void*()>& make, const std::function<void(void*)>& use) {
  const std::size_t threads = thread_count();
  if (threads == 1) {
    while (void* piece = make()) use(piece);
    return;
  }
  const auto source = [&](tbb::flow_control& control) {
    const Task task;
    void* piece = make();
    to_tasks.give();  // to the one that uses it
    if (!piece) control.stop();
    return piece;
  };
  const auto sink = [&](void* piece) {
    const Task task;
    use(piece);
  };
  const Tasks tasks;
  tbb::parallel_pipeline(4 * threads,
                         tbb::make_filter<void, void*>(tbb::filter_mode::serial_in_order, source) &
                             tbb::make_filter<void*, void>(tbb::filter_mode::parallel, sink));
}

double parallel_sum(std::size_t count, std::size_t block,
                    const std::function<double(std::size_t begin, std::size_t end)>& body) {
  const std::size_t blocks = (count + block - 1) / block;
  std::vector<double> partial(blocks);
  parallel_for(blocks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) partial[b] = body(b * block, std::min(count, (b + 1) * block));
  });
  double sum = 0;
  for (double p : partial) sum += p;
  return sum;
}

}  // namespace hooke
