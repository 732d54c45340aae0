#include "hooke/length_field.h"

#include <algorithm>
#include <limits>

#include "hooke/closest_point.h"

namespace hooke {

LengthField::LengthField(const Mat3X& points, std::shared_ptr<const Connectivity> connectivity,
                         const std::vector<double>& vertex_length) {
  const auto [least, most] = std::ranges::minmax_element(vertex_length);
  if (least == vertex_length.end() || *least == *most) return;
  points_ = points;
  connectivity_ = std::move(connectivity);
  vertex_length_ = vertex_length;
}

double LengthField::at(const Vec3& x, int& anchor) const {
  const auto length = [&](int v) { return vertex_length_[static_cast<size_t>(v)]; };
  double result = length(anchor);
  double nearest = std::numeric_limits<double>::infinity();
  for (;;) {
    int next = anchor;
    for (int f : connectivity_->vertex_faces[anchor]) {
      const auto& [a, b, c] = connectivity_->faces[static_cast<size_t>(f)];
      const TrianglePoint foot = closest_point_on_triangle(points_.col(a), points_.col(b), points_.col(c), x);
      if (!(foot.squared_distance < nearest)) continue;
      nearest = foot.squared_distance;
      result = foot.weights.dot(Vec3(length(a), length(b), length(c)));
      const double most = foot.weights.maxCoeff();
      next = most == foot.weights[0] ? a : most == foot.weights[1] ? b : c;
    }
    if (next == anchor) return result;
    anchor = next;
  }
}

}  // namespace hooke
