#include "python_observer.h"

namespace py = pybind11;

namespace hooke::python {

bool PythonObserver::operator()(const Progress& progress) {
  constexpr std::chrono::milliseconds pause{50};
  const auto now = std::chrono::steady_clock::now();
  if (!goes_on_ || now - last_ < pause) return goes_on_;
  const py::gil_scoped_acquire lock;
  watch(progress);
  last_ = std::chrono::steady_clock::now();
  return goes_on_;
}

void PythonObserver::watch(const Progress& progress) {
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress_.is_none()) return;
    const py::object answer = progress_(progress.stage, progress.outer, progress.step, progress.energy);
    goes_on_ = !answer.is(py::bool_(false));
  } catch (py::error_already_set& e) {
    raised_.emplace(std::move(e));
    goes_on_ = false;
  }
}

py::object PythonObserver::exception() const {
  return raised_ ? raised_->value() : py::none();
}

}  // namespace hooke::python
