// The unused ids of a triangulation: given up, and the others put in order.
#include <algorithm>

#include "hooke/core/parallel.h"
#include "hooke/mesh/ordering.h"
#include "hooke/mesh/triangulation.h"

namespace hooke {
namespace {

void for_each_index(size_t count, const auto& use) {
  parallel_for(count, 8192, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) use(i);
  });
}

}  // namespace

std::vector<int> Triangulation::compact() {
  const auto old_face_count = static_cast<int>(faces_.size());
  std::vector<int> left;
  left.reserve(faces_.size());
  for (int f = 0; f < old_face_count; ++f)
    if (!is_gone(f)) left.push_back(f);
  std::vector<Triangle> faces(left.size());
  for_each_index(left.size(), [&](size_t i) { faces[i] = faces_[static_cast<size_t>(left[i])]; });

  std::vector<int> kept = locality_order(id_count(), faces);
  std::erase_if(kept, [this](int v) { return valence(v) < 0; });
  std::vector<int> vertex_id(valences_.size(), -1);
  for (size_t i = 0; i < kept.size(); ++i) vertex_id[static_cast<size_t>(kept[i])] = static_cast<int>(i);

  std::vector<std::array<int, 1>> first_corners(left.size());  // faces follow theirs
  for_each_index(left.size(), [&](size_t i) {
    for (int& v : faces[i]) v = vertex_id[static_cast<size_t>(v)];
    first_corners[i][0] = std::ranges::min(faces[i]);
  });
  const std::vector<int> order = invert(static_cast<int>(kept.size()), first_corners).items;
  std::vector<int> face_id(faces_.size(), -1);
  for_each_index(order.size(), [&](size_t g) {
    face_id[static_cast<size_t>(left[static_cast<size_t>(order[g])])] = static_cast<int>(g);
  });

  const auto renumber = [&](int h) { return h < 0 ? -1 : 3 * face_id[static_cast<size_t>(h / 3)] + h % 3; };
  const Triangulation old = std::move(*this);
  faces_.resize(order.size());
  sides_.resize(old.sides_.empty() ? 0 : order.size());
  twins_.resize(3 * order.size());
  constrained_.resize(3 * order.size());
  for_each_index(order.size(), [&](size_t g) {
    const auto i = static_cast<size_t>(order[g]), f = static_cast<size_t>(left[i]);
    faces_[g] = faces[i];
    if (!sides_.empty()) sides_[g] = old.sides_[f];
    for (size_t k = 0; k < 3; ++k) {
      twins_[3 * g + k] = renumber(old.twins_[3 * f + k]);
      constrained_[3 * g + k] = old.constrained_[3 * f + k];
    }
  });
  leaving_.resize(kept.size());
  valences_.resize(kept.size());
  on_boundary_.resize(kept.size());
  for_each_index(kept.size(), [&](size_t i) {
    const auto v = static_cast<size_t>(kept[i]);
    leaving_[i] = renumber(old.leaving_[v]);
    valences_[i] = old.valences_[v];
    on_boundary_[i] = old.on_boundary_[v];
  });
  return kept;
}

}  // namespace hooke
