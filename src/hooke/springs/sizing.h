// Sizing: target lengths as the user specifies them, one for all edges or one per vertex, from a file or from
// curvature, and their gradation.
#pragma once

#include <string>

#include "hooke/mesh/mesh.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

/// A target length as the user specifies it.
struct LengthSpec {
  enum class Kind { natural, mean, absolute, percent_of_diagonal, times_natural, as_given };
  /// Whose natural length it is where no sizing is given: that of each part of the mesh, as parts cannot
  /// exchange faces, or where faces are made, so that no part gets coarser, the shorter one of the part's and
  /// the whole mesh's.
  enum class Natural { of_parts, shorter };
  Kind kind = Kind::natural;
  double value = 0;  // of absolute, percent_of_diagonal and times_natural; positive
  Natural whose = Natural::of_parts;
};

/// Parses "auto", "mean", "X", "X%" (of the bounding box diagonal), "Xx" (times the natural length) or
/// "sizing" (the lengths of a sizing unscaled). Throws an Error whose message begins with the text.
LengthSpec parse_length(const std::string& text);

/// The length specified, in the unit of the points; natural ones are those of the whole mesh. Throws Error
/// for as_given.
double resolve_length(const LengthSpec& spec, const Mat3X& points, const Adjacency& adjacency);

/// Target lengths per vertex, before they are scaled as a LengthSpec says.
struct Sizing {
  std::vector<double> vertex_length;  // positive; empty: uniform
  double gradation = .3;              // maximum difference along an edge, over the edge's length
};

/// Target length of every vertex: those of the sizing, scaled as the spec says and finally limited by the
/// gradation, see limit_gradation(). natural, times_natural: their covering_length() is the spec's length, so
/// that for `natural` the area is covered by as many equilateral triangles as the mesh has faces. mean,
/// absolute, percent_of_diagonal: their mean_length() is the spec's length. as_given: not scaled. Without a
/// sizing all are the spec's length, of parts as LengthSpec::Natural says; `joined` are the copies of
/// vertices, see mesh/junctions.h. Throws Error for as_given without a sizing.
std::vector<double> resolve_vertex_lengths(const LengthSpec& spec, const Sizing& sizing, const Mat3X& points,
                                           const Adjacency& adjacency, const std::vector<int>& joined = {});

/// Sets v:target_length of a mesh as above; of the sizing the lengths are by vertex id.
void set_target_lengths(TriMesh& mesh, const MemoryOrder& memory_order, const LengthSpec& spec = {},
                        Sizing sizing = {});

/// The target lengths of a mesh: those of `e:target_length`, and without this property those that spread from
/// `v:target_length`, multiplied by `e:rest_ratio` if it has this. The vertices of the adjacency are in this
/// order. Throws Error without both properties.
TargetLengths target_lengths_of(const TriMesh& mesh, const Permutation& order, const Adjacency& adjacency);

/// The source of target lengths per vertex, as the user specifies it.
struct SizingSource {
  enum class Kind { none, values, file, ply_property, curvature, input };
  Kind kind = Kind::none;
  std::vector<double> values = {};  // of kind `values`: one per vertex id, positive
  std::string name;                 // of the file or the property
  double chord_error = .1;          // of curvature; positive
  bool percent = true;              // of the bounding box diagonal; else in the unit of the points
};

/// Parses "FILE", "ply:PROPERTY", "curvature", "curvature:X", "curvature:X%" or "input". Throws an Error
/// whose message begins with what is wrong.
SizingSource parse_sizing(const std::string& text);

/// Target lengths from curvature: l = sqrt(8 R t - 4 t^2) per vertex, the chord of a circle of radius R with
/// the sagitta t, where t is the chord error and R the minimum radius of curvature there, at least t; l is at
/// most `longest`. All in the unit of the points. Pre-condition: `chord_error` and `longest` are positive.
std::vector<double> curvature_lengths(const Mat3X& points, const Adjacency& adjacency, double chord_error,
                                      double longest);

/// Target lengths as the mesh has them, in the unit of the points: at each vertex that of equilateral faces
/// with the mean area of its faces, but at least a thousandth of the natural length of the mesh.
/// Pre-condition: there are faces, and their area is positive.
std::vector<double> input_lengths(const Mat3X& points, const Adjacency& adjacency);

/// Lowers target lengths until along every edge they differ by at most `slope` times the edge's length. The
/// result is the largest such function nowhere above the given lengths. An infinite slope limits nothing.
/// Pre-condition: slope is positive. H. Borouchaki, F. Hecht, P. J. Frey, "Mesh gradation control", 1998.
void limit_gradation(const Mat3X& points, const Adjacency& adjacency, double slope,
                     std::vector<double>& vertex_length);

}  // namespace hooke
