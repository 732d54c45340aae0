// Energy terms with a name, as parameters of tests.
#pragma once

#include <ostream>

#include "hooke/springs/energy.h"

namespace hooke::test {

struct NamedTerms {
  const char* name;
  EnergyTerms terms;
};
inline void PrintTo(const NamedTerms& t, std::ostream* out) {
  *out << t.name;
}

inline EnergyTerms only_strings() {
  EnergyTerms t;
  t.altitude = 0;
  return t;
}
inline EnergyTerms only_angles() {
  EnergyTerms t;
  t.altitude = 0;
  t.angle = 30;
  t.angle_threshold = .7;
  return t;
}

}  // namespace hooke::test
