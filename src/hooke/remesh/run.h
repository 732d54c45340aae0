// One run of remesh(), which can go on from its result where lengths become shorter.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hooke/core/stopwatch.h"
#include "hooke/remesh/result.h"
#include "hooke/springs/placed_lengths.h"

namespace hooke {

struct RunOptions;
struct Workspace;

/// Keeps the workspace with the surface of the input and the present mesh. The observer must outlive it.
class Run {
 public:
  /// `shorter`: target lengths within the faces of the mesh. Throws as remesh() does.
  Run(const TriMesh& mesh, MemoryOrder memory_order, const RunOptions& options, const Observer& observer,
      Stopwatch* stopwatch, const std::vector<PlacedLength>& shorter = {});
  ~Run();

  /// Replaces the mesh, that which the run was made for, by the result. To be called once.
  RemeshResult remesh(TriMesh& mesh);

  /// The points of the present result, by its ids. `input`: the mesh that the run was made for.
  Mat3X points(const TriMesh& input) const;

  /// In mode `adapt`, after a result: replaces `mesh`, again that which the run was made for, by one in which
  /// only what is near shorter target lengths is made anew. The rest stays, in the places in which it is now:
  /// `placed` are vertices that have moved since, by ids of the result `before`, to these points. `lengths`:
  /// of the vertices of the input in its memory order, and `shorter` ones within its faces. None if there are
  /// junctions or a minimum length, or if that would be most of the mesh or nothing of it; the run is of no
  /// use then.
  std::optional<RemeshResult> go_on(TriMesh& mesh, const RemeshResult& before, const std::vector<int>& placed,
                                    const Mat3X& points, const std::vector<double>& lengths,
                                    const std::vector<PlacedLength>& shorter = {});

  /// How many results it has made, or started to.
  int results() const { return results_; }

  /// The share of the vertices that could move for the last one.
  double share_of_last() const { return share_of_last_; }

 private:
  RemeshResult change(TriMesh& mesh);

  const std::unique_ptr<const RunOptions> options_;
  const Observer& observer_;
  std::unique_ptr<Workspace> work_;
  int results_ = 0;
  double share_of_last_ = 1;
};

}  // namespace hooke
