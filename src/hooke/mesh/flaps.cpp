#include "hooke/mesh/flaps.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "hooke/core/lists.h"

namespace hooke {
namespace {

class FlapSearch {
 public:
  FlapSearch(const std::vector<Triangle>& triangles, const std::vector<std::array<int, 2>>& pairs)
      : triangles_(triangles), pairs_(pairs), pair_of_(triangles.size(), -1), is_flap_(pairs.size(), 1) {
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (int f : pairs[p]) pair_of_[f] = static_cast<int>(p);
    for (const auto& pair : pairs)
      for_each_edge(pair[0], [&](std::uint64_t edge) { faces_at_.try_emplace(edge); });
    for (int f = 0; f < static_cast<int>(triangles.size()); ++f)
      for_each_edge(f, [&](std::uint64_t edge) {
        if (const auto at = faces_at_.find(edge); at != faces_at_.end()) at->second.push_back(f);
      });
  }

  std::vector<int> faces() {
    drop_what_would_open();
    drop_sheets();
    std::vector<int> faces;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_flap_[p]) faces.insert(faces.end(), pairs_[p].begin(), pairs_[p].end());
    sort_unique(faces);
    return faces;
  }

 private:
  template <typename Visit>
  void for_each_edge(int face, const Visit& visit) const {
    const Triangle& t = triangles_[face];
    for (std::size_t k = 0; k < 3; ++k) visit(edge_key(t[k], t[(k + 1) % 3]));
  }

  bool is_flap(int face) const { return pair_of_[face] >= 0 && is_flap_[pair_of_[face]]; }

  std::vector<int> others_at(std::uint64_t edge) const {
    std::vector<int> others = faces_at_.at(edge);
    std::erase_if(others, [&](int f) { return is_flap(f); });
    return others;
  }

  bool would_open(std::uint64_t edge) const {
    const std::vector<int> others = others_at(edge);
    return !others.empty() &&
           (others.size() != 2 || std::ranges::is_permutation(triangles_[others[0]], triangles_[others[1]]));
  }

  void drop_what_would_open() {
    std::vector<int> left(pairs_.size());
    std::iota(left.begin(), left.end(), 0);
    while (!left.empty()) {
      const int p = left.back(), face = pairs_[p][0];
      left.pop_back();
      bool opens = false;
      if (is_flap_[p]) for_each_edge(face, [&](std::uint64_t edge) { opens = opens || would_open(edge); });
      if (!opens) continue;
      is_flap_[p] = 0;
      for_each_edge(face, [&](std::uint64_t edge) {
        for (int f : faces_at_.at(edge))
          if (is_flap(f)) left.push_back(pair_of_[f]);
      });
    }
  }

  /// Drops the groups of pairs that hang on no other face.
  void drop_sheets() {
    std::vector<char> seen(pairs_.size(), 0);
    for (std::size_t first = 0; first < pairs_.size(); ++first) {
      if (!is_flap_[first] || seen[first]) continue;
      std::vector<int> group{static_cast<int>(first)};
      seen[first] = 1;
      bool hangs = false;
      for (std::size_t i = 0; i < group.size(); ++i)
        for_each_edge(pairs_[group[i]][0], [&](std::uint64_t edge) {
          for (int f : faces_at_.at(edge)) {
            if (!is_flap(f))
              hangs = true;
            else if (!std::exchange(seen[pair_of_[f]], 1))
              group.push_back(pair_of_[f]);
          }
        });
      if (!hangs)
        for (int p : group) is_flap_[p] = 0;
    }
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<std::array<int, 2>>& pairs_;
  std::vector<int> pair_of_;                                      // per face; -1: none
  std::vector<char> is_flap_;                                     // per pair
  std::unordered_map<std::uint64_t, std::vector<int>> faces_at_;  // of the edges of pairs
};

}  // namespace

std::vector<std::vector<int>> faces_of_same_vertices(const std::vector<Triangle>& triangles) {
  std::vector<int> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Triangle> keys = triangles;
  for (Triangle& key : keys) std::ranges::sort(key);
  std::ranges::sort(order, [&](int a, int b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
  std::vector<std::vector<int>> groups;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (keys[order[i]] != keys[order[i - 1]]) continue;
    if (groups.empty() || groups.back().back() != order[i - 1]) groups.push_back({order[i - 1]});
    groups.back().push_back(order[i]);
  }
  return groups;
}

std::vector<std::array<int, 2>> faces_back_to_back(const std::vector<Triangle>& triangles,
                                                   const std::vector<std::vector<int>>& groups) {
  std::vector<std::array<int, 2>> pairs;
  for (const std::vector<int>& group : groups) {
    if (group.size() != 2) continue;
    const Triangle &s = triangles[group[0]], &t = triangles[group[1]];
    const bool same_direction = t[(corner_of(t, s[0]) + 1) % 3] == s[1];
    if (!same_direction) pairs.push_back({group[0], group[1]});
  }
  return pairs;
}

std::vector<int> find_flaps(const std::vector<Triangle>& triangles,
                            const std::vector<std::array<int, 2>>& pairs) {
  if (pairs.empty()) return {};
  return FlapSearch(triangles, pairs).faces();
}

}  // namespace hooke
