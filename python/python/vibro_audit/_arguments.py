"""Conversion of Python arguments to a command line. What has the wrong type is an `InputError` that names it."""

from __future__ import annotations

import array
import csv
import difflib
import io
import math
import operator
import os
from collections.abc import Callable, Iterable, Mapping
from itertools import islice
from typing import Any

from ._errors import InputError, check_text, shown
from ._toml import to_toml, to_value

Path = str | os.PathLike[str]
Given = Path | Mapping[str, Any]

MOST_ITEMS = 20_000_000
"""Items of a list, at most, and states of `next_impact`; as many cells as a table may have."""


def is_number(value: Any) -> bool:
    """Returns true if the value is a scalar that Python can make a float of."""
    return hasattr(value, "__float__") and not getattr(value, "shape", ()) and not isinstance(value, (str, type))


def is_masked(value: Any) -> bool:
    """Returns true if the value is a masked array of numpy, or an item of one that is masked."""
    # of a series of pandas `mask` is a method
    return not isinstance(value, type) and not callable(getattr(value, "mask", len))


def number(value: Any, name: str) -> float:
    """Returns a real number."""
    kind = getattr(getattr(value, "dtype", None), "kind", "f")
    if isinstance(value, bool) or not is_number(value) or kind not in "fiuO" or is_masked(value):
        raise InputError(f"{name} is {shown(value)}; a number is needed")
    try:
        return float(value)
    except OverflowError:
        raise InputError(f"{name} is {shown(value)}; it is too large, at most 1.8e308 is possible") from None
    except (TypeError, ValueError):
        raise InputError(f"{name} is {shown(value)}; a number is needed") from None


def count(value: Any, name: str) -> int:
    """Returns a whole number."""
    try:
        if isinstance(value, bool):
            raise TypeError
        found = operator.index(value)
    except TypeError:
        raise InputError(f"{name} is {shown(value)}; a whole number is needed") from None
    if abs(found) >= 1 << 64:
        raise InputError(f"{name} is {shown(value)}; it is too large")
    return found


def flag(value: Any, name: str) -> bool:
    """Returns True or False."""
    if getattr(value, "shape", None) == () and hasattr(value, "item"):
        value = value.item()  # a bool of numpy
    if not isinstance(value, bool):
        raise InputError(f"{name} is {shown(value)}; True or False is needed")
    return value


def text(value: Any, name: str, *, can_be_empty: bool = False) -> str:
    """Returns a string."""
    if not isinstance(value, str):
        raise InputError(f"{name} is {shown(value)}; a string is needed")
    if not value and not can_be_empty:
        raise InputError(f"{name} is empty; a string of at least one character is needed")
    return checked(str.__str__(value), name)


def checked(value: str, name: str) -> str:
    """Returns the string if a command line can hold it."""
    if "\0" in value:
        raise InputError(f"{name} is {shown(value)}; it contains a null character")
    return check_text(value, name)


def path(value: Any, name: str) -> str:
    """Returns a path. One that is not UTF-8 keeps its bytes."""
    try:
        found = os.fsdecode(value)
    except TypeError:
        raise InputError(f"{name} is {shown(value)}; a path is needed") from None
    if not found:
        raise InputError(f"{name} is empty; a path is needed")
    if "\0" in found:
        raise InputError(f"{name} is {shown(found)}; it contains a null character")
    try:
        os.fsencode(found)
    except UnicodeEncodeError:
        check_text(found, name)
    # `-` stands for stdin on a command line
    return f".{os.sep}-" if found == "-" else found


def listed(values: Any, name: str, needed: str = "a list or an array") -> list[Any]:
    """Returns the items of anything that is iterable, at most `MOST_ITEMS`."""
    try:
        if len(values) > MOST_ITEMS:
            raise OverflowError
    except OverflowError:
        raise InputError(f"{name} has more than {MOST_ITEMS} items; pass fewer at a time") from None
    except TypeError:
        pass  # a generator
    try:
        items = list(islice(values, MOST_ITEMS + 1))
    except TypeError:
        raise InputError(f"{name} is {shown(values)}; {needed} is needed") from None
    if len(items) > MOST_ITEMS:
        raise InputError(f"{name} has more than {MOST_ITEMS} items; pass fewer at a time")
    return items


def numbers(values: Any, name: str) -> array.array[float]:
    """Returns numbers of one dimension as f64."""
    kind = getattr(getattr(values, "dtype", None), "kind", "f")
    if kind not in "fiubO":
        raise InputError(f"{name} has numbers of the type {values.dtype}; real numbers are needed")
    if is_masked(values) or isinstance(values, (Mapping, set, frozenset)):
        what = "an array with masked values" if is_masked(values) else f"a {type(values).__name__}"
        raise InputError(f"{name} is {what}; a number or an array of shape (n,) is needed")
    if is_number(values):
        return array.array("d", [number(values, name)])
    shape = getattr(values, "shape", None)
    if isinstance(shape, tuple) and len(shape) != 1:
        raise InputError(f"{name} has shape {shape}; a number or the shape (n,) is needed")
    if isinstance(values, (str, bytes, bytearray)):
        raise InputError(f"{name} is {shown(values)}; a number or an array of shape (n,) is needed")
    try:
        view = memoryview(values)
        if view.format == "d" and view.nbytes <= 8 * MOST_ITEMS:
            return array.array("d", view.tobytes())
    except TypeError:
        pass  # it has no buffer: number by number
    items = listed(values, name, "a number or an array of shape (n,)")
    # of these numpy makes a float with no more than a warning
    has_others = any("complex" in own.__name__ or "Masked" in own.__name__ for own in {*map(type, items)})
    try:
        if has_others:
            raise TypeError
        return array.array("d", items)
    except (TypeError, ValueError, OverflowError):
        return array.array("d", [number(item, f"{name}[{place}]") for place, item in enumerate(items)])


def states(side: Any, phase: Any, velocity: Any) -> tuple[bytes, bytes, bytes]:
    """Returns n states: a byte each that is 1 at the top, and the bytes of f64."""
    if isinstance(side, (Mapping, set, frozenset)):
        raise InputError(f"side is {shown(side)}; 'bottom', 'top', or a list of these is needed")
    phases, velocities = numbers(phase, "phase"), numbers(velocity, "velocity")
    sides = [side] if isinstance(side, str) else listed(side, "side", "'bottom', 'top', or a list of these")
    lengths = {"side": len(sides), "phase": len(phases), "velocity": len(velocities)}
    scalars = {"side": isinstance(side, str), "phase": is_number(phase), "velocity": is_number(velocity)}
    counts = {name: length for name, length in lengths.items() if not scalars[name]}
    if len({*counts.values()}) > 1:
        raise InputError(f"the lengths differ: {', '.join(f'{name} has {n}' for name, n in counts.items())}")
    total = next(iter(counts.values()), 1)

    def at(name: str, place: int) -> str:
        return name if scalars[name] else f"{name}[{place}]"

    for place, own in enumerate(sides):
        if not isinstance(own, str) or own not in ("bottom", "top"):
            raise InputError(f"{at('side', place)} is {shown(own)}; 'bottom' or 'top' is needed")
    for name, values in (("phase", phases), ("velocity", velocities)):
        if not all(map(math.isfinite, values)):
            place = next(place for place, value in enumerate(values) if not math.isfinite(value))
            raise InputError(f"{at(name, place)} is {values[place]}; a finite number is needed")
    if scalars["phase"]:
        phases = phases * total
    if scalars["velocity"]:
        velocities = velocities * total
    if scalars["side"]:
        sides = sides * total
    return bytes(own == "top" for own in sides), phases.tobytes(), velocities.tobytes()


Named = tuple[list[str], tuple[str, str] | None]
"""Arguments that name the input, and a name and a text that stand for stdin."""


def given(value: Any, name: str) -> Named:
    """Returns a scene or a sheet: a dict, TOML text, a path or a name."""
    if isinstance(value, Mapping):
        return ["-"], (name, to_toml(value, name))
    if isinstance(value, str) and "\n" in value:
        return ["-"], (name, check_text(str.__str__(value), name))
    if isinstance(value, (str, bytes, os.PathLike)):
        return [path(value, name)], None
    raise InputError(f"{name} is {shown(value)}; a path, a dict or TOML text is needed", name)


def answers(value: Any) -> Named:
    """Returns the answers to be scored: a file of CSV, or columns that become CSV."""
    if isinstance(value, (str, bytes, os.PathLike)):
        return [path(value, "answers")], None
    if not (hasattr(value, "keys") and hasattr(value, "__getitem__")) or isinstance(value, type):
        message = f"answers is {shown(value)}; a CSV file, or a dict or DataFrame of columns is needed"
        raise InputError(message, "answers")
    columns: dict[str, list[str]] = {}
    for key in listed(value.keys(), "answers"):
        if not isinstance(key, str):
            raise InputError(f"answers: the key {shown(key)} is not a string", "answers")
        name = f"answers[{shown(key)}]"
        cells = value[key]
        if isinstance(cells, (str, bytes, Mapping)):
            raise InputError(f"{name} is {shown(cells)}; a list or an array is needed", "answers")
        cells = listed(cells, name)
        columns[key] = [_cell(cell, f"{name}[{place}]") for place, cell in enumerate(cells)]
    lengths = {name: len(column) for name, column in columns.items()}
    if len({*lengths.values()}) > 1:
        found = ", ".join(f"{shown(name)[1:-1]} has {n}" for name, n in lengths.items())
        raise InputError(f"answers: the lengths differ: {found}", "answers")
    written = io.StringIO()
    writer = csv.writer(written, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*columns.values()))
    return ["-"], ("answers", check_text(written.getvalue(), "answers"))


def _cell(value: Any, name: str) -> str:
    """Returns a cell of CSV. A number of numpy prints with its type; what is not there is an empty field."""
    if isinstance(value, str):
        return check_text(str.__str__(value), name)
    if value is None or type(value).__name__ in ("NAType", "NaTType"):
        return ""
    if not is_number(value) or "complex" in type(value).__name__:
        raise InputError(f"{name} is {shown(value)}; a number, a string or None is needed", "answers")
    try:
        # a Decimal and an integer have more figures than a float
        return str(float(value)) if isinstance(value, float) else str(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} is {shown(value)}; a number, a string or None is needed", "answers") from None


def _keys(value: Any, name: str) -> list[str]:
    """Returns overrides of keys of a scene, `key=value` each."""
    if not isinstance(value, Mapping):
        raise InputError(f"{name} is {shown(value)}; a dict of keys is needed, as in {{'motion.d': 0.3}}")
    found = []
    for key, item in value.items():
        if not isinstance(key, str):
            raise InputError(f"{name}: the key {shown(key)} is not a string")
        if "=" in key or not key.strip():
            raise InputError(f"{name}: {shown(key)} is not a key of a scene, such as 'motion.d'")
        key = checked(str.__str__(key), f"{name}: the key {shown(key)}")
        found.append(f"{key}={to_value(item, f'{name}[{shown(key)}]')}")
    return found


def _texts(value: Any, name: str) -> list[str]:
    if isinstance(value, str):
        return [text(value, name)]
    if isinstance(value, (bytes, Mapping)):
        raise InputError(f"{name} is {shown(value)}; a string or a list of strings is needed")
    items = listed(value, name, "a string or a list of strings")
    return [text(item, f"{name}[{place}]") for place, item in enumerate(items)]


def _tolerances(value: Any, name: str) -> str:
    if isinstance(value, (str, bytes, Mapping)):
        raise InputError(f"{name} is {shown(value)}; a list of numbers is needed")
    items = listed(value, name, "a list of numbers")
    if not items:
        raise InputError(f"{name} is empty; a list of numbers is needed")
    return ",".join(_plain(number(item, f"{name}[{place}]")) for place, item in enumerate(items))


def _plain(value: float) -> str:
    """Returns all figures of a number, a whole one without a fraction."""
    return repr(value).removesuffix(".0")


NEEDS = ("digits", "error", "solved", "proved", "task")
"""The keys of the `advise` of `trade`."""


def _need(value: Any, name: str) -> str:
    if isinstance(value, str):
        return text(value, name)
    if not isinstance(value, Mapping) or not value:
        raise InputError(f"{name} is {shown(value)}; a dict is needed, as in {{'digits': 8, 'task': 'orbit'}}")
    parts = []
    for key, item in value.items():
        own = f"{name}[{shown(key)}]"
        known(key, NEEDS, name)
        if key == "proved":
            parts.append(f"{key}={str(flag(item, own)).lower()}")
        elif key == "task":
            task = text(item, own)
            if "," in task:
                raise InputError(f"{own} is {shown(task)}; the name of one task is needed")
            parts.append(f"{key}={task}")
        else:
            parts.append(f"{key}={_plain(number(item, own))}")
    return ",".join(parts)


def known(key: Any, names: Iterable[str], name: str) -> None:
    """Raises an `InputError` if the key is none of the names."""
    names = list(names)
    if isinstance(key, str) and key in names:
        return
    close = difflib.get_close_matches(key, names, 1) if isinstance(key, str) else []
    meant = f"did you mean {close[0]!r}?" if close else f"the keys are {', '.join(map(repr, names))}"
    raise InputError(f"{name}: unknown key {shown(key)}; {meant}")


ROW = ("id", "place", "scene", "set", "quantity", "printed", "unit", "expected", "rests_on", "note")
"""The keys of a row of golden values."""


def row(value: Any, name: str) -> list[str]:
    """Returns the arguments of `check` for a row of golden values."""
    if not isinstance(value, Mapping):
        raise InputError(f"{name} is {shown(value)}; a dict is needed, with the keys {', '.join(ROW)}")
    for key in value:
        known(key, ROW, name)
    arguments = []
    for key in ROW:
        item, own = value.get(key), f"{name}[{key!r}]"
        if item is None:
            if key in ("id", "place", "printed"):
                raise InputError(f"{own} is missing; 'id', 'place' and 'printed' are needed")
            continue
        if key == "set":
            arguments += [f"--set={part}" for part in _setting(item, own)]
            continue
        if key == "scene":
            if isinstance(item, Mapping) or isinstance(item, str) and "\n" in item:
                raise InputError(f"{own} is {shown(item)}; the name of a built-in scene or a path is needed")
            item = path(item, own)
        elif key == "printed":
            item = _printed(item, own)
        option = "add" if key == "id" else key.replace("_", "-")
        arguments.append(f"--{option}={text(item, own, can_be_empty=True)}")
    return arguments


def _printed(value: Any, name: str) -> Any:
    if isinstance(value, float):
        message = f"{name} is {shown(value)}; give it as a string with every figure that is printed, as in '0.8320'"
        raise InputError(message)
    # of a Decimal and an integer every figure is known
    is_exact = is_number(value) and not isinstance(value, bool) and not hasattr(value, "dtype")
    return to_value(value, name) if is_exact else value


def _setting(value: Any, name: str) -> list[str]:
    """Returns overrides of keys of a scene, and conditions on the row of the answer."""
    if isinstance(value, str):
        return [text(value, name, can_be_empty=True)]
    if not isinstance(value, Mapping):
        example = "{'motion.d': 0.4, 'row.word': 'BT'}"
        raise InputError(f"{name} is {shown(value)}; a dict is needed, as in {example}")
    parts = []
    for key, item in value.items():
        if isinstance(key, str) and key.startswith("row.") and isinstance(item, str):
            own = f"{name}[{shown(key)}]"
            if any(mark in item for mark in ";'\"\n"):
                raise InputError(f"{own} is {shown(item)}; a word or a number is needed, without quotes")
            parts.append(f"{checked(key, name)}={text(item, own)}")
        else:
            parts += _keys({key: item}, name)
    return parts


OPTIONS: dict[str, Callable[[Any, str], Any]] = {
    **dict.fromkeys(("digits", "effort", "impacts", "last", "samples"), count),
    **dict.fromkeys(("gap", "limit", "search", "until"), number),
    **dict.fromkeys(("attractors", "curve", "problems", "proved", "repair", "strict", "summary"), flag),
    **dict.fromkeys(("baseline", "directory", "frozen"), path),
    **dict.fromkeys(("exec", "label", "method", "number"), text),
    **dict.fromkeys(("kind", "level"), _texts),
    "add": row,
    "advise": _need,
    "answers": flag,
    "set": _keys,
    "tolerances": _tolerances,
}
"""How the value of each option is read, by its name in Python."""

_COMMAND_LINE = {"label": "explain", "directory": "out", "answers": "without-answers"}
"""Options that have another name on the command line."""


def options(values: Mapping[str, Any]) -> list[str]:
    """Returns the arguments of a command line for options; None is an option that is not given."""
    arguments: list[str] = []
    for name, value in values.items():
        if value is None:
            continue
        found = OPTIONS[name](value, name)
        option = _COMMAND_LINE.get(name, name)
        if name == "add":
            arguments += found
        elif isinstance(found, bool):
            # answers are left out where they are not wanted
            arguments += [f"--{option}"] if found is not (name == "answers") else []
        elif isinstance(found, list):
            arguments += [f"--{option}={item}" for item in found]
        else:
            arguments.append(f"--{option}={_plain(found) if isinstance(found, float) else found}")
    return arguments
