"""The results of commands: tables by columns, pages, figures."""

from __future__ import annotations

import html as _html
import itertools
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, overload

from ._arguments import path as path_of

_SHOWN = 10


class Column(Sequence[Any]):
    """Numbers, counts or flags, contiguous in memory: f64, i64 or bool.

    `numpy.asarray(column)`, `pandas.Series(column)` and `column.view` take them without copying. A column is also a
    sequence: it has a length, is indexed and is iterated over.

    Parameters
    ----------
    format : str
        The type, as in `struct`: "d", "q" or "?".
    shape : sequence of int
        The shape, as in numpy.
    bytes : bytearray
        The memory, in C order.

    Attributes
    ----------
    shape : tuple of int
        The shape: (n,), or (n, 2, 2) of a Jacobian.

    Examples
    --------
    >>> column = va.simulate("fig03", impacts=3)["event"]
    >>> column
    <3 counts: 1, 2, 3>
    >>> column[-1], column.tolist(), column.shape
    (3, [1, 2, 3], (3,))
    """

    __slots__ = ("_bytes", "_format", "shape")

    def __init__(self, format: str, shape: Sequence[int], bytes: bytearray) -> None:
        self._format, self._bytes = format, bytes
        self.shape: tuple[int, ...] = tuple(shape)

    @property
    def view(self) -> "memoryview[Any]":
        """The numbers as a `memoryview` of their type and shape, not copied."""
        # a view of nothing cannot be cast to a shape with zeros in it
        flat: Any = memoryview(self._bytes)
        numbers: memoryview[Any] = flat.cast(self._format, self.shape) if self._bytes else flat.cast(self._format)
        return numbers

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        import numpy

        array = numpy.frombuffer(self._bytes, self._format).reshape(self.shape)
        if dtype is not None and array.dtype != dtype:
            if copy is False:
                raise ValueError(f"{array.dtype} cannot become {dtype} without a copy")
            return array.astype(dtype)
        return array.copy() if copy else array

    def tolist(self) -> list[Any]:
        """The numbers as a list; a list of lists where the shape has more dimensions.

        Returns
        -------
        list
            The numbers, copied.

        Examples
        --------
        >>> va.simulate("fig03", impacts=3)["event"].tolist()
        [1, 2, 3]
        """
        return self.view.tolist() if self._bytes else []

    def __len__(self) -> int:
        return self.shape[0]

    @overload
    def __getitem__(self, place: int) -> Any: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Any]: ...
    def __getitem__(self, place: int | slice) -> Any:
        return self.tolist()[place] if len(self.shape) > 1 else self.view[place]

    def __iter__(self) -> Iterator[Any]:
        return iter(self.tolist())

    def __eq__(self, other: object) -> bool:
        return self.tolist() == (other.tolist() if isinstance(other, Column) else other)

    def __repr__(self) -> str:
        kind = {"d": "numbers", "q": "counts", "?": "flags"}[self._format]
        first = ", ".join(map(repr, itertools.islice(self, _SHOWN)))
        return f"<{len(self)} {kind}: {first}{', ...' if len(self) > _SHOWN else ''}>"


class Table(dict[str, Any]):
    """A table: a dict of columns by their names, in order.

    Numbers are a `Column`, with NaN where there is no value; words, lists and numbers of more than 15 digits
    (`decimal.Decimal`) are lists, with None where there is no value. `pandas.DataFrame(table)` takes it as it is.

    Parameters
    ----------
    columns : dict, optional
        The columns.
    rows : int, optional
        The number of rows.
    as_expected : bool, optional
        As the attribute.
    notes : sequence of str, optional
        As the attribute.

    Attributes
    ----------
    rows : int
        The number of rows.
    as_expected : bool
        True where the command would exit with 0.
    notes : list of str
        The messages that the command would write to stderr.

    Examples
    --------
    >>> table = va.simulate("fig03", impacts=3)
    >>> table["side"], table.rows, table.as_expected
    (['bottom', 'top', 'bottom'], 3, True)
    """

    rows: int
    as_expected: bool
    notes: list[str]

    def __init__(self, columns: Any = (), rows: int = 0, as_expected: bool = True, notes: Sequence[str] = ()) -> None:
        super().__init__(columns)
        self.rows, self.as_expected, self.notes = rows, as_expected, list(notes)

    def each(self) -> Iterator[dict[str, Any]]:
        """The rows, one after the other, each a dict of values by the names of the columns.

        Returns
        -------
        iterator of dict
            The rows.

        Examples
        --------
        >>> [row["side"] for row in va.simulate("fig03", impacts=3).each()]
        ['bottom', 'top', 'bottom']
        """
        return (dict(zip(self, row)) for row in zip(*self.values()))

    def to_pandas(self) -> Any:
        """The table as a `pandas.DataFrame`. Numbers are not copied. It needs pandas.

        Returns
        -------
        pandas.DataFrame
            A column for each of the table.

        Examples
        --------
        >>> va.simulate("fig03", impacts=3).to_pandas().shape[0]
        3
        """
        import pandas

        return pandas.DataFrame({name: pandas.Series(column, copy=False) for name, column in self.items()}, copy=False)

    def __repr__(self) -> str:
        rows = [[*map(_shown, row)] for row in itertools.islice(zip(*self.values()), _SHOWN)]
        lines = [list(self), *rows]
        widths = [max(map(len, column)) for column in zip(*lines)]
        text = "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)
        return text if self.rows <= _SHOWN else f"{text}\n... {self.rows} rows"


def _shown(cell: Any) -> str:
    if cell is None:
        return ""
    if isinstance(cell, float):
        return f"{cell:.6g}"
    if isinstance(cell, list):
        return "; ".join(map(_shown, cell))
    text = str(cell)
    return text if len(text) <= 40 else f"{text[:39]}…"


class Report(Table):
    """A table of verdicts, with a page for a reader, which a notebook shows.

    Parameters
    ----------
    html : str, optional
        As the attribute. All else is as for `Table`.
    numbers : Table, optional
        As the attribute.

    Attributes
    ----------
    html : str
        The page: one file that refers to nothing outside itself.
    numbers : Table or None
        The verdicts on the numbers that a document prints; None where it prints none.

    Examples
    --------
    >>> found = va.audit({"equation": [{"label": "a", "role": "claim", "tex": "1 + 1 = 2"}]})
    >>> found["verdict"], found.html[:15], found.numbers
    (['proved'], '<!DOCTYPE html>', None)
    """

    html: str
    numbers: Table | None

    def __init__(self, *arguments: Any, html: str = "", numbers: Table | None = None, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self.html, self.numbers = html, numbers

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file.

        Parameters
        ----------
        path : path
            The file, which is overwritten.

        Raises
        ------
        InputError
            The value is not a path.
        OSError
            The file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> with tempfile.TemporaryDirectory() as directory:
        ...     path = pathlib.Path(directory, "report.html")
        ...     va.audit({"equation": [{"label": "a", "role": "claim", "tex": "1 + 1 = 2"}]}).save(path)
        ...     path.exists()
        True
        """
        Path(path_of(path, "path")).write_text(self.html, encoding="utf-8")

    def _repr_html_(self) -> str:
        # in a frame, so that neither page styles the other
        page = _html.escape(self.html, quote=True)
        return f'<iframe sandbox="allow-scripts" style="width:100%;height:40em;border:0" srcdoc="{page}"></iframe>'


class Figure:
    """A drawing, which a notebook shows.

    Parameters
    ----------
    svg : str
        The drawing as SVG.
    notes : sequence of str, optional
        The messages that the command would write to stderr.

    Attributes
    ----------
    svg, notes
        As given.

    Examples
    --------
    >>> figure = va.plot("fig03", set={"want": ["sweep"], "sweep.points": 5})
    >>> figure.svg.rstrip()[-6:]
    '</svg>'
    """

    def __init__(self, svg: str, notes: Sequence[str] = ()) -> None:
        self.svg, self.notes = svg, list(notes)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the SVG to a file.

        Parameters
        ----------
        path : path
            The file, which is overwritten.

        Raises
        ------
        InputError
            The value is not a path.
        OSError
            The file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> with tempfile.TemporaryDirectory() as directory:
        ...     path = pathlib.Path(directory, "figure.svg")
        ...     va.plot("fig03", set={"want": ["sweep"], "sweep.points": 5}).save(path)
        ...     path.exists()
        True
        """
        Path(path_of(path, "path")).write_text(self.svg, encoding="utf-8")

    def __repr__(self) -> str:
        return f"<figure: SVG of {len(self.svg)} characters>"

    def _repr_svg_(self) -> str:
        return self.svg
