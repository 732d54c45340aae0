// What is thrown. Broken input and I/O throw; not converging is a result.
#pragma once

#include <stdexcept>
#include <string>

namespace hooke {

/// Base of all our exceptions. The message is one line: what; what was expected; what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is missing, unreadable or malformed. The message begins with FILE or FILE:LINE.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The input was read, but is not a mesh we can work on (non-manifold, mixed orientation, no area ...).
class MeshError : public Error {
 public:
  using Error::Error;
};

/// An output could not be written; whatever stood there before is untouched.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// A memory or time limit forbids the work; the message says how much would be needed.
class LimitError : public Error {
 public:
  using Error::Error;
};

/// The computation broke down (a singular system, a non-finite value) and no valid result exists.
class NumericalError : public Error {
 public:
  using Error::Error;
};

}  // namespace hooke
