// What may change of a mesh's connectivity, and what was changed.
#pragma once

namespace hooke {

enum class ConnectivityMode {
  fixed,  // the faces stay
  flip,   // edges are flipped
  adapt,  // edges are also split and collapsed: new vertices and faces
};

/// What mode `flip` did, which also follows mode `adapt`.
struct FlipResult {
  int folded_before = 0;  // faces that were folded against the surface
  int flow_rounds = 0;    // of Lloyd flow
  int spring_rounds = 0;
  long long flips = 0;  // total
  int passes = 0;
  int evaluations = 0;                    // of the spring energy
  double max_travel = 0, rms_travel = 0;  // from input to result, in target lengths
  bool interrupted = false;
};

/// What mode `adapt` did.
struct AdaptResult {
  int folded_before = 0;  // faces that were folded against the surface
  int levels = 0;         // coarser meshes, i.e. number of 1-to-4 subdivisions
  int rounds = 0;
  int count_rounds = 0;
  long long splits = 0, collapses = 0, flips = 0;
  double target_faces = 0;
  bool interrupted = false;
};

}  // namespace hooke
