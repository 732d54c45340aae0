#include "hooke/mesh/validation.h"

#include <fmt/format.h>

#include "hooke/core/error.h"
#include "hooke/springs/sizing.h"

namespace hooke {
namespace {

struct Explanation {
  ProblemKind kind;
  const char* name;
  const char* what;  // in the plural
  const char* help;
};

constexpr Explanation explanations[] = {
    {ProblemKind::no_faces, "no_faces", "no faces", "give a surface mesh, not a point cloud or curves"},
    {ProblemKind::index_out_of_range, "index_out_of_range", "face corners that are not vertices",
     "correct the indices"},
    {ProblemKind::repeated_index, "repeated_index", "faces that use a vertex twice", "remove these faces"},
    {ProblemKind::not_finite, "not_finite", "vertices that are not finite", "correct their coordinates"},
    {ProblemKind::duplicate_face, "duplicate_face", "faces listed twice", "remove the duplicates"},
    {ProblemKind::non_manifold_edge, "non_manifold_edge", "edges with three or more faces",
     "remove or separate the extra faces"},
    {ProblemKind::inconsistent_orientation, "inconsistent_orientation",
     "edges whose two faces are oriented against each other",
     "orient the faces alike (impossible on a one-sided surface)"},
    {ProblemKind::non_manifold_vertex, "non_manifold_vertex", "vertices in which separate parts only touch",
     "give each part its own vertex"},
    {ProblemKind::no_area, "no_area", "no face with an area", "check the coordinates"},
    {ProblemKind::zero_area_faces, "zero_area_faces", "faces without area", ""},
    {ProblemKind::isolated_vertices, "isolated_vertices", "vertices in no face, kept where they are", ""},
    {ProblemKind::unconnected_triangles, "unconnected_triangles",
     "no two triangles share a vertex: every one is on its own", ""},
};

const Explanation& explain(ProblemKind kind) {
  return explanations[static_cast<size_t>(kind)];
}

bool is_about_the_whole(ProblemKind kind) {
  return kind == ProblemKind::no_faces || kind == ProblemKind::no_area ||
         kind == ProblemKind::unconnected_triangles;
}

std::string face_text(int triangle, const MeshSource& source) {
  const int face = source.face.empty() ? triangle : source.face[static_cast<size_t>(triangle)];
  return source.line.empty() ? std::to_string(face)
                             : fmt::format("{} (line {})", face, source.line[static_cast<size_t>(face)]);
}

// The places of a problem: "edges 3-5, 5-9; faces 1, 2, 7".
std::string places_text(const Problem& problem, const MeshSource& source) {
  const bool edges =
      problem.kind == ProblemKind::non_manifold_edge || problem.kind == ProblemKind::inconsistent_orientation;
  std::string vertices, faces;
  for (size_t k = 0; k < problem.vertices.size(); ++k) {
    if (k > 0) vertices += edges && k % 2 == 1 ? "-" : ", ";
    vertices += std::to_string(problem.vertices[k]);
  }
  for (const int face : problem.faces) faces += (faces.empty() ? "" : ", ") + face_text(face, source);
  const std::string more = problem.count > most_places ? " ..." : "";
  if (problem.faces.empty()) return "vertices " + vertices + more;
  if (problem.vertices.empty()) return "faces " + faces + more;
  return fmt::format("{} {}{}, faces {}{}", edges ? "edges" : "vertices", vertices, more, faces, more);
}

std::string problem_text(const Problem& problem, const MeshSource& source) {
  const Explanation& explanation = explain(problem.kind);
  if (is_about_the_whole(problem.kind)) return explanation.what;
  return fmt::format("{} ({}): {}", explanation.what, problem.count, places_text(problem, source));
}

}  // namespace

std::string name_of(ProblemKind kind) {
  return explain(kind).name;
}

bool is_acceptable(ProblemKind kind) {
  return kind >= ProblemKind::zero_area_faces;
}

Warnings require_valid(const Mat3X& points, const std::vector<Triangle>& triangles,
                       const MeshSource& source) {
  std::string errors, help;
  Warnings warnings;
  for (const Problem& problem : find_problems(points, triangles)) {
    const std::string text = problem_text(problem, source);
    if (is_acceptable(problem.kind)) {
      warnings.push_back({name_of(problem.kind), fmt::format("{}: {}", source.name, text)});
    } else {
      errors += (errors.empty() ? "" : "; ") + text;
      help += (help.empty() ? "" : ", ") + std::string(explain(problem.kind).help);
    }
  }
  if (!errors.empty())
    throw MeshError(fmt::format("{}: {}; expected an oriented manifold surface with area; {}", source.name,
                                errors, help));
  return warnings;
}

void require_workable_size(const Mat3X& points, const std::string& name) {
  constexpr double least = 1e-50, most = 1e50;
  const double diagonal = box_diagonal(points);
  if (!(diagonal >= least && diagonal <= most))
    throw MeshError(fmt::format(
        "{}: the diagonal of its box is {:.3g}; expected {:.0e} to {:.0e}; scale the mesh, or use "
        "another unit",
        name, diagonal, least, most));
}

}  // namespace hooke
