#include "result_files.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/mesh/curvature.h"
#include "support/solids.h"

namespace hooke::app::result_files_test {

const std::vector<double>& values_of(const VertexData& data, const char* name) {
  return find_channel(data, name)->values;
}

TEST(Fields, TellHowFarVerticesMovedAndHowGoodEdgesAndFacesAre) {
  const test::Triangles t = test::equilateral();  // of side 1
  const Adjacency c = test::connect(t);
  Mat3X start = t.points;
  start.col(1) += Vec3(0, 0, .25);
  const Fields fields = measure_fields(t.points, c, UniformVector(3, .8), {.1, .2, .3}, &start);
  EXPECT_EQ(values_of(fields.vertices, "displacement"), (std::vector{0., .25, 0.}));
  EXPECT_EQ(values_of(fields.vertices, "distance"), (std::vector{.1, .2, .3}));
  for (double error : values_of(fields.vertices, "length_error")) EXPECT_NEAR(error, .25, 1e-12);
  EXPECT_NEAR(values_of(fields.faces, "min_angle")[0], 60, 1e-9);
  for (double k : values_of(fields.vertices, "mean_curvature")) EXPECT_TRUE(std::isnan(k));
}

TEST(Fields, LeaveOutTheDisplacementWhereVerticesDoNotCorrespond) {
  const test::Triangles t = test::sphere(1, .3);
  const Adjacency c = test::connect(t);
  const Fields fields = measure_fields(t.points, c, UniformVector(c.edges.size(), .5),
                                       std::vector<double>(c.vertex_count), nullptr);
  EXPECT_EQ(find_channel(fields.vertices, "displacement"), nullptr);
  EXPECT_EQ(values_of(fields.vertices, "gaussian_curvature"), measure_curvature(t.points, c).gaussian);
  for (const VertexChannel& channel : fields.vertices)
    EXPECT_EQ(channel.values.size(), c.vertex_count) << channel.name;
}

}  // namespace hooke::app::result_files_test
