// Pattern search for the place of one vertex where the least angle about it is greatest.
#pragma once

#include <array>

#include "hooke/integrator/integrator.h"
#include "hooke/integrator/vertex_ring.h"

namespace hooke {

struct VertexSearchOptions {
  int directions = 8;        // that a vertex looks into
  double first_step = .3;    // target lengths, halved ...
  double last_step = .01;    // ... down to this
  double least_gain = 1e-3;  // of the cotangent; less is not worth a move
};

/// Works on one vertex at a time; made once for many, for its memory. Keeps references.
class VertexSearch {
 public:
  VertexSearch(Relaxation& relaxation, const VertexSearchOptions& options, const GuardOptions& guards);

  /// Moves the vertex, as far as the guards let it, until no cotangent about it is above the goal or it finds
  /// nothing better. Returns whether it moved.
  bool improve(int vertex, double goal);

 private:
  struct Side {
    VertexRing ring;
    RingShape before, after;
  };

  void look(int vertex);
  double outcome(const VertexPlace& place);
  bool may_go() const;
  bool try_all(int vertex, double step);

  Relaxation& r_;
  const VertexSearchOptions& o_;
  const GuardOptions& guards_;
  std::vector<Eigen::Vector2d> directions_;
  std::array<Side, 2> sides_;
  int count_ = 1;     // of the sides
  double worst_ = 0;  // greatest cotangent about the vertex
};

}  // namespace hooke
