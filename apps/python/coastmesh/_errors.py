"""What coastmesh raises, and warns of."""
import contextlib

from . import _coastmesh


class Error(Exception):
    """Whatever coastmesh raises, but for KeyboardInterrupt and MemoryError."""


class OptionError(Error, ValueError):
    """An option's value is outside its range, or of the wrong kind."""


class InputError(Error, ValueError):
    """The input cannot be read or meshed.

    Attributes:
        refusals: a dict for each part that could not be meshed, with "source", "fids" (numbers of the features),
            "reason", and "place": (x, y) in the input's CRS, or None.
    """

    def __init__(self, message, refusals=()):
        super().__init__(message)
        self.refusals = list(refusals)


class OutputError(Error, OSError):
    """A file cannot be written; none was left in part."""


class CoastmeshWarning(UserWarning):
    """An option without effect, or something about the input that was mended, left out or cannot be had."""


for _kind in (Error, InputError, OptionError, OutputError, CoastmeshWarning):
    _kind.__module__ = "coastmesh"  # as users know it


@contextlib.contextmanager
def own_errors():
    try:
        yield
    except _coastmesh.UsageError as error:
        raise OptionError(str(error).replace("--mark-pieces", "mark_pieces=True")) from None
    except _coastmesh.InputError as error:
        raise InputError(str(error)) from None
    except _coastmesh.OutputError as error:
        raise OutputError(str(error).replace("--overwrite", "overwrite=True")) from None
