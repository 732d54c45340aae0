// Remeshes so that the result keeps the input: measures it against the input and, where it does not keep what
// it must, mends it or remeshes anew.
#pragma once

#include "hooke/core/lists.h"
#include "hooke/core/stopwatch.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/preservation.h"
#include "hooke/measure/quality.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"

namespace hooke {

/// The measures of a result and of its relation to the input, see apply_creases().
struct ResultMeasures {
  Quality input_quality;
  Quality quality;
  Deviation deviation;
  Preservation preservation;
  PreservationOptions judged_by;  // the options of that, completed by what the input is
};

/// What is known of the input, so that it is not measured again.
struct KnownInput {
  const Quality* quality = nullptr;
  std::vector<int> tree_order = {};  // of the tree of its faces in memory order
  /// Whose angles must not get worse, by vertex ids; only with fixed faces, which are their triangles.
  const IntLists* polygons = nullptr;
};

/// Like remesh(), and measures the result. If it does not keep what it must keep of the input (see
/// measure/preservation.h), moves vertices where something is wrong, see mend(). Where that does not do or
/// makes small angles, remeshes anew, with the lost vertices held. In the modes `fixed` and `flip`, where
/// little is wrong or mending makes small angles, what surrounds it stays as it is in the input in further
/// runs, or goes back to that in mode `fixed`. If that does not do, all is remeshed on the faces of the
/// input, unless so much is wrong in a large mesh that this is of no use; after that again with what
/// surrounds the rest, and in mode `flip` with all faces of the input. Where one length is asked for all
/// edges and faces get worse on average, or nothing keeps the input, or many angles are small still, all is
/// tried with the lengths of the input, see RemeshResult::has_lengths_of_input; at last all vertices go back.
/// New slivers do so before that, see take_back_slivers(). In mode `adapt` each of several shells at which
/// something is wrong is remeshed by itself, those that cross together, and stays as it is in the input where
/// nothing else does; the other shells stay as they are in the first run. Only where something is wrong,
/// target lengths get shorter about it, see RemeshResult::shortened, and where that does not do, or first
/// where next to nothing is wrong, the faces of the input stay, unless that were all of the surface. Where
/// the facets of the input are meant and smooth parts bend too much within an edge of a first result that
/// keeps all, see ShorterLengths::resolving_bends(), lengths that ask for at most three times the faces are
/// tried too, and kept where they bring it closer. Of a result that is made anew it keeps one with fewer
/// flaws or, with as many, with a larger minimum angle; in mode `adapt` the result may still not keep all:
/// see RemeshResult::measures. Of interrupted runs only the first, and the first with the lengths of the
/// input, are kept. The surface of a binary mask, see is_staircase(), is smoothed first, so that its steps
/// are no creases, unless creases are kept whatever the noise; the measures are of the input as it was. With
/// PreservationOptions::has_float_points each result is rounded before it is judged.
RemeshResult preserving_remesh(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                               const PreservationOptions& preservation = {}, const KnownInput& known = {},
                               const Observer& observer = nullptr, Stopwatch* stopwatch = nullptr);

}  // namespace hooke
