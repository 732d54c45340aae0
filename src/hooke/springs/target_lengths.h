// Target lengths: what each edge wants to be.
#pragma once

#include "hooke/core/uniform_vector.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Target lengths of the springs, in the unit of the points.
struct TargetLengths {
  Lengths edge;  // mean of the ends: the rule that always keeps the triangle inequality
  Lengths face;  // mean of the three edges
};

/// Sum of the areas of the faces.
double total_area(const Mat3X& points, const std::vector<Triangle>& faces);

/// L* = sqrt(4 A / (sqrt 3 F)): the edge of F equilateral triangles that cover the area A.
double natural_length(double area, std::size_t face_count);

/// A target length as the user says it.
struct LengthSpec {
  enum class Kind { natural, mean, absolute, percent_of_diagonal, times_natural, as_given };
  Kind kind = Kind::natural;
  double value = 0;  // of absolute, percent_of_diagonal and times_natural; positive
};

/// Reads "auto", "mean", "X", "X%" (of the box's diagonal), "Xx" (times the natural length) or "sizing" (the
/// lengths of a sizing as they are). Throws Error that begins with the text.
LengthSpec parse_length(const std::string& text);

/// The length that is meant, in the unit of the points. Pre-condition: not as_given.
double resolve_length(const LengthSpec& spec, const Mat3X& points, const Connectivity& connectivity);

/// Target lengths that differ from vertex to vertex, before they are brought to the scale of a LengthSpec.
struct Sizing {
  std::vector<double> vertex_length;  // positive; empty: the same everywhere
  double gradation = .3;              // greatest difference along an edge, over the edge's length
};

/// Target length of every vertex: those of the sizing, scaled as the spec says and limited by the gradation
/// (see gradation.h), which has the last word. natural, times_natural: their covering_length() is the spec's
/// length, so that with `natural` as many equilateral triangles as the mesh has faces cover its area. mean,
/// absolute, percent_of_diagonal: their mean_length() is the spec's length. as_given: not scaled. Throws
/// Error for as_given without a sizing.
std::vector<double> resolve_vertex_lengths(const LengthSpec& spec, const Sizing& sizing, const Mat3X& points,
                                           const Connectivity& connectivity);

/// The edge length at which equilateral triangles that are all alike would be as many on the mesh as those
/// that have the target length at every place: L^-2 is the mean over the area of L_f^-2. Pre-condition: there
/// are faces.
double covering_length(const Mat3X& points, const Connectivity& connectivity, const TargetLengths& targets);

/// Mean of the target lengths over the edges that a mesh which has them would have: many where they are
/// small. Exact when all are the same. Pre-condition: there are edges.
double mean_length(const Mat3X& points, const Connectivity& connectivity, const TargetLengths& targets);

/// Lengths from curvature: l = sqrt(8 R t - 4 t^2) per vertex, the chord of a circle of radius R with the
/// sagitta t, where t is the chord error, and R the least radius of curvature there but no less than t; at
/// most `longest`. All in the unit of the points. Pre-condition: both are positive.
std::vector<double> curvature_lengths(const Mat3X& points, const Connectivity& connectivity,
                                      double chord_error, double longest);

/// Diagonal of the box of the points.
double box_diagonal(const Mat3X& points);

/// Spreads target lengths given per vertex to edges and faces.
TargetLengths spread_target_lengths(const Connectivity& connectivity,
                                    const std::vector<double>& vertex_length);

}  // namespace hooke
