"""The exception for input that cannot be used, and how it shows values."""

from __future__ import annotations

import reprlib
from collections.abc import Iterator
from contextlib import contextmanager


class InputError(ValueError):
    """Input that cannot be used. The message says what is wrong, where, and what is allowed.

    Parameters
    ----------
    message : str
        The message.
    path : str, optional
        The file at fault, or the name of the argument that holds the text or the dict at fault.
    line, column : int, optional
        The place in it, counted from 1. Of a dict it is the place in the text that `to_toml` returns.

    Attributes
    ----------
    message, path, line, column
        As given; each but the message is None where it is not known.

    Examples
    --------
    >>> try:
    ...     va.orbits("[motion]\\nd = 0.4\\nzeta = 1\\n")
    ... except va.InputError as error:
    ...     error.path, error.line, error.column
    ('scene', 3, 1)
    """

    def __init__(
        self,
        message: str,
        path: str | None = None,
        line: int | None = None,
        column: int | None = None,
    ) -> None:
        super().__init__(message, path, line, column)
        self.message, self.path, self.line, self.column = message, path, line, column

    def __str__(self) -> str:
        return self.message


_MOST_SHOWN = 40

_shortened = reprlib.Repr()
_shortened.maxstring = _shortened.maxother = _shortened.maxlong = _MOST_SHOWN
_shortened.maxlevel = 3


def shown(value: object) -> str:
    """Returns a value for a message: one line, short, whatever the value is."""
    try:
        text = " ".join(_shortened.repr(value).split())
    except Exception:  # an integer of more than 4300 digits, or a `__repr__` of the user's that fails
        is_integer = isinstance(value, int)
        text = "an integer of thousands of digits" if is_integer else f"a value of the type {type(value).__name__}"
    return text if len(text) <= 2 * _MOST_SHOWN else f"{text[: 2 * _MOST_SHOWN]}..."


def check_text(text: str, name: str) -> str:
    """Returns the text if it consists of characters.

    Raises
    ------
    InputError
        The text contains a lone surrogate, which no encoding can hold.
    """
    try:
        text.encode()
    except UnicodeEncodeError as error:
        half = ascii(text[error.start])
        message = f"{name} contains {half} at index {error.start}: a lone surrogate, which is not a character"
        raise InputError(message) from None
    return text


@contextmanager
def as_input_errors(name: str) -> Iterator[None]:
    """Raises an `InputError` where the interpreter gives up on an input that is too large, too deep, or no text."""
    try:
        yield
    except RecursionError as error:
        raise InputError(f"{name} is nested too deeply, or contains itself", name) from error
    except (MemoryError, OverflowError) as error:
        raise InputError(f"{name} needs more memory than is available; pass fewer items", name) from error
    except UnicodeError as error:
        raise InputError(f"{name} contains characters that cannot be encoded: {error}", name) from error
