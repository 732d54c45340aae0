// The exceptions of the library. Bad input and failed I/O throw; an optimization that does not converge is a
// result and throws nothing.
#pragma once

#include <stdexcept>
#include <string>

namespace hooke {

/// Base class of all exceptions of the library. The message is one line: the problem; what was expected; what
/// to do about it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is missing, unreadable or malformed. The message begins with FILE or FILE:LINE.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The input was read, but its mesh is not supported: non-manifold, inconsistently oriented, without area.
class MeshError : public Error {
 public:
  using Error::Error;
};

/// An output could not be written; an existing file of that name is unchanged.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// The computation exceeds a memory or time limit; the message says how much would be needed.
class LimitError : public Error {
 public:
  using Error::Error;
};

/// The computation broke down (a singular system, a non-finite value) and no valid result exists.
class NumericalError : public Error {
 public:
  using Error::Error;
};

/// The result does not keep what it must keep of the input.
class ResultError : public Error {
 public:
  using Error::Error;
};

}  // namespace hooke
