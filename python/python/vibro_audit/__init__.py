"""Checks the formulas and numbers that a paper prints, and computes the motions of a vibro-impact device.

Scenes and sheets are a path, a dict, or TOML text (a string with a line break); a string that is the name of a built-in
scene, such as "fig02", is that scene. Quantities have no unit unless one is given: lengths and times are those of the
model, in which the forcing period is 2; phases are in rad. `columns` describes every column of a command.

Long work releases the interpreter's lock and ends at Ctrl-C. Input that cannot be used is an `InputError`, and so is
input that needs more memory than there is.

Examples
--------
>>> orbits = va.orbits({"motion": {"g": 0.122, "d": 0.4, "r_b": 0.5, "r_t": 0.5}})
>>> orbits["word"], list(orbits["stable"])
(['BT', 'BT'], [True, False])
"""

from __future__ import annotations

import math as _math
from collections.abc import Iterable as _Iterable
from collections.abc import Mapping as _Mapping
from typing import Any, NamedTuple

from . import _arguments, _native
from ._arguments import Given, Path
from ._errors import InputError
from ._errors import as_input_errors as _as_input_errors
from ._messages import in_python as _in_python
from ._native import __version__
from ._table import Column, Figure, Report, Table
from ._toml import to_toml

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
    "columns",
    "explain",
    "map",
    "next_impact",
    "optimise",
    "orbits",
    "plan",
    "plot",
    "problems",
    "run",
    "score",
    "simulate",
    "stress",
    "sweep",
    "to_toml",
    "trade",
    "trajectory",
]


def audit(sheet: Given | None = None, *, effort: int = 1, repair: bool = False, baseline: Path | None = None) -> Report:
    """A verdict for each formula of a sheet or a document.

    Parameters
    ----------
    sheet : dict, str or path, optional
        The sheet: a dict, TOML text or a file; or a document, a file whose name ends in .tex, .md, .qmd or .ipynb.
        Without it, the appendix of the paper is audited.
    effort : int, optional
        Search so many times as far for proofs and counterexamples, 1 to 1000000.
    repair : bool, optional
        Look for the smallest edits that make a refuted formula true (column `repair`).
    baseline : path, optional
        A file that `vibro-audit audit` wrote as sarif, json or csv. Its findings do not count as unexpected.

    Returns
    -------
    Report
        A row per formula. `verdict` is "proved", "refuted", "undecided" or "unread", and also "conditional", "given" or
        "suspect", as `vibro-audit audit --help` explains; `counterexample_values` has the exact values of a
        counterexample by symbol. `as_expected` is True if all verdicts are those that the sheet expects. In a notebook
        the result is shown as a page. `numbers` are the numbers that a document prints.

    Raises
    ------
    InputError
        The sheet or an option cannot be used. A formula that cannot be read is a row instead.

    Examples
    --------
    >>> claim = {"label": "square", "role": "claim", "tex": "(x + 1)^2 = x^2 + 1"}
    >>> found = va.audit({"symbols": {"parameters": ["x"]}, "equation": [claim]})
    >>> found["verdict"], found.as_expected
    (['refuted'], False)
    """
    options = {"effort": effort, "repair": repair, "baseline": baseline}
    return _report("audit", options, sheet, "sheet")


def explain(sheet: Given | None, label: str, *, effort: int = 1) -> str:
    """The proof or the counterexample of one formula, in words.

    Parameters
    ----------
    sheet : dict, str or path, or None
        The sheet or document, as for `audit`; None is the appendix of the paper.
    label : str
        The label of the formula.
    effort : int, optional
        Search so many times as far, 1 to 1000000.

    Returns
    -------
    str
        The explanation, of several lines.

    Raises
    ------
    InputError
        The sheet or an option cannot be used, or no formula has this label.

    Examples
    --------
    >>> claim = {"label": "square", "role": "claim", "tex": "(x + 1)^2 = x^2 + 1"}
    >>> va.explain({"symbols": {"parameters": ["x"]}, "equation": [claim]}, "square")[:16]
    '(square) refuted'
    """
    label = _arguments.text(label, "label")
    return _text("audit", {"label": label, "effort": effort}, sheet, "sheet")[0]


def check(directory: Path | None = None, *, add: _Mapping[str, Any] | None = None) -> Report:
    """A verdict for each printed number of a directory of golden values.

    Parameters
    ----------
    directory : path, optional
        The directory, with `printed.csv`, and `scenes/` and `reference/` where its rows name them. Without it, the
        numbers of the paper are checked.
    add : dict, optional
        A row to compute and, if its verdict is the expected one, to add to `printed.csv`; the directory and its files
        are created where missing. Nothing else is checked. Its keys are

        - `id`, `place` and `printed`, which are needed: a permanent and unique name; where it is printed, such as
          "Table 2"; the number as printed, with every figure, as a string or a `decimal.Decimal`: "0.8320", a range
          "(a, b)", "< b" or "> a", or a word;
        - `quantity`: what it is a value of, COMMAND.COLUMN or COMMAND.COLUMN[n], such as "orbits.velocities[0]";
        - `scene`: a built-in scene, or a file; one outside the directory is copied to `scenes/`;
        - `set`: a dict of keys of the scene to change, as in {"motion.d": 0.4}, and of conditions that choose a row of
          the answer, as in {"row.word": "BT"} or {"row.d": "near 0.25"};
        - `expected`: the expected verdict, "reproduced" where it is not given;
        - `unit`, `rests_on` (an assumption that the paper does not state, as "A = 5 N") and `note`, for readers.

    Returns
    -------
    Report
        A row per value. `verdict` is "reproduced", "truncated", "off-by-one", "rounded", "wrong", "undetermined" or
        "undecided". With `add` the one row; `as_expected` is False, and a note tells why, where it was not added.

    Raises
    ------
    InputError
        The directory or the row cannot be used. Then nothing is written.

    Examples
    --------
    >>> import tempfile
    >>> row = {"id": "v", "place": "Table 2", "printed": "0.83272", "quantity": "orbits.velocities[0]"}
    >>> row |= {"scene": "fig02", "set": {"motion.d": 0.4, "row.stable": True}}
    >>> with tempfile.TemporaryDirectory() as directory:
    ...     va.check(directory, add=row)["verdict"], va.check(directory)["verdict"]
    (['reproduced'], ['reproduced'])
    """
    if add is not None and directory is None:
        raise InputError("directory is None; a path is needed, to which the row is added")
    return _report("check", {"add": add}, directory, "directory")


def orbits(
    scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False, digits: int | None = None
) -> Table:
    """All periodic motions of the words that the scene names, with proof.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.
    digits : int, optional
        Significant digits to compute. More than 15 are returned as `decimal.Decimal`.

    Returns
    -------
    Table
        A row per motion. `phases` (rad, in [0, 2 pi)), `velocities` (just before impact, positive at the bottom,
        negative at the top) and `times` (of the flight that follows; the forcing period is 2) are lists in word order.
        `error_bound` bounds the error of each number of the row; `complete` is True where it is proved that there is no
        other motion.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> found = va.orbits("fig02", set={"motion.d": 0.4})
    >>> found["word"], list(found["stable"]), max(found["error_bound"]) < 1e-12
    (['BT', 'BT'], [True, False], True)
    >>> type(va.orbits("fig02", digits=30)["velocities"][0][0])
    <class 'decimal.Decimal'>
    """
    return _table("orbits", {"set": set, "strict": strict, "digits": digits}, scene)


def branch(
    scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False, digits: int | None = None
) -> Table:
    """The periodic motions over the scene's sweep, and every bifurcation.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.
    digits : int, optional
        Significant digits to compute. More than 15 are returned as `decimal.Decimal`.

    Returns
    -------
    Table
        A row per motion and value (`kind` "point") and per bifurcation ("fold", "period-doubling", "symmetry-breaking",
        "node-focus", "grazing"), in the order of the sweep. Columns as in `orbits`. Of a scene with `[branch]`: the
        curves of bifurcations over its two parameters, a row per step and special point.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> found = va.branch("fig02", set={"sweep.points": 3})
    >>> print(sorted({*found["kind"]} - {"point"}))
    ['fold', 'grazing', 'node-focus', 'period-doubling']
    """
    return _table("branch", {"set": set, "strict": strict, "digits": digits}, scene)


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
    """The impacts of one motion, with rest and release, from the scene's start.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    impacts : int, optional
        Stop after so many impacts; the start is number 1. Without `impacts` and `until` it is 100.
    until : float, optional
        The time to simulate to, at least 0; the forcing period is 2.
    last : int, optional
        Return only the last so many events, 1 to 1000000.
    proved : bool, optional
        Bound the error of each event with proof; the motion ends where it can no longer be bounded.
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.
    digits : int, optional
        Significant digits to compute. More than 15 are returned as `decimal.Decimal`.

    Returns
    -------
    Table
        A row per event: `time`, `phase` (rad), `velocity` just before the impact, `side` "bottom" or "top", `kind`
        "impact", "rest", "release" or "undecided", and `digits`, the number of digits that still hold.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> found = va.simulate("fig03", impacts=4)
    >>> found["side"], list(found["event"])
    (['bottom', 'top', 'bottom', 'top'], [1, 2, 3, 4])
    """
    options = {"impacts": impacts, "until": until, "last": last, "proved": proved}
    return _table("simulate", {**options, "set": set, "strict": strict, "digits": digits}, scene)


def trajectory(
    scene: Given,
    *,
    samples: int | None = None,
    until: float | None = None,
    impacts: int | None = None,
    set: _Mapping[str, Any] | None = None,
    strict: bool = False,
    digits: int | None = None,
) -> Table:
    """Position and velocity between impacts at evenly spaced times, from the scene's start.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    samples : int, optional
        The number of times, both ends counted, 1 to 10000000; 1001 where it is not given.
    until : float, optional
        The last time, above 0; the forcing period is 2. It is 10 where neither `until` nor `impacts` is given.
    impacts : int, optional
        End at the impact of this number, 1 to 4294967295; the start is number 1. It excludes `until`.
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.
    digits : int, optional
        Significant digits to compute; f64 is returned.

    Returns
    -------
    Table
        A row per time. `z` is capsule minus ball and `zdot` its rate: `z` is d/2 at the bottom, -d/2 at the top.
        `capsule` is the middle of the capsule and `ball` = `capsule` - `z` the ball, in the frame in which the capsule
        swings about 0; the columns in SI units follow, empty where `[device]` does not give the units. `energy` is that
        of the ball against the capsule, zdot^2/2 - g z, and `ball_energy` its energy in the frame at rest. At an
        impact the velocity is that before it.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> found = va.trajectory("fig02", samples=5, until=2)
    >>> list(found["time"])
    [0.0, 0.5, 1.0, 1.5, 2.0]
    >>> round(found["z"][0], 4)
    0.13
    """
    options = {"samples": samples, "until": until, "impacts": impacts}
    return _table("trajectory", {**options, "set": set, "strict": strict, "digits": digits}, scene)


def sweep(
    scene: Given, *, summary: bool = False, set: _Mapping[str, Any] | None = None, strict: bool = False
) -> Table:
    """The bifurcation diagram of the scene's sweep: the last impacts at each value of a parameter.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    summary : bool, optional
        Return a row per value instead.
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.

    Returns
    -------
    Table
        A row per value and impact, with the voltage (V) of the impact where the scene has a membrane. With `summary` a
        row per value: `word`, `periods`, mean voltage (V) and Lyapunov exponent (per unit of time), each with a
        standard error.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> found = va.sweep("fig03", summary=True, set={"sweep.points": 3, "sweep.impacts": 200})
    >>> found.rows, "mean_voltage" in found
    (3, True)
    """
    return _table("sweep", {"summary": summary, "set": set, "strict": strict}, scene)


def map(scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False) -> Table:
    """The long-term motion at each point of the scene's `[map]` of two parameters, from each start.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.

    Returns
    -------
    Table
        A row per point and start, along x first: `x`, `y`, `start` (its number, from 0), `word`, `periods`, mean
        voltage (V), voltage per forcing period (V) and Lyapunov exponent (per unit of time), each with a standard
        error.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> x = {"over": "d", "from": 0.1, "to": 0.5, "points": 3}
    >>> y = {"over": "r_b", "from": 0.3, "to": 0.9, "points": 2}
    >>> found = va.map("fig03", set={"map": {"impacts": 80, "x": x, "y": y}})
    >>> list(found["y"])
    [0.3, 0.3, 0.3, 0.9, 0.9, 0.9]
    """
    return _table("map", {"set": set, "strict": strict}, scene)


def basins(
    scene: Given, *, attractors: bool = False, set: _Mapping[str, Any] | None = None, strict: bool = False
) -> Table:
    """The attractor that each start of the scene's `[basins]` reaches.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    attractors : bool, optional
        Return a row per attractor instead.
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.

    Returns
    -------
    Table
        A row per start, phases first, with `phase` (rad), `velocity` and `attractor` (its number, from 1; None where an
        undecided contact ends the motion). With `attractors` a row per attractor: its number, `word`, `periods`, the
        `fraction` of the starts with a standard error, the voltage per forcing period (V), and the phases and
        velocities of its impacts, with `error_bound` where the orbit is proved.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> phase, velocity = {"from": 0, "to": 6, "points": 4}, {"from": 0, "to": 1, "points": 3}
    >>> few = {"basins": {"impacts": 400, "phase": phase, "velocity": velocity}, "motion.d": 0.45}
    >>> va.basins("fig03", set=few).rows
    12
    >>> va.basins("fig03", set=few, attractors=True)["word"]
    ['BT']
    """
    return _table("basins", {"attractors": attractors, "set": set, "strict": strict}, scene)


def optimise(
    scene: Given,
    *,
    gap: float | None = None,
    effort: int | None = None,
    set: _Mapping[str, Any] | None = None,
    strict: bool = False,
) -> Table:
    """The device with the largest voltage in the scene's `[box]` of parameters, with proof.

    The optimum is taken over devices with a stable and admissible 1-1 motion.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    gap : float, optional
        Stop where `low` is within this fraction of `high`, above 0 and below 1; 1e-4 where it is not given.
    effort : int, optional
        Search up to so many times as many boxes, 1 to 1000000.
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.

    Returns
    -------
    Table
        A row for the voltage per forcing period (V), then one per parameter: `quantity`, `low` and `high` (the optimum
        is between them), `value` (of the device found), `attained`, `active`, `sensitivity` (V per unit of the
        parameter). It has no rows where no device of the box has such a motion.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> box = {"d": [0.1, 0.5], "r_b": [0.3, 0.7], "r_t": [0.3, 0.7]}
    >>> found = va.optimise("fig03", set={"box": box}, gap=1e-2)
    >>> found["quantity"]
    ['voltage_rate', 'd', 'incline', 'r_b', 'r_t']
    """
    return _table("optimise", {"gap": gap, "effort": effort, "set": set, "strict": strict}, scene)


def plot(scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False) -> Figure:
    """A drawing (SVG) of what the scene wants: `branch`, `sweep`, `voltage`, `trajectory`, `map`, `basins`.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.

    Returns
    -------
    Figure
        The drawing, which a notebook shows.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> figure = va.plot("fig03", set={"want": ["sweep"], "sweep.points": 5})
    >>> figure.svg[:4]
    '<svg'
    """
    svg, notes = _text("plot", {"set": set, "strict": strict}, scene)
    return Figure(svg, notes)


def run(
    scene: Given,
    directory: Path,
    *,
    set: _Mapping[str, Any] | None = None,
    strict: bool = False,
    digits: int | None = None,
) -> Table:
    """The files of all commands that the scene asks for, written to a directory as CSV.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    directory : path
        Where the files go. It is created where it is missing; files of the same names are overwritten.
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.
    digits : int, optional
        Significant digits to compute and to print.

    Returns
    -------
    Table
        A row per file: `command`, `want` (what of the scene's `want` it serves), `file` (its path), `rows`.

    Raises
    ------
    InputError
        The scene or an option cannot be used, or a file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as directory:
    ...     found = va.run("fig02", directory, set={"want": ["orbits", "impacts"]})
    >>> found["command"], list(found["rows"])
    (['orbits', 'simulate'], [1, 100])
    """
    directory = _arguments.path(directory, "directory")
    options = {"directory": directory, "set": set, "strict": strict, "digits": digits}
    return _table("run", options, scene, format="csv")


def plan(
    scene: Given, *, set: _Mapping[str, Any] | None = None, strict: bool = False, digits: int | None = None
) -> str:
    """What `run` would do: the commands that a scene asks for, the model of each, and every key that is read.

    Parameters
    ----------
    scene : dict, str or path
        The scene: a dict, TOML text, a file, or the name of a built-in scene such as "fig02".
    set : dict, optional
        Keys of the scene that are changed, as in ``{"motion.d": 0.3}``.
    strict : bool, optional
        Refuse a scene with keys that nothing asked for needs.
    digits : int, optional
        Significant digits, as for `run`.

    Returns
    -------
    str
        The plan, of several lines. Nothing is computed and nothing is written.

    Raises
    ------
    InputError
        The scene or an option cannot be used.

    Examples
    --------
    >>> print(*va.plan("fig02", set={"want": ["orbits"]}).splitlines()[:4], sep="\\n")
    Fig. 2: r_B = 0.5, r_T = 0.5, beta = pi/6 (fig02)
    <BLANKLINE>
    wanted
      orbits: every orbit of the wanted words (`orbits`)
    """
    options = {"set": set, "strict": strict, "digits": digits}
    return _in_python(_text("run", options, scene, more=["--explain"])[0], "run")


def trade(
    task: str | None = None,
    *,
    method: str | None = None,
    number: str | None = None,
    problems: bool = False,
    advise: str | _Mapping[str, Any] | None = None,
) -> Table:
    """Time against true error for each method of a task.

    Parameters
    ----------
    task : str, optional
        What to compute: "dp", "multipliers", "voltage", "impact", "orbit" or "statistics". Without it, all of them,
        which takes about a minute.
    method : str, optional
        Only this method, by its name in the table.
    number : str, optional
        Only this number: "f32", "f64", "double-double" or "50-digits".
    problems : bool, optional
        Return a row per problem of the task and method, untimed.
    advise : dict or str, optional
        A need, as in ``{"digits": 8, "task": "orbit"}``; the text "digits=8,task=orbit" is the same. The cheapest
        method that meets it and the runner-up are returned. `digits` are to hold at the share `solved` of the problems
        (at all of them where it is not given), `error` is the relative error of a statistic, ``"proved": True`` asks
        for a proof, `task` for the tasks with this in their names. It excludes `task`, `method`, `number` and
        `problems`.

    Returns
    -------
    Table
        A row per method; `columns` describes it by "trade", "trade --problems" and "trade --advise". With `advise`,
        `as_expected` is False where neither a method of a task nor a command meets the need; the closest is returned.
        Times are in seconds, of this machine, which `notes` names.

    Raises
    ------
    InputError
        There is no such task, method or number, or the need cannot be read.

    Examples
    --------
    >>> found = va.trade("multipliers", number="f64", problems=True)
    >>> list(found)
    ['task', 'number', 'method', 'problem', 'digits', 'outcome', 'at', 'setting']
    """
    options = {"method": method, "number": number, "problems": problems, "advise": advise}
    return _table("trade", options, task, "task")


def stress(
    case: str | None = None, *, search: float | None = None, frozen: Path | None = None, curve: bool = False
) -> Table:
    """The correct digits of each formula at extreme parameters.

    Parameters
    ----------
    case : str, optional
        Only the cases that have this in their names, as "Delta near 0". Without it all, which takes a minute.
    search : float, optional
        Search for new worst points for so many seconds instead, above 0 and at most 86400. It excludes all else.
    frozen : path, optional
        A file of points to compare with, instead of the built-in ones.
    curve : bool, optional
        Approach each extreme step by step: digits against the distance, or against the length that grows. It excludes
        `frozen`.

    Returns
    -------
    Table
        A row per case, formula, number type and form: `digits` that are correct, `condition`, the point `at` which it
        is, and `allowed`. `as_expected` is False where the form that is used keeps fewer digits than
        14.5 - log10(condition), or where a stored worst point has become less accurate; `notes` names them.

    Raises
    ------
    InputError
        There is no such case, or a file or an option cannot be used.

    Examples
    --------
    >>> found = va.stress("Delta near 0")
    >>> found.as_expected, list(found)[:5]
    (True, ['case', 'formula', 'number', 'form', 'digits'])
    """
    return _table("stress", {"search": search, "frozen": frozen, "curve": curve}, case, "case")


def columns(command: str) -> Table:
    """A description of each column of a command: its name, type, unit and meaning.

    Parameters
    ----------
    command : str
        The name of the function, such as "orbits". Options that change the columns stand behind it, as on the command
        line: "sweep --summary", "basins --attractors", "trade --problems", "trade --advise", "stress --curve",
        "score --summary".

    Returns
    -------
    Table
        A row per column: `command`, `column`, `type`, `unit`, `optional` (True where a row may have no value),
        `meaning`, and the `version` of the descriptions.

    Raises
    ------
    InputError
        There is no such command.

    Examples
    --------
    >>> described = va.columns("orbits")
    >>> next(row["unit"] for row in described.each() if row["column"] == "phases")
    'rad'
    """
    return _table("", {}, None, "command", more=[f"--columns={_arguments.text(command, 'command')}"])


def problems(
    *, kind: str | _Iterable[str] = (), level: str | _Iterable[str] = (), answers: bool = True
) -> Table:
    """Test problems with certified answers of 30 digits, for a solver of your own.

    The ball moves by Z'' = cos(pi t + phase) + g between the bottom at Z = d/2 and the top at Z = -d/2, where Z'
    becomes -r_b Z' and -r_t Z'. Time 0 is the impact (side, phase, velocity). `vibro-audit problems --help` defines the
    quantities of each kind.

    Parameters
    ----------
    kind : str or list of str, optional
        Only problems of these kinds: "orbit", "impact", "run", "jacobian", "voltage".
    level : str or list of str, optional
        Only problems of these levels: "easy", "hard", "extreme".
    answers : bool, optional
        Return the answers as well.

    Returns
    -------
    Table
        A row per quantity that is asked for. Numbers are `decimal.Decimal`, exactly as posed; phases are in rad,
        velocities positive at the bottom and negative at the top. The column `certified` names the two methods by which
        the answer was found.

    Raises
    ------
    InputError
        There is no such kind or level.

    Examples
    --------
    >>> asked = va.problems(kind="impact", level="easy", answers=False)
    >>> {*asked["kind"]}, "answer" in asked
    ({'impact'}, False)
    """
    return _table("problems", {"kind": kind, "level": level, "answers": answers}, None, "kind")


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
    """A rating of answers to `problems` by the digits that agree with the certified ones.

    Parameters
    ----------
    answers : path, dict or DataFrame, optional
        A CSV file, or columns of one length: "problem", "quantity", "answer" and, if you like, "seconds" (of the whole
        problem). None, NaN and infinite values count as missing answers.
    exec : str, optional
        A command that answers, in place of `answers`. It is run by `sh -c`, reads the problems without answers as CSV
        from stdin, and writes such answers to stdout. It finds the tolerance in VIBRO_TOLERANCE and in place of
        {tolerance}.
    tolerances : list of float, optional
        The tolerances that `exec` is run at, above 0; 1e-3, 1e-6, 1e-9 and 1e-12 where they are not given.
    limit : float, optional
        The seconds that each run of `exec` may take, above 0; 60 where it is not given.
    kind : str or list of str, optional
        Only problems of these kinds, as for `problems`.
    level : str or list of str, optional
        Only problems of these levels, as for `problems`.
    summary : bool, optional
        Return the worst and the median of each kind and level; with `exec`, of each tolerance.

    Returns
    -------
    Report
        A row per quantity, or of the summary. `digits` are -log10 of the relative error, of a phase those of the
        difference around the circle in rad; 30 at most.

    Raises
    ------
    InputError
        The answers or an option cannot be used, or the command fails.

    Examples
    --------
    >>> asked = va.problems(kind="impact", level="easy")
    >>> answers = {name: asked[name] for name in ("problem", "quantity", "answer")}
    >>> min(va.score(answers, kind="impact", level="easy")["digits"]) > 29
    True
    """
    options = {"exec": exec, "tolerances": tolerances, "limit": limit, "kind": kind, "level": level, "summary": summary}
    if answers is None and exec is None:
        raise InputError("answers is None; give a CSV file, a dict of columns, or exec='command'")
    return _report("score", options, answers, "answers")


class NextImpact(NamedTuple):
    """The ends of n flights, as arrays of length n: what `next_impact` returns.

    Attributes
    ----------
    sides : list of str or None
        (n,) "bottom" or "top"; None where there is no next impact.
    times : Column
        (n,) duration of the flight; the forcing period is 2. NaN where there is no next impact, as in the columns that
        follow.
    phases : Column
        (n,) phase of the forcing at the impact, rad, in [0, 2 pi).
    velocities : Column
        (n,) velocity just before the impact, positive at the bottom, negative at the top.
    jacobian : Column
        (n, 2, 2) derivatives of (time, velocity) of the impact by those of the one before; NaN unless asked for.
    faults : dict of int to str
        The reason why there is no next impact, by index: the ball rests, grazes, or flies for too long.

    Examples
    --------
    >>> found = va.next_impact("bottom", [1.0, 6.18], [0.0, 0.5], g=0.5, d=0.3, r_b=0.5, r_t=0.5)
    >>> found.sides[0], list(found.faults)
    (None, [0])
    """

    sides: list[str | None]
    times: Column
    phases: Column
    velocities: Column
    jacobian: Column
    faults: dict[int, str]


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
    """The impact that follows each state: the one-impact map over arrays, for methods of your own.

    Parameters
    ----------
    side : str or list of str
        "bottom" or "top", or n of these.
    phase : float or array of shape (n,)
        The phase of the forcing at the impact, rad.
    velocity : float or array of shape (n,)
        The velocity just before the impact, positive at the bottom, negative at the top.
    g : float
        Gravity along the capsule, without unit.
    d : float
        The length of the capsule, without unit, above 0.
    r_b, r_t : float
        The restitutions of bottom and top, in (0, 1].
    jacobian : bool, optional
        Compute the derivatives as well. For the derivatives of a phase instead of a time, multiply the first row by pi
        and divide the first column by pi.

    Returns
    -------
    NextImpact
        Arrays of length n. A state without a next impact is no error: `faults` says why.

    Raises
    ------
    InputError
        A state or a parameter cannot be used, the lengths differ, or there are more than 20 million states.

    Examples
    --------
    >>> found = va.next_impact("bottom", [6.18, 6.2], 0.5293, g=0.122, d=0.26, r_b=0.6, r_t=0.3, jacobian=True)
    >>> found.sides, found.jacobian.shape
    (['top', 'top'], (2, 2, 2))
    """
    with _as_input_errors("the list of states"):
        parameters = [_arguments.number(value, name) for name, value in zip(("g", "d", "r_b", "r_t"), (g, d, r_b, r_t))]
        has_jacobian = _arguments.flag(jacobian, "jacobian")
        is_top, phases, velocities = _arguments.states(side, phase, velocity)
        sides: list[str | None] = []
        faults: dict[int, str] = {}
        n = len(is_top)
        shapes = [(n,), (n,), (n,), (n, 2, 2)]
        ends = [bytearray(8 * _math.prod(shape)) for shape in shapes]
        # of parts the memory is soon free again, and where there is too little of it Python says so
        for start in range(0, n, _STATES_AT_ONCE) or (0,):
            end = start + _STATES_AT_ONCE
            part = is_top[start:end], phases[8 * start : 8 * end], velocities[8 * start : 8 * end]
            own_sides, own_ends, own_faults = _native.next_impact(*part, parameters, has_jacobian)
            sides += own_sides
            faults.update((start + place, fault) for place, fault in own_faults)
            for whole, (_, shape, numbers), each in zip(ends, own_ends, (8, 8, 8, 32)):
                whole[each * start : each * (start + shape[0])] = numbers
        made = [Column("d", shape, numbers) for shape, numbers in zip(shapes, ends)]
        return NextImpact(sides, *made, faults)


_STATES_AT_ONCE = 1 << 20
"""States of `next_impact` that the native part is asked for at a time."""


def _ask(
    command: str, options: _Mapping[str, Any], given: Any, name: str, format: str, more: _Iterable[str] = ()
) -> Any:
    """Answers a command line. Errors and notes speak of the arguments of the function."""
    with _as_input_errors(name):
        named, text = _named(given, name)
        own = _arguments.options(options)
        words = [command] if command else []
        try:
            *found, notes = _native.ask([*words, f"--format={format}", *more, *own, "--", *named], text)
        except InputError as error:
            path = "add" if error.path == "--add" else error.path
            raise InputError(_in_python(error.message, command, own), path, error.line, error.column) from None
        return *found, [_in_python(note, command, own) for note in notes]


def _named(given: Any, name: str) -> _arguments.Named:
    if given is None and name != "scene":
        return [], None
    if name in ("scene", "sheet"):
        return _arguments.given(given, name)
    if name == "answers":
        return _arguments.answers(given)
    return [_arguments.path(given, name) if name == "directory" else _arguments.text(given, name)], None


def _columns(columns: _Iterable[tuple[str, Any]]) -> dict[str, Any]:
    return {name: Column(*values) if isinstance(values, tuple) else values for name, values in columns}


def _table(
    command: str,
    options: _Mapping[str, Any],
    given: Any,
    name: str = "scene",
    format: str = "json",
    more: _Iterable[str] = (),
) -> Table:
    [(rows, columns)], _, _, status, notes = _ask(command, options, given, name, format, more)
    return Table(_columns(columns), rows, status == 0, notes)


def _report(command: str, options: _Mapping[str, Any], given: Any, name: str) -> Report:
    [(rows, columns), *more], page, _, status, notes = _ask(command, options, given, name, "html")
    numbers = [Table(_columns(own), count) for count, own in more]
    return Report(_columns(columns), rows, status == 0, notes, html=page, numbers=next(iter(numbers), None))


def _text(
    command: str, options: _Mapping[str, Any], given: Any, name: str = "scene", more: _Iterable[str] = ()
) -> tuple[str, list[str]]:
    _, _, text, _, notes = _ask(command, options, given, name, "text", more)
    return text, notes
