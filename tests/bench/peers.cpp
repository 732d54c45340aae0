// peers METHOD INPUT.off OUTPUT.off [LENGTH]: what other libraries make of a mesh, for comparison by peers.py
// and peers_on_bodies.py. CGAL is GPL: this program is built on request only (HOOKE_BENCHMARKS) and no part
// of the tool.
//
//   cgal-angle          angle smoothing with safety constraints, no flips, 20 rounds
//   cgal-angle-flips    angle and area smoothing with Delaunay flips, 10 rounds (area needs Ceres)
//   cgal-relax-angle    tangential relaxation, 10 rounds, then angle smoothing, 10 rounds
//   cgal-isotropic      isotropic remeshing to the natural length or LENGTH, 10 rounds
//   cgal-creases        the same with edges sharper than 40 degrees split to LENGTH, then protected
//   openmesh-smoother   Jacobi Laplace smoother, tangential, 100 rounds

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/angle_and_area_smoothing.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>
#include <CGAL/Surface_mesh.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
namespace options = CGAL::parameters;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

double length = 0;  // 0: natural

double target_length(const Mesh& mesh) {
  if (length > 0) return length;
  return std::sqrt(4 * pmp::area(mesh) / (std::sqrt(3.) * static_cast<double>(mesh.number_of_faces())));
}

void angle(Mesh& mesh, unsigned rounds) {
  pmp::angle_and_area_smoothing(mesh, options::number_of_iterations(rounds)
                                          .use_area_smoothing(false)
                                          .use_Delaunay_flips(false)
                                          .use_safety_constraints(true));
}

void angle_with_flips(Mesh& mesh) {
  pmp::angle_and_area_smoothing(
      mesh, options::number_of_iterations(10).use_Delaunay_flips(true).use_safety_constraints(true));
}

void relax_and_angle(Mesh& mesh) {
  pmp::tangential_relaxation(vertices(mesh), mesh, options::number_of_iterations(10));
  angle(mesh, 10);
}

void isotropic(Mesh& mesh) {
  pmp::isotropic_remeshing(faces(mesh), target_length(mesh), mesh, options::number_of_iterations(10));
  mesh.collect_garbage();
}

void isotropic_between_creases(Mesh& mesh) {
  const auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(mesh, 40, is_sharp);
  const double target = target_length(mesh);
  std::vector<Mesh::Edge_index> sharp;
  for (const auto e : mesh.edges())
    if (is_sharp[e]) sharp.push_back(e);
  pmp::split_long_edges(sharp, 4. / 3 * target, mesh, options::edge_is_constrained_map(is_sharp));
  pmp::isotropic_remeshing(
      faces(mesh), target, mesh,
      options::number_of_iterations(10).protect_constraints(true).edge_is_constrained_map(is_sharp));
  mesh.collect_garbage();
}

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Reads and writes with CGAL: OpenMesh's files lose double precision.
void openmesh_smoother(Mesh& mesh) {
  OpenMeshMesh m;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    m.add_vertex({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    std::vector<OpenMeshMesh::VertexHandle> corners;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners.emplace_back(static_cast<int>(v.idx()));
    m.add_face(corners);
  }
  m.request_vertex_status();
  m.request_face_normals();
  m.request_vertex_normals();
  m.update_normals();
  OpenMesh::Smoother::JacobiLaplaceSmootherT<OpenMeshMesh> smoother(m);
  smoother.initialize(OpenMesh::Smoother::SmootherT<OpenMeshMesh>::Tangential,
                      OpenMesh::Smoother::SmootherT<OpenMeshMesh>::C1);
  smoother.smooth(100);
  for (const auto v : mesh.vertices()) {
    const auto p = m.point(OpenMeshMesh::VertexHandle(static_cast<int>(v.idx())));
    mesh.point(v) = {p[0], p[1], p[2]};
  }
}

const std::map<std::string, std::function<void(Mesh&)>> methods = {
    {"cgal-angle", [](Mesh& m) { angle(m, 20); }}, {"cgal-angle-flips", angle_with_flips},
    {"cgal-relax-angle", relax_and_angle},         {"cgal-isotropic", isotropic},
    {"openmesh-smoother", openmesh_smoother},      {"cgal-creases", isotropic_between_creases},
};

}  // namespace

int main(int argc, char** argv) {
  const auto method = argc == 4 || argc == 5 ? methods.find(argv[1]) : methods.end();
  if (method == methods.end()) {
    std::fprintf(stderr, "usage: peers METHOD INPUT.off OUTPUT.off [LENGTH]; METHOD is one of");
    for (const auto& [name, run] : methods) std::fprintf(stderr, " %s", name.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  if (argc == 5) length = std::strtod(argv[4], nullptr);
  Mesh mesh;
  if (!CGAL::IO::read_OFF(argv[2], mesh)) {
    std::fprintf(stderr, "peers: %s: not read; expected an OFF file with a manifold mesh\n", argv[2]);
    return 3;
  }
  method->second(mesh);
  if (!CGAL::IO::write_OFF(argv[3], mesh, options::stream_precision(17))) {
    std::fprintf(stderr, "peers: %s: not written\n", argv[3]);
    return 5;
  }
  return 0;
}
