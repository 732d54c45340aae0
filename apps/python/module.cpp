// The compiled part of the Python package: runs, reading and writing on numpy arrays of exact types.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "hooke/core/error.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/io/read_mesh.h"
#include "hooke/io/write_mesh.h"
#include "hooke/mesh/junctions.h"
#include "result_files.h"
#include "run_in_memory.h"

namespace py = pybind11;

namespace hooke::python {
namespace {

/// An observer for a run without Python's lock, which it takes at most twenty times a second. Then it lets
/// Python handle signals, Ctrl-C among them, and calls the function with the stage, the outer iteration, the
/// step and the energy. The run stops if either raises an exception, which is kept, or if the function
/// returns False. To be destroyed with the lock.
class PythonObserver {
 public:
  /// `progress`: a function, or None.
  explicit PythonObserver(py::object progress) : progress_(std::move(progress)) {}

  bool operator()(const Progress& progress) {
    constexpr std::chrono::milliseconds pause{50};
    const auto now = std::chrono::steady_clock::now();
    if (!goes_on_ || now - last_ < pause) return goes_on_;
    const py::gil_scoped_acquire lock;
    watch(progress);
    last_ = std::chrono::steady_clock::now();
    return goes_on_;
  }

  /// The exception that stopped the run; None if there was none.
  py::object exception() const { return raised_ ? raised_->value() : py::none(); }

 private:
  void watch(const Progress& progress) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (progress_.is_none()) return;
      const py::object answer = progress_(progress.stage, progress.outer, progress.step, progress.energy);
      goes_on_ = !answer.is(py::bool_(false));
    } catch (py::error_already_set& e) {
      raised_.emplace(std::move(e));
      goes_on_ = false;
    }
  }

  py::object progress_;
  std::optional<py::error_already_set> raised_;
  bool goes_on_ = true;
  std::chrono::steady_clock::time_point last_{};
};

/// Returns work() without Python's lock.
template <typename Work>
auto unlocked(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

/// (old vertices, old faces, whether corners 1 and 2 of the face were swapped) of a repaired mesh; None else.
py::object origin_arrays(const MeshOrigin& origin) {
  if (origin.vertex.empty()) return py::none();
  std::vector<int> vertices;  // without the copies of those of junctions
  for (std::size_t v = 0; v < origin.vertex.size(); ++v)
    if (origin.joined.empty() || origin.joined[v] == static_cast<int>(v))
      vertices.push_back(origin.vertex[v]);
  return py::make_tuple(
      py::array_t<int>(std::ssize(vertices), vertices.data()),
      py::array_t<int>(std::ssize(origin.face), origin.face.data()),
      py::array_t<char>(std::ssize(origin.flipped), origin.flipped.data()).attr("astype")("bool"));
}

/// (vertices, faces, map or None, report as JSON, origin or None, exception or None)
py::tuple run_arrays(const PointArray& vertices, const FaceArray& faces,
                     const std::vector<std::string>& options, std::optional<std::vector<double>> sizing,
                     std::vector<int> fixed_vertices,
                     const std::optional<std::vector<std::tuple<int, int, double>>>& edge_lengths, bool map,
                     const py::object& progress) {
  const Mat3X points = points_of(vertices);
  const std::vector<Triangle> triangles = triangles_of(faces);
  app::Settings settings = app::memory_settings(options);
  if (sizing)
    settings.sizing = {.kind = SizingSource::Kind::values, .values = *std::move(sizing), .name = {}};
  settings.remesh.map = map && !settings.paper;
  settings.remesh.constraints.fixed_vertices = std::move(fixed_vertices);
  if (edge_lengths) {
    settings.edge_length_list.emplace();
    for (const auto& [a, b, length] : *edge_lengths)
      settings.edge_length_list->push_back(
          {{a, b}, length, static_cast<int>(settings.edge_length_list->size()) + 1});
  }
  const bool check = settings.check;
  PythonObserver observer(progress);
  std::optional<ValidMesh> mesh;
  RunRecord record;
  std::string report;
  unlocked([&] {
    mesh.emplace(make_valid_mesh(points, triangles, app::input_name, settings.repair));
    record = app::run_in_memory(std::move(settings), *mesh, std::ref(observer));
    report = app::report_of_memory(record).dump();
  });
  if (check) return py::make_tuple(py::none(), py::none(), py::none(), report, py::none(), py::none());
  py::object places = py::none();
  if (!record.result->map.empty()) places = map_arrays(app::map_of_output(mesh->mesh, mesh->origin, record));
  return py::make_tuple(vertex_array(mesh->mesh), face_array(mesh->mesh), places, report,
                        origin_arrays(mesh->origin), observer.exception());
}

/// (vertices, faces, attributes, format, [(code, message)])
py::tuple read_file(const std::filesystem::path& path, bool keep_junctions) {
  const LoadedMesh loaded = unlocked([&] {
    return read_mesh(path, nullptr, {std::nullopt, {.keep_junctions = keep_junctions}});
  });
  const std::optional<JoinedMesh> joined = join_sheets(loaded.mesh);
  py::list warnings;
  for (const Warnings& of_kind : {loaded.content.anew, loaded.content.no_obj, loaded.warnings})
    for (const Warning& w : of_kind) warnings.append(py::make_tuple(w.code, w.message));
  for (const FaceChannel& channel : loaded.face_data)
    warnings.append(
        py::make_tuple("attributes_not_kept", path.string() + ": not kept: face data " + channel.name));
  return py::make_tuple(vertex_array(loaded.mesh), face_array(loaded.mesh),
                        attribute_arrays(joined ? joined->gather(loaded.vertex_data) : loaded.vertex_data),
                        name_of(loaded.format), warnings);
}

/// Returns the names of attributes that the format cannot hold.
std::vector<std::string> write_file(const std::filesystem::path& path, const PointArray& vertices,
                                    const FaceArray& faces, const py::dict& attributes,
                                    const std::optional<std::string>& format, bool ascii,
                                    bool keep_junctions) {
  const Mat3X points = points_of(vertices);
  const std::vector<Triangle> triangles = triangles_of(faces);
  const MeshFormat target = format_of(format ? std::filesystem::path("mesh." + *format) : path);
  FormatData data = data_for_format(vertex_data_of(attributes, points.cols()), MeshFormat::ply, target);
  unlocked([&] {
    const ValidMesh mesh =
        make_valid_mesh(points, triangles, path.string(), {.keep_junctions = keep_junctions});
    if (!mesh.origin.joined.empty())
      for (VertexChannel& channel : data.data) {
        std::vector<double> of_sheets;
        of_sheets.reserve(mesh.origin.vertex.size());
        for (const int v : mesh.origin.vertex) of_sheets.push_back(channel.values[v]);
        channel.values = std::move(of_sheets);
      }
    prepare_mesh(path, mesh.mesh, target, ascii ? PlyEncoding::ascii : PlyEncoding::binary_little_endian,
                 {.vertices = data.data})
        .file.commit();
  });
  return data.dropped;
}

/// Raises the exception of the package with this name.
void raise(const char* name, const std::exception& e) {
  PyErr_SetString(py::module_::import("hooke_remesh.errors").attr(name).ptr(), e.what());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const InputError& e) {
    raise("InputError", e);
  } catch (const MeshError& e) {
    raise("MeshError", e);
  } catch (const OutputError& e) {
    raise("OutputError", e);
  } catch (const LimitError& e) {
    raise("LimitError", e);
  } catch (const NumericalError& e) {
    raise("NumericalError", e);
  } catch (const ResultError& e) {
    raise("ResultError", e);
  } catch (const Error& e) {
    raise("UsageError", e);
  }
}

}  // namespace
}  // namespace hooke::python

PYBIND11_MODULE(_core, m) {
  using namespace hooke::python;
  m.attr("__version__") = HOOKE_VERSION;
  py::register_exception_translator(&translate);
  m.def("run", &run_arrays);
  m.def("read", &read_file);
  m.def("write", &write_file);
}
