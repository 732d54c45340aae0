// Target lengths: what each edge wants to be.
#pragma once

#include "hooke/connectivity.h"

namespace hooke {

/// Target lengths of the springs, in the unit of the points.
struct TargetLengths {
  std::vector<double> edge;  // mean of the ends: the rule that always keeps the triangle inequality
  std::vector<double> face;  // mean of the three edges
};

/// Sum of the areas of the faces.
double total_area(const Mat3X& points, const std::vector<Triangle>& faces);

/// L* = sqrt(4 A / (sqrt 3 F)): the edge of F equilateral triangles that cover the area A.
double natural_length(double area, std::size_t face_count);

/// A target length as the user says it.
struct LengthSpec {
  enum class Kind { natural, mean, absolute, percent_of_diagonal, times_natural };
  Kind kind = Kind::natural;
  double value = 0;  // of the last three kinds; positive
};

/// Reads "auto", "mean", "X", "X%" (of the box's diagonal) or "Xx" (times the natural length). Throws Error.
LengthSpec parse_length(const std::string& text);

/// The length that is meant, in the unit of the points.
double resolve_length(const LengthSpec& spec, const Mat3X& points, const Connectivity& connectivity);

/// Spreads target lengths given per vertex to edges and faces.
TargetLengths spread_target_lengths(const Connectivity& connectivity,
                                    const std::vector<double>& vertex_length);

}  // namespace hooke
