"""The exceptions of hooke_remesh, and its warning. Messages are one line: the problem; what was expected; what to do."""

__all__ = ["Error", "UsageError", "InputError", "MeshError", "OutputError", "LimitError", "NumericalError",
           "ResultError", "Interrupted", "MeshWarning"]


class Error(Exception):
    """Base of all exceptions that a mesh or an option causes."""


class UsageError(Error, ValueError):
    """An option is unknown, has no such value, or has no effect with the others. The command's exit code 2."""


class InputError(Error):
    """A file is missing, unreadable or malformed. The message begins with FILE or FILE:LINE. Exit code 3."""


class MeshError(Error, ValueError):
    """The mesh is not supported: no oriented manifold with area. Exit code 4."""


class OutputError(Error):
    """A file could not be written; an older file of that name is as it was. Exit code 5."""


class NumericalError(Error):
    """The computation broke down, and there is no valid result. Exit code 7."""


class LimitError(Error, MemoryError):
    """The computation needs more memory than there is. Exit code 8."""


class ResultError(Error):
    """The result would not keep what it must keep of the input: surface, creases, topology, no new folds and
    self-intersections. `accept_invalid=True` gives it nevertheless. Exit code 9."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a run. `result` is the best mesh so far, a `Result` whose report has the status "interrupted"."""

    def __init__(self, result):
        super().__init__("interrupted; the exception's `result` is the best mesh so far")
        self.result = result


class MeshWarning(UserWarning):
    """What the command warns of: each of a report's warnings, and attributes that a file cannot hold."""
