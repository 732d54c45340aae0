#include "hooke/integrator/preconditioner.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "hooke/constraints/junction_curves.h"
#include "hooke/core/parallel.h"
#include "hooke/integrator/gauss_seidel.h"

namespace hooke {
namespace {

constexpr int coarsest_nodes = 60;  // a level with fewer nodes is the coarsest
constexpr int max_levels = 24;
/// The number of the farthest cell, so that an int holds it; vertices without faces may lie beyond it.
constexpr double farthest = 1e9;
constexpr size_t max_parts = 8, min_part = 4096;  // of the vertices, summed separately

using Cell = std::array<int, 3>;

struct CellHash {
  size_t operator()(const Cell& c) const {
    size_t h = 0;
    for (int i : c) h = h * 0x9e3779b97f4a7c15ULL + static_cast<size_t>(static_cast<unsigned>(i)) + (h >> 29);
    return h;
  }
};

/// Numbers the nodes of one grid in the order of their first use.
class NodeNumbers {
 public:
  int operator[](const Cell& cell) {
    const auto [it, fresh] = ids_.try_emplace(cell, static_cast<int>(cells_.size()));
    if (fresh) cells_.push_back(cell);
    return it->second;
  }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::unordered_map<Cell, int, CellHash> ids_;
  std::vector<Cell> cells_;
};

/// Right-handed axes through three vertices chosen by index; they rotate with the mesh. Linear also where
/// most vertices coincide or lie on a line, as vertices without faces may.
Eigen::Matrix3d frame_of(const Mat3X& points) {
  constexpr int max_tries = 8;
  const Eigen::Index n = points.cols();
  const Vec3 origin = points.col(0);
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  const auto find = [&](Eigen::Index first, Eigen::Index first_of_others, bool looks_at_all) {
    int tries = 0;
    for (Eigen::Index i = first; i < n && tries < max_tries; ++i) {
      const Vec3 a = points.col(i) - origin;
      if (a.isZero(0)) continue;
      ++tries;
      for (Eigen::Index j = first_of_others; j < (looks_at_all ? n : i); ++j) {
        const Vec3 b = points.col(j) - origin, c = a.cross(b);
        if (c.norm() <= .1 * a.norm() * b.norm() || c.isZero(0)) continue;
        frame.row(0) = a.normalized();
        frame.row(2) = c.normalized();
        frame.row(1) = frame.row(2).cross(frame.row(0));
        return true;
      }
    }
    return false;
  };
  if (!find(n / 2, n / 4, false)) find(1, 1, true);
  return frame;
}

/// Corner k of a cell is at the upper end in direction d if bit d of k is set.
bool is_high(unsigned k, unsigned d) {
  return (k >> d) & 1;
}

std::array<int, 8> corners_of(const Cell& cell, NodeNumbers& nodes) {
  std::array<int, 8> ids;
  for (unsigned k = 0; k < 8; ++k)
    ids[k] = nodes[{cell[0] + is_high(k, 0), cell[1] + is_high(k, 1), cell[2] + is_high(k, 2)}];
  return ids;
}

/// Values of the hat functions of a cell's corners at the offset t within the cell.
std::array<float, 8> hat_values(const Eigen::Vector3f& t) {
  std::array<float, 8> weights;
  for (unsigned k = 0; k < 8; ++k) {
    float weight = 1;
    for (unsigned d = 0; d < 3; ++d) weight *= is_high(k, d) ? t[d] : 1 - t[d];
    weights[k] = weight;
  }
  return weights;
}

}  // namespace

GridHierarchy::GridHierarchy(const Mat3X& points, double cell) {
  if (points.cols() == 0) return;
  const Eigen::Matrix3d frame = frame_of(points);
  const Vec3 origin = points.col(0);
  const size_t n = points.cols();
  grid_positions_.resize(n);
  std::vector<Cell> cells(n);
  parallel_for(n, 4096, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      // Half a cell off the origin, so that the first vertex does not lie on a corner shared by cells.
      const Vec3 x = frame * (points.col(static_cast<Eigen::Index>(v)) - origin) / cell + Vec3::Constant(.5);
      const Vec3 low = x.array().floor().cwiseMax(-farthest).cwiseMin(farthest);
      cells[v] = {static_cast<int>(low[0]), static_cast<int>(low[1]), static_cast<int>(low[2])};
      grid_positions_[v].within = (x - low).cast<float>();
    }
  });
  NodeNumbers nodes;
  std::unordered_map<Cell, int, CellHash> cell_ids;
  int id = -1;  // cell of the previous vertex, which mostly holds the next one too
  for (size_t v = 0; v < n; ++v) {
    if (v == 0 || cells[v] != cells[v - 1]) {
      const auto [it, fresh] = cell_ids.try_emplace(cells[v], static_cast<int>(cells_.size()));
      if (fresh) cells_.push_back(corners_of(cells[v], nodes));
      id = it->second;
    }
    grid_positions_[v].cell = id;
  }
  for (;;) {
    Level level;
    level.nodes = static_cast<int>(nodes.cells().size());
    if (level.nodes < coarsest_nodes || level_count() + 1 == max_levels) {
      levels_.push_back(std::move(level));
      break;
    }
    NodeNumbers coarser;
    for (const Cell& at : nodes.cells()) {
      // A node with an even coordinate lies on a coarser node, one with an odd coordinate midway between two.
      Interpolation row;
      for (unsigned k = 0; k < 8; ++k) {
        Cell corner;
        double weight = 1;
        for (unsigned d = 0; d < 3; ++d) {
          const bool odd = at[d] & 1;
          const bool high = is_high(k, d);
          corner[d] = (at[d] >> 1) + (odd && high);
          weight *= odd ? .5 : (high ? 0 : 1);
        }
        row.node[k] = coarser[corner];
        row.weight[k] = static_cast<float>(weight);
      }
      level.to_coarser.push_back(row);
    }
    levels_.push_back(std::move(level));
    nodes = std::move(coarser);
  }
  parts_ = part_vertices();
}

std::vector<GridHierarchy::Part> GridHierarchy::part_vertices() const {
  std::vector<Part> parts(std::clamp<size_t>(grid_positions_.size() / min_part, 1, max_parts));
  for (size_t i = 0; i < parts.size(); ++i) {
    Part& part = parts[i];
    part = {i * grid_positions_.size() / parts.size(), (i + 1) * grid_positions_.size() / parts.size(),
            levels_[0].nodes, 0};
    for (size_t v = part.first_vertex; v < part.last_vertex; ++v)
      for (int node : cells_[grid_positions_[v].cell]) {
        part.first_node = std::min(part.first_node, node);
        part.last_node = std::max(part.last_node, node + 1);
      }
  }
  return parts;
}

/// P^T residual on the finest grid. Parts of the vertices are summed separately, then added in order.
Mat3X GridHierarchy::collect(const Mat3X& residual) const {
  std::vector<Mat3X> sums(parts_.size());
  parallel_for(parts_.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Part& part = parts_[i];
      sums[i] = Mat3X::Zero(3, part.last_node - part.first_node);
      for (size_t v = part.first_vertex; v < part.last_vertex; ++v) {
        const auto& nodes = cells_[grid_positions_[v].cell];
        const auto weights = hat_values(grid_positions_[v].within);
        for (size_t k = 0; k < 8; ++k)
          sums[i].col(nodes[k] - part.first_node) += weights[k] * residual.col(static_cast<Eigen::Index>(v));
      }
    }
  });
  Mat3X sum = Mat3X::Zero(3, levels_[0].nodes);
  for (size_t i = 0; i < parts_.size(); ++i) sum.middleCols(parts_[i].first_node, sums[i].cols()) += sums[i];
  return sum;
}

GridHierarchy::Correction GridHierarchy::solve(const Mat3X& residual) const {
  if (levels_.empty()) return {};
  std::vector<Mat3X> values;
  values.push_back(collect(residual));
  for (size_t l = 0; l + 1 < levels_.size(); ++l) {
    values.push_back(Mat3X::Zero(3, levels_[l + 1].nodes));
    for (size_t i = 0; i < levels_[l].to_coarser.size(); ++i)
      for (size_t k = 0; k < 8; ++k)
        values[l + 1].col(levels_[l].to_coarser[i].node[k]) +=
            levels_[l].to_coarser[i].weight[k] * values[l].col(static_cast<Eigen::Index>(i));
  }
  for (size_t l = levels_.size() - 1; l-- > 0;)
    parallel_for(levels_[l].to_coarser.size(), 4096, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        for (size_t k = 0; k < 8; ++k)
          values[l].col(static_cast<Eigen::Index>(i)) +=
              levels_[l].to_coarser[i].weight[k] * values[l + 1].col(levels_[l].to_coarser[i].node[k]);
    });
  return {std::move(values[0])};
}

void GridHierarchy::add(const Correction& correction, double weight, Mat3X& vectors) const {
  parallel_for(grid_positions_.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      const auto& nodes = cells_[grid_positions_[v].cell];
      const auto weights = hat_values(grid_positions_[v].within);
      for (size_t k = 0; k < 8; ++k)
        vectors.col(static_cast<Eigen::Index>(v)) += weight * weights[k] * correction.at_nodes.col(nodes[k]);
    }
  });
}

namespace {

constexpr double grid_cell = 4;     // width of the finest grid's cells, in mean target lengths
constexpr double grid_weight = .3;  // weight of each grid, over the median curvature

}  // namespace

Preconditioner::Preconditioner(const Relaxation& r) : grids_(r.positions.points, grid_cell) {}

void Preconditioner::refresh(Relaxation& r) {
  const size_t n = r.adjacency.vertex_count;
  inverse_.resize(n);
  std::vector<float> mean(n, 0);  // single precision suffices for a weight, and saves memory at the peak
  parallel_for(n, 256, [&](size_t begin, size_t end) {
    LocalNewton newton(r);
    for (size_t v = begin; v < end; ++v) {
      const LocalCurvature c = newton.curvature(static_cast<int>(v));
      inverse_[v] = SymmetricMatrix(c.inverse);
      mean[v] = static_cast<float>(c.mean);
    }
  });
  LocalNewton newton(r);
  for_each_sliding(r.retraction.constraints(), [&](std::span<const int> copies) {
    const LocalCurvature c = newton.curvature(copies);
    for (const int v : copies) {
      inverse_[v] = SymmetricMatrix(c.inverse);
      mean[v] = static_cast<float>(c.mean);
    }
  });
  const auto middle = mean.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(mean.begin(), middle, mean.end());
  grid_weight_ = *middle > 0 ? grid_weight / *middle : 0;
}

void Preconditioner::apply(const Relaxation& r, Mat3X& vectors) const {
  const GridHierarchy::Correction correction = grids_.solve(vectors);
  parallel_for(vectors.cols(), 4096, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      auto u = vectors.col(static_cast<Eigen::Index>(v));
      u = inverse_[v] * Vec3(u);
    }
  });
  grids_.add(correction, grid_weight_, vectors);
  r.retraction.constrain(r.positions, vectors);
}

}  // namespace hooke
