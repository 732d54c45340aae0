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

 private:
  const Triangulation& t_;
  std::function<double(int)> urgency_;
  std::priority_queue<std::pair<double, int>> entries_;
};

}  // namespace hooke
