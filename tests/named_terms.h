// Energy terms with a name, as parameters of tests.
#pragma once

#include <ostream>

#include "hooke/energy.h"

namespace hooke::test {

struct NamedTerms {
  const char* name;
  EnergyTerms terms;
};
inline void PrintTo(const NamedTerms& t, std::ostream* out) {
  *out << t.name;
}

}  // namespace hooke::test
