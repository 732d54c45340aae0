// Curves of junctions (see mesh/junctions.h): the lines in which sheets meet, along which the vertices of
// these lines slide, all copies of a vertex at once.
#pragma once

#include "hooke/constraints/constraints.h"
#include "hooke/core/lists.h"
#include "hooke/mesh/junctions.h"

namespace hooke {

/// Sets all that the constraints know of junctions, and the segments of their vertices; the numbers are those
/// of `joined`. A curve ends where other than two junction edges meet, at vertices in which sheets only
/// touch, at other feature edges, at corners (options.corner_angle), at the vertices `held`, and where
/// something else has the same place. Vertices at the bends of an even curve (options.even_crease) stand
/// still, as on creases.
void constrain_junctions(const Mat3X& points, const Adjacency& adjacency, const Junctions& junctions,
                         const std::vector<int>& joined, const std::vector<int>& held,
                         const ConstraintOptions& options, Constraints& constraints);

/// By number of the junction vertex, the vertices that are its copies, ascending.
IntLists copies_of_junctions(const Constraints& constraints);

/// Calls visit(copies) for each vertex of a junction that slides.
template <typename Visit>
void for_each_sliding(const Constraints& constraints, const Visit& visit) {
  if (constraints.junction_vertices.empty()) return;
  const IntLists copies = copies_of_junctions(constraints);
  for (std::size_t n = 0; n < constraints.junction_vertices.size(); ++n) {
    const std::span<const int> all = copies[static_cast<int>(n)];
    if (constraints.junction_vertices[n].slides && !all.empty()) visit(all);
  }
}

/// For each vertex the first of the copies that it slides with, or itself; empty without junctions.
std::vector<int> first_sliding_copies(const Constraints& constraints);

/// Adds the copies of those among the vertices that slide with them; sorted, each vertex once.
void add_sliding_copies(const Constraints& constraints, const IntLists& copies, std::vector<int>& vertices);

}  // namespace hooke
