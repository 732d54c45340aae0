// A priority queue of the edges of a mesh that changes while edges are taken from it.
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
  /// `urgency`: the priority of an edge, given by one of its half-edges. The highest comes first; edges
  /// without a positive one do not come at all. It is called from several threads.
  EdgeQueue(const HalfedgeMesh& halfedges, std::function<double(int half_edge)> urgency)
      : t_(halfedges), urgency_(std::move(urgency)) {
    queued_.resize(t_.half_edge_count(), 0);
    parallel_for(queued_.size(), 4096, [this](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        if (const int h = static_cast<int>(i); !t_.is_removed(h / 3) && t_.twin(h) < h)
          queued_[i] = std::max(urgency_(h), 0.);
    });
  }

  /// Must be called for each edge whose urgency has changed.
  void push(int h) {
    const int other = std::min(h, t_.twin(h));
    h = std::max(h, t_.twin(h));
    const double urgency = std::max(urgency_(h), 0.);
    queued_.resize(t_.half_edge_count(), 0);
    if (other >= 0) queued_[other] = 0;  // in case it represented another edge
    if (std::exchange(queued_[h], urgency) != urgency && urgency >= horizon_) entries_.push({urgency, h});
  }

  /// Pushes all edges of the faces around the vertex. After a split the edges opposite the vertex are also
  /// represented by other half-edges.
  void push_around(int vertex) {
    for (int h : t_.outgoing(vertex)) {
      push(h);
      push(HalfedgeMesh::next(h));
      if (t_.twin(HalfedgeMesh::previous(h)) < 0) push(HalfedgeMesh::previous(h));
    }
  }

  /// A half-edge of the next edge, -1 if there is none.
  int pop() {
    while (!entries_.empty() || refill()) {
      const auto [urgency, h] = entries_.top();
      entries_.pop();
      if (queued_[h] != urgency) continue;  // outdated entry
      queued_[h] = 0;
      if (!t_.is_removed(h / 3)) return h;
    }
    return -1;
  }

  /// Takes up to `max_count` of the next edges and returns, in order, those without a vertex or neighbour in
  /// common with an earlier one, so that changes of some do not affect the others. Stops early where edges
  /// mostly meet; the others return to the queue. Empty if there is no edge left. Edges for which `wanted` is
  /// false are dropped.
  template <typename Wanted>
  std::vector<int> pop_apart(size_t max_count, const Wanted& wanted) {
    std::vector<int> apart, later;
    first_of_batch_ = claims_ + 1;
    claimed_by_.resize(t_.id_count(), 0);
    while (apart.size() + later.size() < max_count && later.size() < 16 + apart.size()) {
      const int h = pop();
      if (h < 0) break;
      if (wanted(h)) (claim_around(h) ? apart : later).push_back(h);
    }
    for (int h : later) push(h);
    return apart;
  }

 private:
  /// Moves the most urgent of the waiting edges into the priority queue, which thus stays small. False if
  /// none waits.
  bool refill() {
    constexpr size_t min_entries = 1024, divisor = 4;
    if (horizon_ <= 0) return false;
    std::vector<std::pair<double, int>> waiting;
    for (size_t h = 0; h < queued_.size(); ++h)
      if (queued_[h] > 0) waiting.emplace_back(queued_[h], static_cast<int>(h));
    if (waiting.empty()) return false;
    horizon_ = 0;
    if (const size_t next = std::max(min_entries, waiting.size() / divisor); next < waiting.size()) {
      std::ranges::nth_element(waiting, waiting.begin() + static_cast<std::ptrdiff_t>(next), std::greater());
      horizon_ = waiting[next].first;
      std::erase_if(waiting, [this](const auto& entry) { return entry.first < horizon_; });
    }
    entries_ = decltype(entries_)({}, std::move(waiting));
    return true;
  }

  /// Claims the vertices around the edge. True if no other edge of the batch has claimed one of them.
  bool claim_around(int h) {
    ++claims_;
    bool free = true;
    for (int end : {t_.from(h), t_.to(h)})
      for (int outgoing : t_.outgoing(end))
        for (int v : t_.faces()[outgoing / 3]) {
          int& by = claimed_by_[v];
          free = free && (by < first_of_batch_ || by == claims_);
          by = claims_;
        }
    return free;
  }

  const HalfedgeMesh& t_;
  std::function<double(int)> urgency_;
  std::priority_queue<std::pair<double, int>> entries_;
  double horizon_ = std::numeric_limits<double>::infinity();  // less urgent edges wait outside entries_
  std::vector<double> queued_;   // per half-edge: its urgency while it waits or is in the queue, else 0
  std::vector<int> claimed_by_;  // per vertex: number of the last claim, from 1
  int claims_ = 0, first_of_batch_ = 1;
};

}  // namespace hooke
