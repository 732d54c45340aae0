// The radial function of thin-plate splines, four values at a time.
#pragma once

#include <limits>

#include "hooke/core/fast_log.h"
#include "hooke/filter/thin_plate_spline.h"

namespace hooke {

/// The kernel [27] and its derivative over r, at r2 = r^2.
struct KernelSample {
  Lanes value, slope_over_r;
};

HOOKE_INLINE void sample_kernel(Kernel kernel, const Lanes& r2, KernelSample& sample) {
  if (kernel == Kernel::r2logr) {
    constexpr double smallest = std::numeric_limits<double>::min();  // r^2 log r is 0 at r = 0
    Lanes log_r2 = r2 > smallest ? r2 : Lanes{} + smallest;
    take_log(log_r2);
    sample.value = .5 * r2 * log_r2;
    sample.slope_over_r = log_r2 + 1.;
  } else {
    Lanes r = r2;
    take_sqrt(r);
    sample.value = r2 * r;
    sample.slope_over_r = 3. * r;
  }
}

}  // namespace hooke
