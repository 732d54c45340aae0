#include "hooke/connectivity/edge_queue.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "support/meshes.h"

#include "hooke/mesh/halfedge_mesh.h"

namespace hooke::edge_queue_test {

constexpr int cells = 12;

HalfedgeMesh grid() {
  const test::Triangles t = test::grid(cells, test::flat);
  return HalfedgeMesh(make_adjacency(static_cast<int>(t.points.cols()), t.faces));
}

/// Of an edge, by either of its half-edges: a number between -.2 and .8 without a pattern.
double urgency(const HalfedgeMesh& t, int h) {
  const int a = std::min(t.from(h), t.to(h)), b = std::max(t.from(h), t.to(h));
  return static_cast<double>((a * 7919 + b * 104729) % 1009) / 1009 - .2;
}

std::set<int> vertices_about(const HalfedgeMesh& t, int h) {
  std::set<int> about;
  for (int end : {t.from(h), t.to(h)}) {
    about.insert(end);
    for (int v : t.neighbours(end)) about.insert(v);
  }
  return about;
}

bool meet(const std::set<int>& a, const std::set<int>& b) {
  return std::ranges::any_of(a, [&](int v) { return b.contains(v); });
}

constexpr auto any = [](int) { return true; };

/// All edges with their batch, in the order in which they come.
std::vector<std::pair<int, int>> batches_of(const HalfedgeMesh& t, size_t max_count) {
  EdgeQueue queue(t, [&](int h) { return urgency(t, h); });
  std::vector<std::pair<int, int>> edges;
  int batch = 0;
  for (std::vector<int> apart; !(apart = queue.pop_apart(max_count, any)).empty(); ++batch)
    for (int h : apart) edges.push_back({h, batch});
  return edges;
}

TEST(EdgeQueue, ComesOutByUrgencyWithoutThoseThatAreNotUrgent) {
  const HalfedgeMesh t = grid();
  EdgeQueue queue(t, [&](int h) { return urgency(t, h); });
  double last = 1;
  int count = 0, urgent = 0;
  for (int h = queue.pop(); h >= 0; h = queue.pop(), ++count) {
    EXPECT_LE(urgency(t, h), last);
    last = urgency(t, h);
  }
  EXPECT_GT(last, 0);
  for (int h = 0; h < t.half_edge_count(); ++h) urgent += t.twin(h) < h && urgency(t, h) > 0;
  EXPECT_EQ(count, urgent);
}

TEST(EdgeQueue, BatchesHaveEveryUrgentEdgeOnce) {
  const HalfedgeMesh t = grid();
  std::set<int> urgent, found;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.twin(h) < h && urgency(t, h) > 0) urgent.insert(h);
  for (const auto& [h, batch] : batches_of(t, 50)) EXPECT_TRUE(found.insert(h).second) << h;
  EXPECT_EQ(found, urgent);
}

TEST(EdgeQueue, EdgesOfABatchHaveNoNeighbourInCommon) {
  const HalfedgeMesh t = grid();
  std::map<int, std::vector<std::set<int>>> about;  // by batch
  for (const auto& [h, batch] : batches_of(t, 50)) {
    const std::set<int> vertices = vertices_about(t, h);
    for (const std::set<int>& others : about[batch]) EXPECT_FALSE(meet(vertices, others)) << h;
    about[batch].push_back(vertices);
  }
  EXPECT_GT(about.size(), 1u);
  EXPECT_GT(about[0].size(), 1u);
}

TEST(EdgeQueue, AnEdgeNeverComesBeforeAMoreUrgentOneThatItMeets) {
  const HalfedgeMesh t = grid();
  const auto edges = batches_of(t, 50);
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t j = i + 1; j < edges.size(); ++j)
      if (meet(vertices_about(t, edges[i].first), vertices_about(t, edges[j].first))) {
        EXPECT_GE(urgency(t, edges[i].first), urgency(t, edges[j].first));
      }
}

TEST(EdgeQueue, ABatchOfOneIsTheNextEdge) {
  const HalfedgeMesh t = grid();
  EdgeQueue queue(t, [&](int h) { return urgency(t, h); });
  for (const auto& [h, batch] : batches_of(t, 1)) EXPECT_EQ(h, queue.pop());
  EXPECT_EQ(queue.pop(), -1);
}

TEST(EdgeQueue, AlwaysGivesTheMostUrgentOfManyThatChange) {
  const test::Triangles large = test::grid(60, test::flat);  // more edges than are sorted at a time
  const HalfedgeMesh t(make_adjacency(static_cast<int>(large.points.cols()), large.faces));
  std::map<int, double> urgencies;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any_urgency(-.3, 1);
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.twin(h) < h) urgencies[h] = any_urgency(random);
  const auto of_edge = [&](int h) -> double& { return urgencies.at(std::max(h, t.twin(h))); };
  EdgeQueue queue(t, of_edge);
  const auto greatest = [&] {
    return std::ranges::max_element(urgencies, {}, &std::pair<const int, double>::second);
  };
  std::uniform_int_distribution<int> any_edge(0, t.half_edge_count() - 1);
  for (int step = 0; step < 3000; ++step) {
    const auto next = greatest();
    ASSERT_EQ(queue.pop(), next->first) << step;
    next->second = 0;
    for (int change = 0; change < 3; ++change) {
      const int h = any_edge(random);
      of_edge(h) = any_urgency(random);
      queue.push(h);
    }
  }
}

/// What is left in the queue after changes: each of these edges once, the most urgent first.
void expect_all_of(const HalfedgeMesh& t, EdgeQueue& queue, const std::set<int>& wanted) {
  const auto name = [&](int h) { return std::max(h, t.twin(h)); };
  std::set<int> found;
  double last = 1;
  for (int h = queue.pop(); h >= 0; h = queue.pop()) {
    EXPECT_LE(urgency(t, h), last);
    last = urgency(t, h);
    EXPECT_TRUE(found.insert(name(h)).second) << h;
  }
  EXPECT_EQ(found, wanted);
}

std::set<int> urgent_edges(const HalfedgeMesh& t) {
  std::set<int> urgent;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (!t.is_removed(h / 3) && t.twin(h) < h && urgency(t, h) > 0) urgent.insert(h);
  return urgent;
}

TEST(EdgeQueue, LosesNoEdgeWhereOthersAreSplit) {
  const test::Triangles large = test::grid(40, test::flat);  // more edges than are sorted at a time
  HalfedgeMesh t(make_adjacency(static_cast<int>(large.points.cols()), large.faces));
  EdgeQueue queue(t, [&](int h) { return urgency(t, h); });
  for (int k = 0; k < 300; ++k) queue.push_around(t.split(queue.pop()));
  expect_all_of(t, queue, urgent_edges(t));
}

TEST(EdgeQueue, LosesNoEdgeWhereOthersCollapse) {
  const test::Triangles large = test::grid(40, test::flat);
  HalfedgeMesh t(make_adjacency(static_cast<int>(large.points.cols()), large.faces));
  EdgeQueue queue(t, [&](int h) { return urgency(t, h); });
  std::vector<int> refused;
  for (int k = 0; k < 300; ++k) {
    const int h = queue.pop(), stays = t.from(h);
    if (!t.may_collapse(h) || t.on_boundary(stays) || t.on_boundary(t.to(h))) {
      refused.push_back(h);
      continue;
    }
    t.collapse(h, stays);
    queue.push_around(stays);
  }
  for (int h : refused)
    if (!t.is_removed(h / 3)) queue.push(h);
  expect_all_of(t, queue, urgent_edges(t));
}

TEST(EdgeQueue, DropsWhatIsNotWanted) {
  const HalfedgeMesh t = grid();
  EdgeQueue queue(t, [&](int h) { return urgency(t, h); });
  const auto inside = [&](int h) { return !t.on_boundary(t.from(h)) && !t.on_boundary(t.to(h)); };
  int count = 0, wanted = 0;
  for (std::vector<int> apart; !(apart = queue.pop_apart(50, inside)).empty();)
    for (int h : apart) count += inside(h);
  for (int h = 0; h < t.half_edge_count(); ++h) wanted += t.twin(h) < h && urgency(t, h) > 0 && inside(h);
  EXPECT_EQ(count, wanted);
  EXPECT_EQ(queue.pop(), -1);
}

}  // namespace hooke::edge_queue_test
