#include "stages.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "hooke/core/stopwatch.h"
#include "hooke/mesh/junctions.h"
#include "support/errors.h"
#include "support/solids.h"

namespace hooke::app::stages_test {

TEST(RemeshAndMeasure, NamesTheInputWhereSheetsHaveComeApart) {
  TriMesh mesh = test::to_mesh(test::both(test::sphere(2), test::sphere(2)));
  std::vector<int> joined(mesh.n_vertices());
  for (std::size_t v = 0; v < joined.size(); ++v) joined[v] = static_cast<int>(v);
  joined.back() = 0;  // which lies elsewhere
  set_joined_vertices(mesh, joined);
  MemoryOrder memory_order = find_memory_order(mesh);
  Settings settings;
  settings.input = "walls.obj";
  Original original;
  RunRecord record;
  Stopwatch stopwatch;
  measure_input(settings, mesh, memory_order, {}, original, record, stopwatch);
  EXPECT_ERROR(ResultError, "walls.obj: the sheets that meet in vertex 0 have come apart, at ",
               remesh_and_measure(settings, mesh, memory_order, original, record, nullptr, stopwatch));
}

}  // namespace hooke::app::stages_test
