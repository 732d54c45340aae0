// A list of the few ids about a vertex.
#pragma once

#include <boost/container/small_vector.hpp>

namespace hooke {

/// As many as most vertices have take no memory of their own.
using ShortList = boost::container::small_vector<int, 12>;

}  // namespace hooke
