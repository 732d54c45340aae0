// Watches a run for Python: signals, and a function that is told of its progress.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <string>

#include "hooke/integrator/relaxation.h"

namespace hooke::python {

/// An observer for a run without Python's lock, which it takes at most twenty times a second. Then it lets
/// Python handle signals, Ctrl-C among them, and calls the function with the stage, the outer iteration, the
/// step and the energy. The run stops if either raises an exception, which is kept, or if the function
/// returns False. To be destroyed with the lock.
class PythonObserver {
 public:
  /// `progress`: a function, or None.
  explicit PythonObserver(pybind11::object progress) : progress_(std::move(progress)) {}

  bool operator()(const Progress& progress);

  /// The exception that stopped the run; None if there was none.
  pybind11::object exception() const;

 private:
  void watch(const Progress& progress);

  pybind11::object progress_;
  std::optional<pybind11::error_already_set> raised_;
  bool goes_on_ = true;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace hooke::python
