// Results of meshes that planes mirror onto themselves, which are to stay so where faces do.
#pragma once

#include <vector>

namespace hooke {

class AttemptMaker;
struct Attempt;
struct ConstraintOptions;

/// In mode `fixed`, gives one side of a mesh that mirrors map onto itself the mirrored places of the other,
/// the one with the greater least angle, if all is kept as before and the faces are hardly worse. Not where
/// lengths (`asked`: by vertex of the input in memory order) or what stays are asked for on one side only.
void keep_mirrors(const AttemptMaker& maker, const std::vector<double>& asked,
                  const ConstraintOptions& constraints, Attempt& best);

}  // namespace hooke
