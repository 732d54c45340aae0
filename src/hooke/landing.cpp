#include "hooke/landing.h"

#include <utility>

namespace hooke {

std::vector<int> put_back_offenders(const Guards& guards, const Placement& from, Placement& to) {
  std::vector<char> is_back(from.drift.size(), 0);
  std::vector<int> back;
  for (bool more = true; more;) {
    more = false;
    for (int v : guards.offenders(from, to)) {
      if (std::exchange(is_back[static_cast<size_t>(v)], 1)) continue;
      more = true;
      back.push_back(v);
      to.points.col(v) = from.points.col(v);
      to.normals.col(v) = from.normals.col(v);
      if (const int other = to.other_side_of(v); other >= 0) to.normals.col(other) = from.normals.col(other);
    }
  }
  return back;
}

void settle(const Guards& guards, Retraction& retraction, const Placement& from, Placement& to) {
  to = from;
  retraction.settle(to);
  for (int v : put_back_offenders(guards, from, to)) VertexPlace(from, v).write_to(to, v);
}

void settle(const Guards& guards, Retraction& retraction, Placement& placement) {
  Placement settled;
  settle(guards, retraction, placement, settled);
  placement = std::move(settled);
}

}  // namespace hooke
