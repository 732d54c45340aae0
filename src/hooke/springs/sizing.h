// Sizing: which target lengths the user asks for.
#pragma once

#include <string>

#include "hooke/mesh/adjacency.h"

namespace hooke {

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
double resolve_length(const LengthSpec& spec, const Mat3X& points, const Adjacency& adjacency);

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
                                           const Adjacency& adjacency);

/// Where target lengths per vertex come from, as the user says it.
struct SizingSource {
  enum class Kind { none, file, ply_property, curvature };
  Kind kind = Kind::none;
  std::string name;         // of the file or the property
  double chord_error = .1;  // of curvature; positive
  bool percent = true;      // of the box's diagonal; else in the unit of the points
};

/// Reads "FILE", "ply:PROPERTY", "curvature", "curvature:X" or "curvature:X%". Throws Error whose
/// message begins with what is wrong.
SizingSource parse_sizing(const std::string& text);

/// UniformVector from curvature: l = sqrt(8 R t - 4 t^2) per vertex, the chord of a circle of radius R with
/// the sagitta t, where t is the chord error, and R the least radius of curvature there but no less than t;
/// at most `longest`. All in the unit of the points. Pre-condition: both are positive.
std::vector<double> curvature_lengths(const Mat3X& points, const Adjacency& adjacency, double chord_error,
                                      double longest);

/// Lowers target lengths until along every edge they differ by at most `slope` times the edge's length; the
/// greatest lengths that do and are nowhere above the given ones. Infinity limits nothing.
/// Pre-condition: slope is positive. H. Borouchaki, F. Hecht, P. J. Frey, "Mesh gradation control", 1998.
void limit_gradation(const Mat3X& points, const Adjacency& adjacency, double slope,
                     std::vector<double>& vertex_length);

}  // namespace hooke
