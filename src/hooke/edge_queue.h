// Edges in the order in which they are to be changed, while changes make new ones.
#pragma once

#include <functional>
#include <queue>

#include "hooke/triangulation.h"

namespace hooke {

class EdgeQueue {
 public:
  /// `urgency` of an edge, by one of its half-edges: the greatest comes first, and none that is not positive.
  EdgeQueue(const Triangulation& triangulation, std::function<double(int half_edge)> urgency)
      : t_(triangulation), urgency_(std::move(urgency)) {
    for (int h = 0; h < t_.half_edge_count(); ++h)
      if (!t_.is_gone(h / 3) && t_.twin(h) < h) push(h);
  }

  /// To be called again for each edge whose urgency has changed.
  void push(int h) {
    if (const double urgency = urgency_(h); urgency > 0) entries_.push({urgency, h});
  }

  /// All the edges of the vertex's faces. After a split those across from it go by other half-edges too.
  void push_about(int vertex) {
    for (int h : t_.outgoing(vertex)) {
      push(h);
      push(Triangulation::next(h));
      if (t_.twin(Triangulation::previous(h)) < 0) push(Triangulation::previous(h));
    }
  }

  /// A half-edge of the next edge; -1 when there is none.
  int pop() {
    while (!entries_.empty()) {
      const auto [urgency, h] = entries_.top();
      entries_.pop();
      if (!t_.is_gone(h / 3) && urgency_(h) == urgency) return h;
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
    while (apart.size() + later.size() < most && later.size() < 64 + 4 * apart.size()) {
      const int h = pop();
      if (h < 0) break;
      if (wanted(h)) (claim_about(h) ? apart : later).push_back(h);
    }
    for (int h : later) push(h);
    return apart;
  }

 private:
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

  const Triangulation& t_;
  std::function<double(int)> urgency_;
  std::priority_queue<std::pair<double, int>> entries_;
  std::vector<int> claimed_by_;  // per vertex: the number of the last claim, from 1
  int claims_ = 0, first_of_batch_ = 1;
};

}  // namespace hooke
