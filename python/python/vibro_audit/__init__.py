"""Tells whether what a paper prints is right: formulas proved or refuted, numbers held against certified ones.

Scenes and sheets are a path, a dict, or TOML text (a string with a line break); a string that is the name of a built-in
scene, such as "fig02", is that scene. Everything is without unit unless said otherwise: lengths and times are those of
the model, in which the forcing period is 2; phases are in rad. `vibro-audit --columns COMMAND` describes every column.

Long work leaves the interpreter's lock to others and ends at Ctrl-C. What cannot be used is an `InputError`.
"""

from __future__ import annotations

import array as _array
import csv as _csv
import io as _io
import math as _math
import operator as _operator
import os as _os
from builtins import map as _each
from collections.abc import Iterable as _Iterable
from collections.abc import Mapping as _Mapping
from typing import Any, NamedTuple

from . import _native
from ._errors import InputError
from ._native import __version__
from ._table import Column, Figure, Report, Table
from ._toml import to_toml
from ._toml import to_value as _to_value

__all__ = [
    "Column",
    "Figure",
    "InputError",
    "NextImpact",
    "Report",
    "Table",
    "audit",
    "basins",
    "branch",
    "check",
    "explain",
    "map",
    "next_impact",
    "optimise",
    "orbits",
    "plot",
    "problems",
    "score",
    "simulate",
    "sweep",
    "to_toml",
]

Path = str | _os.PathLike[str]
Given = Path | _Mapping[str, Any]


def audit(sheet: Given | None = None, *, effort: int = 1, repair: bool = False, baseline: Path | None = None) -> Report:
    """A verdict for each formula of a sheet, or of a document (`.tex`, `.md`); without, of the paper's appendix.

    `effort` multiplies the limit of the search, `repair` looks for the smallest edits that make a refuted formula true,
    findings of `baseline` (a file that the command wrote) do not fail.

    A row per formula. `verdict` is "proved", "refuted", "undecided" or "unread"; `counterexample_values` has exact values
    by symbol; `as_expected` tells whether all verdicts are those that the sheet expects. In a notebook the result is a
    page.
    """
    options = {"effort": effort, "repair": repair, "baseline": _path(baseline, "baseline")}
    return _report("audit", options, _input(sheet, "sheet") if sheet is not None else None)


def explain(sheet: Given | None, label: str, *, effort: int = 1) -> str:
    """The proof or the counterexample of one formula in words; `sheet` None is the paper's appendix."""
    if not isinstance(label, str):
        raise InputError(f"label is {label!r:.40}; a text is needed")
    given = _input(sheet, "sheet") if sheet is not None else None
    return _text("audit", {"explain": label, "effort": effort}, given)[0]


def check(directory: Path | None = None) -> Report:
    """Golden values of a directory of CSV against what is computed; without, those of the paper.

    A row per value. `verdict` is "reproduced", "truncated", "off-by-one", "rounded", "wrong",
    "undetermined" or "undecided".
    """
    named = _path(directory, "directory")
    return _report("check", {}, None if named is None else ([named], None))


def orbits(
    scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False, digits: int | None = None
) -> Table:
    """Every periodic motion of the words that the scene names, each proved.

    `set` overrides keys, as in {"motion.d": 0.3}; `strict` refuses keys that nothing requires; `digits` beyond 15 give
    `decimal.Decimal`.

    A row per motion. `phases` (rad, in [0, 2 pi)), `velocities` (just before impact, positive at the bottom, negative at
    the top) and `times` (the flight that follows) are lists in word order. `error_bound` bounds the error of each number
    of the row; `complete` is True where it is proved that there is no other motion.
    """
    return _table("orbits", {"set": set, "strict": strict, "digits": digits}, _input(scene, "scene"))


def branch(
    scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False, digits: int | None = None
) -> Table:
    """The periodic motions followed over the scene's sweep, and every bifurcation located.

    A row per motion and value (`kind` "point"), and per bifurcation ("fold", "period-doubling", "symmetry-breaking",
    "node-focus", "grazing"), in the order of the sweep. Columns as in `orbits`. Of a scene with `[branch]`: the curves of
    bifurcations over its two parameters, a row per step and special point.
    """
    return _table("branch", {"set": set, "strict": strict, "digits": digits}, _input(scene, "scene"))


def simulate(
    scene: Given,
    *,
    impacts: int | None = None,
    until: float | None = None,
    last: int | None = None,
    proved: bool = False,
    set: _Mapping[str, Any] | None = None,
    strict: bool = False,
    digits: int | None = None,
) -> Table:
    """Impacts, rest and release from the scene's start on: at most `impacts` (100 where nothing limits them), `until` a
    time (the forcing period is 2), of which the `last` so many; under `proved` with a bound of each error.

    A row per event: `time`, `phase` (rad), `velocity` just before, `side` "bottom" or "top", `kind` "impact", "rest",
    "release" or "undecided", and the `digits` that still hold.
    """
    options = {"impacts": impacts, "until": until, "last": last, "proved": proved}
    return _table(
        "simulate", {**options, "set": set, "strict": strict, "digits": digits}, _input(scene, "scene")
    )


def sweep(
    scene: Given, *, summary: bool = False, set: _Mapping[str, Any] | None = None, strict: bool = False
) -> Table:
    """The bifurcation diagram of the scene's sweep: the last impacts at each value, and their voltage (V) where the scene
    has a membrane. With `summary` a row per value: `word`, `periods`, mean voltage (V) and Lyapunov exponent (per unit of
    time), each with a standard error.
    """
    return _table("sweep", {"summary": summary, "set": set, "strict": strict}, _input(scene, "scene"))


def map(scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False) -> Table:
    """What each point of the scene's `[map]` of two parameters comes to, from each start.

    A row per point and start, along x first: `x`, `y`, `start` (its number, from 0), `word`, `periods`, mean voltage (V),
    voltage per forcing period (V) and Lyapunov exponent (per unit of time), each with a standard error.
    """
    return _table("map", {"set": set, "strict": strict}, _input(scene, "scene"))


def basins(
    scene: Given, *, attractors: bool = False, set: _Mapping[str, Any] | None = None, strict: bool = False
) -> Table:
    """Which attractor each start of the scene's `[basins]` comes to: a row per start, phases first, with `phase` (rad),
    `velocity` and `attractor` (its number, from 1; None where an undecided contact ends the motion).

    With `attractors` a row per attractor: its number, `word`, `periods`, the `fraction` of the starts with a standard
    error, the voltage per forcing period (V), and the phases and velocities of its impacts with `error_bound` where the
    orbit is proved.
    """
    return _table(
        "basins", {"attractors": attractors, "set": set, "strict": strict}, _input(scene, "scene")
    )


def optimise(
    scene: Given,
    *,
    gap: float | None = None,
    effort: int | None = None,
    set: _Mapping[str, Any] | None = None,
    strict: bool = False,
) -> Table:
    """The device of the scene's `[box]` whose stable and admissible 1-1 motion gives the largest voltage, proved.

    A row for the voltage per forcing period (V), then one per parameter: `quantity`, `low`, `high` (the optimum is
    between them), `value` (of the device found), `attained`, `active`, `sensitivity` (V per unit of the parameter). No rows
    where no device of the box has such a motion. `gap` is the part of `high` by which `low` may be below it.
    """
    return _table("optimise", {"gap": gap, "effort": effort, "set": set, "strict": strict}, _input(scene, "scene"))


def plot(scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False) -> Figure:
    """What the scene wants as a drawing (SVG): `branch`, `sweep`, `voltage`, `trajectory`, `map`, `basins`."""
    svg, notes = _text("plot", {"set": set, "strict": strict}, _input(scene, "scene"))
    return Figure(svg, notes)


def problems(
    *, kind: str | _Iterable[str] = (), level: str | _Iterable[str] = (), answers: bool = True
) -> Table:
    """Certified problems for a solver of one's own, with `answers` to 30 digits or without.

    `kind` is among "orbit", "impact", "run", "jacobian", "voltage", `level` among "easy", "hard", "extreme". A row per
    quantity asked; numbers are `decimal.Decimal`, exactly as posed. `vibro-audit problems --help` says what is asked.
    """
    return _table("problems", {"kind": kind, "level": level, "without-answers": not answers}, None)


def score(
    answers: Path | _Mapping[str, _Iterable[Any]] | None = None,
    *,
    exec: str | None = None,
    tolerances: _Iterable[float] | None = None,
    limit: float | None = None,
    kind: str | _Iterable[str] = (),
    level: str | _Iterable[str] = (),
    summary: bool = False,
) -> Report:
    """Rates answers to `problems` by the digits that agree with the certified ones.

    `answers` is a CSV file or a dict (or DataFrame) of columns of one length: "problem", "quantity", "answer" and, if you
    like, "seconds". Or `exec` is a command, run at each of the `tolerances`, each for at most `limit` seconds.

    A row per quantity, with `summary` per kind and level (per tolerance, with `exec`).
    """
    steps = None if tolerances is None else ",".join(str(step) for step in tolerances)
    options = {"exec": exec, "tolerances": steps, "limit": limit, "kind": kind, "level": level, "summary": summary}
    if answers is None and exec is None:
        raise InputError("answers is None; give a CSV file, a dict of columns, or exec='command'")
    return _report("score", options, None if answers is None else _answers(answers))


class NextImpact(NamedTuple):
    """Where flights end: arrays of length n."""

    sides: list[str | None]
    """(n,) "bottom" or "top"; None where there is no next impact."""
    times: Column
    """(n,) duration of the flight; the forcing period is 2. NaN where there is no next impact, as in what follows."""
    phases: Column
    """(n,) phase of the forcing at the impact, rad, in [0, 2 pi)."""
    velocities: Column
    """(n,) velocity just before the impact, positive at the bottom, negative at the top."""
    jacobian: Column
    """(n, 2, 2) derivatives of (time, velocity) of the impact by those of the one before; NaN unless asked for."""
    faults: dict[int, str]
    """Why there is no next impact, by index: the ball rests, grazes, or flies for too long."""


def next_impact(
    side: str | _Iterable[str],
    phase: Any,
    velocity: Any,
    *,
    g: float,
    d: float,
    r_b: float,
    r_t: float,
    jacobian: bool = False,
) -> NextImpact:
    """The one-impact map over arrays of states, for methods of one's own.

    `side` is "bottom" or "top", or n of these; `phase` (rad) and `velocity` (just before impact; positive at the bottom,
    negative at the top) are numbers or arrays of shape (n,). `g` is gravity along the capsule, `d` its length, `r_b` and
    `r_t` in (0, 1] the restitutions, all without unit. To have DP of a phase instead of a time, multiply the first row by
    pi and divide the first column by pi.
    """
    parameters = [_number(value, name) for name, value in (("g", g), ("d", d), ("r_b", r_b), ("r_t", r_t))]
    phases, velocities = _numbers(phase, "phase"), _numbers(velocity, "velocity")
    sides = [side] if isinstance(side, str) else _listed(side, "side")
    lengths = {"side": len(sides), "phase": len(phases), "velocity": len(velocities)}
    scalars = {"side": isinstance(side, str), "phase": _is_number(phase), "velocity": _is_number(velocity)}
    counts = {name: length for name, length in lengths.items() if not scalars[name]}
    if len({*counts.values()}) > 1:
        raise InputError(f"the lengths differ: {', '.join(f'{name} has {n}' for name, n in counts.items())}")
    count = next(iter(counts.values()), 1)
    for place, name in enumerate(sides):
        if name not in ("bottom", "top"):
            raise InputError(f"{_at('side', place, scalars['side'])} is {name!r:.40}; 'bottom' or 'top' is needed")
    if scalars["phase"]:
        phases = phases * count
    if scalars["velocity"]:
        velocities = velocities * count
    if scalars["side"]:
        sides = sides * count
    for name, values in (("phase", phases), ("velocity", velocities)):
        if not all(_each(_math.isfinite, values)):
            place = next(place for place, value in enumerate(values) if not _math.isfinite(value))
            raise InputError(f"{_at(name, place, scalars[name])} is {values[place]}; a finite number is needed")
    is_top = bytes(name == "top" for name in sides)
    found, arrays, faults = _native.next_impact(is_top, phases.tobytes(), velocities.tobytes(), parameters, bool(jacobian))
    times, phases_, velocities_, derivatives = (Column(*numbers) for numbers in arrays)
    return NextImpact(found, times, phases_, velocities_, derivatives, dict(faults))


def _at(name: str, place: int, is_scalar: bool) -> str:
    return name if is_scalar else f"{name}[{place}]"


def _is_number(value: Any) -> bool:
    return hasattr(value, "__float__") and not getattr(value, "shape", ()) and not isinstance(value, str)


def _number(value: Any, name: str) -> float:
    if not _is_number(value):
        raise InputError(f"{name} is {value!r:.40}; a number is needed")
    return float(value)


def _listed(values: Any, name: str) -> list[Any]:
    try:
        return list(values)
    except TypeError:
        raise InputError(f"{name} is {values!r:.40}; a list or an array is needed") from None


def _numbers(values: Any, name: str) -> _array.array[float]:
    """One dimension of f64."""
    kind = getattr(getattr(values, "dtype", None), "kind", "f")
    if kind not in "fiubO":
        raise InputError(f"{name} has numbers of the type {values.dtype}; real numbers are needed")
    # of a series of pandas `mask` is a method
    is_masked = not callable(getattr(values, "mask", _each))
    if is_masked or isinstance(values, (_Mapping, set, frozenset)):
        what = "masked values" if is_masked else f"a {type(values).__name__}"
        raise InputError(f"{name} is {what}; a number or an array of shape (n,) is needed")
    if _is_number(values):
        return _array.array("d", [float(values)])
    shape = getattr(values, "shape", None)
    if shape is not None and len(shape) != 1:
        raise InputError(f"{name} has shape {tuple(shape)}; a number or the shape (n,) is needed")
    if isinstance(values, (str, bytes)):
        raise InputError(f"{name} is {values!r:.40}; a number or an array of shape (n,) is needed")
    try:
        view = memoryview(values)
        if view.format == "d":
            return _array.array("d", view.tobytes())
    except TypeError:
        pass  # it has no buffer: number by number
    listed = _listed(values, name)
    try:
        return _array.array("d", listed)
    except (TypeError, OverflowError):
        bad = next(place for place, value in enumerate(listed) if not _is_number(value) or _is_too_large(value))
        raise InputError(f"{name}[{bad}] is {listed[bad]!r:.40}; a number is needed") from None


def _is_too_large(value: Any) -> bool:
    try:
        float(value)
    except (OverflowError, TypeError):
        return True
    return False


_Named = tuple[list[str], tuple[str, str] | None]
"""Arguments that name the input, and the text that stands for stdin."""


def _path(path: Path | None, what: str) -> str | None:
    if path is None:
        return None
    try:
        return _os.fsdecode(path)
    except TypeError:
        raise InputError(f"{what} is {path!r:.40}; a path is needed") from None


def _input(given: Given, what: str) -> _Named:
    """A scene or sheet: a dict, TOML text, a path or a name."""
    if isinstance(given, _Mapping):
        return ["-"], (what, to_toml(given, what))
    if isinstance(given, str) and "\n" in given:
        return ["-"], (what, given)
    if isinstance(given, (str, bytes, _os.PathLike)):
        path = _os.fsdecode(given)
        return [f".{_os.sep}-" if path == "-" else path], None
    raise InputError(f"{what} is {given!r:.40}; a path, a dict or TOML text is needed", what)


def _answers(answers: Path | _Mapping[str, _Iterable[Any]]) -> _Named:
    if isinstance(answers, (str, bytes, _os.PathLike)):
        return _input(answers, "answers")
    columns = {str(name): _listed(answers[name], f"answers[{name!r}]") for name in _listed(answers, "answers")}
    lengths = {name: len(column) for name, column in columns.items()}
    if len({*lengths.values()}) > 1:
        raise InputError(f"answers: the lengths differ: {', '.join(f'{name} has {n}' for name, n in lengths.items())}")
    text = _io.StringIO()
    writer = _csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    # a number of numpy prints with its type; what is not there is an empty field
    writer.writerows([float(cell) if isinstance(cell, float) else cell for cell in row] for row in zip(*columns.values()))
    return ["-"], ("answers", text.getvalue())


_COUNTS = ("digits", "impacts", "last", "effort")


def _count(value: Any, name: str) -> int:
    try:
        if isinstance(value, bool):
            raise TypeError
        return _operator.index(value)
    except TypeError:
        raise InputError(f"{name} is {value!r:.40}; a whole number is needed") from None


def _ask(command: str, options: _Mapping[str, Any], given: _Named | None, format: str) -> Any:
    named, text = given if given is not None else ([], None)
    arguments = [command, f"--format={format}"]
    for name, value in options.items():
        if value is None or value is False:
            continue
        if name in _COUNTS:
            arguments.append(f"--{name}={_count(value, name)}")
        elif value is True:
            arguments.append(f"--{name}")
        elif isinstance(value, _Mapping):
            arguments += [f"--{name}={key}={_to_value(item, f'set[{key!r}]')}" for key, item in value.items()]
        elif name in ("kind", "level") and not isinstance(value, str):
            arguments += [f"--{name}={item}" for item in _listed(value, name)]
        elif name == "set":
            raise InputError(f"set is {value!r:.40}; a dict of keys is needed, as in {{'motion.d': 0.3}}")
        else:
            arguments.append(f"--{name}={value}")
    return _native.ask([*arguments, "--", *named], text)


def _columns(columns: _Iterable[tuple[str, Any]]) -> dict[str, Any]:
    return {name: Column(*values) if isinstance(values, tuple) else values for name, values in columns}


def _table(command: str, options: _Mapping[str, Any], given: _Named | None) -> Table:
    [(rows, columns)], _, _, status, notes = _ask(command, options, given, "json")
    return Table(_columns(columns), rows, status == 0, notes)


def _report(command: str, options: _Mapping[str, Any], given: _Named | None) -> Report:
    [(rows, columns), *more], page, _, status, notes = _ask(command, options, given, "html")
    numbers = [Table(_columns(own), count) for count, own in more]
    return Report(_columns(columns), rows, status == 0, notes, html=page, numbers=next(iter(numbers), None))


def _text(command: str, options: _Mapping[str, Any], given: _Named | None) -> tuple[str, list[str]]:
    _, _, text, _, notes = _ask(command, options, given, "text")
    return text, notes
