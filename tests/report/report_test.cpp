#include "hooke/report/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/solids.h"

#include "hooke/mesh/adjacency.h"

namespace hooke::report_test {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> names;
  for (const auto& [key, value] : json.items()) names.push_back(key);
  return names;
}

Json quality_of(const test::Triangles& t, const std::vector<double>& targets = {}) {
  return to_json(measure_quality(t.points, test::connect(t), targets));
}

const std::vector<std::string> quality_keys = {"min_angle",          "max_angle",      "shape",
                                               "radius_ratio",       "aspect_ratio",   "edge_ratio",
                                               "edge_length",        "length_error",   "faces_below_20",
                                               "faces_below_30",     "folded_edges",   "self_intersections",
                                               "degenerate_faces",   "valence",        "mean_curvature",
                                               "gaussian_curvature", "polygon_angles", "worst_faces"};

TEST(QualityJson, HasTheKeysOfTheContractInOrder) {
  EXPECT_EQ(keys(quality_of(test::sphere(1))), quality_keys);
  EXPECT_EQ(keys(quality_of(test::sphere(1))["shape"]),
            (std::vector<std::string>{"min", "p01", "p05", "median", "mean", "p95", "max", "std", "histogram",
                                      "non_finite"}));
}

TEST(QualityJson, NumbersComeBackExactly) {
  const test::Triangles t = test::sphere(2, .3);
  const Quality q = measure_quality(t.points, test::connect(t), {});
  const Json json = Json::parse(to_json(q).dump());
  EXPECT_EQ(json["min_angle"]["min"].get<double>(), q.min_angle.min);
  EXPECT_EQ(json["edge_length"]["std"].get<double>(), q.edge_length.std);
  EXPECT_EQ(json["worst_faces"][0]["centre"][2].get<double>(), q.worst_faces[0].centre.z());
  EXPECT_EQ(json["min_angle"]["histogram"]["counts"].get<std::vector<size_t>>(),
            q.min_angle.histogram.counts);
  EXPECT_EQ(json["valence"]["interior"]["5"], 12);
  EXPECT_EQ(json["self_intersections"], 0);
}

TEST(QualityJson, WhatDoesNotExistIsNull) {
  const Json json = quality_of(test::equilateral());
  EXPECT_TRUE(json["length_error"]["min"].is_null());
  EXPECT_TRUE(json["length_error"]["histogram"].is_null());
  EXPECT_TRUE(json["mean_curvature"]["max"].is_null());

  const test::Triangles t = test::cube();
  const Quality unasked = measure_quality(t.points, test::connect(t), {}, {.self_intersections = false});
  EXPECT_TRUE(to_json(unasked)["self_intersections"].is_null());
}

TEST(QualityJson, DegenerateAndEmptyMeshesHaveTheSameKeys) {
  const auto point = test::triangles({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2}});
  const test::Triangles empty{Mat3X(3, 0), {}};
  for (const test::Triangles& t : {point, empty}) {
    const Json json = quality_of(t);
    EXPECT_EQ(keys(json), quality_keys);
    EXPECT_EQ(Json::parse(json.dump()), json);
  }
  EXPECT_EQ(quality_of(point)["radius_ratio"]["non_finite"], 1);
  EXPECT_TRUE(quality_of(point)["radius_ratio"]["max"].is_null());
}

TEST(QualityJson, GeometryTellsDistancesAndChanges) {
  const test::Triangles t = test::cube();
  test::Triangles larger = t;
  larger.points *= 2;
  const Adjacency c = test::connect(t);
  const Json json = to_json(measure_deviation(t.points, c, larger.points, c));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"displacement", "distance_to_input", "distance_from_input",
                                                  "normal_deviation", "area_change", "volume_change",
                                                  "flipped_faces", "overhangs", "boundary_distance"}));
  EXPECT_NEAR(json["distance_to_input"]["max_over_diagonal"].get<double>(), 1, 1e-15);
  EXPECT_EQ(json["volume_change"], 7.);
  EXPECT_TRUE(json["boundary_distance"]["to_input"].is_null());
}

TEST(QualityJson, InfiniteDistancesAreNull) {
  const test::Triangles t = test::cube();
  const Json json =
      to_json(measure_deviation(Mat3X(3, 0), make_adjacency(0, {}), t.points, test::connect(t)));
  EXPECT_TRUE(json["displacement"].is_null());
  EXPECT_TRUE(json["distance_to_input"]["max"].is_null());
  EXPECT_TRUE(json["distance_to_input"]["max_over_diagonal"].is_null());
}

TEST(QualityJson, MeshFacts) {
  const test::Triangles t = test::cube();
  const Adjacency c = test::connect(t);
  const Json json = to_json(measure_topology(c), measure_extent(t.points, c));
  EXPECT_EQ(json["vertices"], 8);
  EXPECT_EQ(json["euler"], 2);
  EXPECT_EQ(json["bbox"]["max"], Json({1., 1., 1.}));
  EXPECT_NEAR(json["volume"].get<double>(), 1, 1e-15);
  const test::Triangles open = test::equilateral();
  EXPECT_TRUE(to_json(measure_topology(test::connect(open)),
                      measure_extent(open.points, test::connect(open)))["volume"]
                  .is_null());
}

}  // namespace hooke::report_test
