// Where a result does not keep its input: its faces and vertices, and those of the input, at which something
// is to be mended.
#pragma once

#include <vector>

#include "hooke/core/types.h"

namespace hooke {

class AttemptMaker;
struct Attempt;

/// Of the vertices of the input: what is wrong at no more of them may stay as it is there.
inline constexpr double few_vertices = .05;

/// The crease edges of a result: their ends in memory order, ascending, as are the edges.
std::vector<Edge> sorted_creases(const Attempt& attempt);

/// The edges of a result, which has these points in memory order, that fold and are no creases: their ends,
/// ascending.
std::vector<Edge> folds_off_creases(const Attempt& attempt, const Mat3X& points);

/// How many flaws a result, which has these points in memory order, has at each of its vertices: a lost
/// vertex counts at a corner of the face closest to it, and each face that is turned over, intersects where
/// the input does not or has no area, and each fold that is no crease, at one of its corners.
std::vector<int> flaws_at_vertices(const Attempt& attempt, const Mat3X& points);

/// Per vertex of the input in memory order, how much the result does not keep its surface there: the distance
/// over its limit at vertices that are lost and at the corners of the faces closest to its own vertices that
/// are too far; infinite at the ends of lost creases and at the faces closest to its folds or to faces that
/// are turned over, intersect, or have no area or too small angles; 0 where nothing is wrong.
std::vector<double> excess_at_input(const AttemptMaker& maker, const Attempt& attempt);

/// A point or segment where a result does not keep its input, by how much as above, and the target length of
/// the result there.
struct FlawPlace {
  Vec3 from, to;
  double excess;
  double length;

  bool operator==(const FlawPlace& other) const { return from == other.from && to == other.to; }
};

/// At the vertices of the result at which something is wrong, at lost vertices, and along lost creases.
std::vector<FlawPlace> places_of_flaws(const AttemptMaker& maker, const Attempt& attempt);

/// The vertices of the input where excess_at_input() is not 0. Ascending, in memory order.
std::vector<int> input_vertices_at_flaws(const AttemptMaker& maker, const Attempt& attempt);

/// The vertices of a result with the faces of its input that are too far, lost, at lost creases, or at faces
/// that are turned over, intersect, fold more than in the input, or have no area or too small angles.
/// Ascending, in memory order.
std::vector<int> vertices_to_put_back(const AttemptMaker& maker, const Attempt& attempt);

}  // namespace hooke
