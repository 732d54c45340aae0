// Edges in the order in which they are to be changed, while changes make new ones.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/mesh/halfedge_mesh.h"

namespace hooke {

class EdgeQueue {
 public:
  /// `urgency` of an edge, by one of its half-edges: the greatest comes first, and none that is not positive.
  /// It is asked for several edges at once.
  EdgeQueue(const HalfedgeMesh& halfedges, std::function<double(int half_edge)> urgency)
      : t_(halfedges), urgency_(std::move(urgency)) {
    queued_.resize(static_cast<size_t>(t_.half_edge_count()), 0);
    parallel_for(queued_.size(), 4096, [this](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        if (const int h = static_cast<int>(i); !t_.is_gone(h / 3) && t_.twin(h) < h)
          queued_[i] = std::max(urgency_(h), 0.);
    });
  }

  /// To be called again for each edge whose urgency has changed.
  void push(int h) {
    const int other = std::min(h, t_.twin(h));
    h = std::max(h, t_.twin(h));
    const double urgency = std::max(urgency_(h), 0.);
    queued_.resize(static_cast<size_t>(t_.half_edge_count()), 0);
    if (other >= 0) queued_[static_cast<size_t>(other)] = 0;  // it may have stood for another edge
    if (std::exchange(queued_[static_cast<size_t>(h)], urgency) != urgency && urgency >= horizon_)
      entries_.push({urgency, h});
  }

  /// All the edges of the vertex's faces. After a split those across from it go by other half-edges too.
  void push_about(int vertex) {
    for (int h : t_.outgoing(vertex)) {
      push(h);
      push(HalfedgeMesh::next(h));
      if (t_.twin(HalfedgeMesh::previous(h)) < 0) push(HalfedgeMesh::previous(h));
    }
  }

  /// A half-edge of the next edge; -1 when there is none.
  int pop() {
    while (!entries_.empty() || look_farther()) {
      const auto [urgency, h] = entries_.top();
      entries_.pop();
      if (queued_[static_cast<size_t>(h)] != urgency) continue;  // it has another one by now
      queued_[static_cast<size_t>(h)] = 0;
      if (!t_.is_gone(h / 3)) return h;
    }
    return -1;
  }

  /// Those of the next edges, in order and from so many at most, that have no vertex or neighbour in common
  /// with one before them: whatever the first ones become, the others stay what they are. Fewer where edges
  /// mostly meet, none when there is none. Edges for which `wanted` is false are dropped.
  template <typename Wanted>
  std::vector<int> pop_apart(size_t most, const Wanted& wanted) {
    std::vector<int> apart, later;
    first_of_batch_ = claims_ + 1;
    claimed_by_.resize(static_cast<size_t>(t_.id_count()), 0);
    while (apart.size() + later.size() < most && later.size() < 16 + apart.size()) {
      const int h = pop();
      if (h < 0) break;
      if (wanted(h)) (claim_about(h) ? apart : later).push_back(h);
    }
    for (int h : later) push(h);
    return apart;
  }

 private:
  /// Takes the most urgent of those that wait into the queue proper, which most changes then need not touch.
  /// False if none waits.
  bool look_farther() {
    constexpr size_t least = 1024, part = 4;
    if (horizon_ <= 0) return false;
    std::vector<std::pair<double, int>> waiting;
    for (size_t h = 0; h < queued_.size(); ++h)
      if (queued_[h] > 0) waiting.emplace_back(queued_[h], static_cast<int>(h));
    if (waiting.empty()) return false;
    horizon_ = 0;
    if (const size_t next = std::max(least, waiting.size() / part); next < waiting.size()) {
      std::ranges::nth_element(waiting, waiting.begin() + static_cast<std::ptrdiff_t>(next), std::greater());
      horizon_ = waiting[next].first;
      std::erase_if(waiting, [this](const auto& entry) { return entry.first < horizon_; });
    }
    entries_ = decltype(entries_)({}, std::move(waiting));
    return true;
  }

  /// Has no other edge of the batch claimed a vertex about this one?
  bool claim_about(int h) {
    ++claims_;
    bool free = true;
    for (int end : {t_.from(h), t_.to(h)})
      for (int spoke : t_.outgoing(end))
        for (int v : t_.faces()[static_cast<size_t>(spoke / 3)]) {
          int& by = claimed_by_[static_cast<size_t>(v)];
          free = free && (by < first_of_batch_ || by == claims_);
          by = claims_;
        }
    return free;
  }

  const HalfedgeMesh& t_;
  std::function<double(int)> urgency_;
  std::priority_queue<std::pair<double, int>> entries_;
  double horizon_ = std::numeric_limits<double>::infinity();  // edges less urgent than this wait
  std::vector<double> queued_;   // per half-edge: the urgency with which it waits or is in the queue, else 0
  std::vector<int> claimed_by_;  // per vertex: the number of the last claim, from 1
  int claims_ = 0, first_of_batch_ = 1;
};

}  // namespace hooke
