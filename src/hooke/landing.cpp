#include "hooke/landing.h"

#include <utility>

namespace hooke {
namespace {

std::vector<int> put_back(const Guards& guards, const Placement& from, std::vector<int> offending,
                          Placement& to) {
  std::vector<char> is_back(from.drift.size(), 0);
  std::vector<int> all;
  while (!offending.empty()) {
    std::erase_if(offending, [&](int v) { return std::exchange(is_back[static_cast<size_t>(v)], 1); });
    for (int v : offending) {
      to.points.col(v) = from.points.col(v);
      to.normals.col(v) = from.normals.col(v);
      if (const int other = to.other_side_of(v); other >= 0) to.normals.col(other) = from.normals.col(other);
    }
    all.insert(all.end(), offending.begin(), offending.end());
    offending = guards.offenders_around(from, to, offending);
  }
  return all;
}

}  // namespace

std::vector<int> put_back_offenders(const Guards& guards, const Placement& from, Placement& to) {
  return put_back(guards, from, guards.offenders(from, to), to);
}

std::vector<int> put_back_offenders(const Guards& guards, const Placement& from,
                                    const std::vector<int>& moved, Placement& to) {
  return put_back(guards, from, guards.offenders_around(from, to, moved), to);
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
