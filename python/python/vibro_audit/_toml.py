"""Conversion of a dict to TOML, as which scenes and sheets that are dicts reach the library."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from decimal import Decimal
from typing import Any

from ._errors import InputError, as_input_errors, check_text, shown

_DEEPEST = 32
"""Levels of dicts and lists. The deepest key of a scene has 4."""

_MOST_ITEMS = 1_000_000
"""Items of a list. A text of so many is longer than what the library reads."""


def to_toml(given: Mapping[str, Any], name: str = "dict") -> str:
    """The TOML text of a scene or sheet that is a dict.

    A dict in it is a section, a list of dicts an array of sections (`equation`). Numbers are written exactly as Python
    prints them; a `decimal.Decimal` keeps all its figures. Places in errors refer to this text.

    Parameters
    ----------
    given : dict
        The scene or sheet. Its keys are strings; its values are numbers, also those of numpy, strings, bools, lists,
        tuples, arrays and dicts, at most 32 levels deep.
    name : str, optional
        The name of the dict in errors.

    Returns
    -------
    str
        The text, one key per line.

    Raises
    ------
    InputError
        A key is not a string, a value has no form in TOML, or the dict is nested too deeply or contains itself.

    Examples
    --------
    >>> print(va.to_toml({"words": ["BT"], "motion": {"d": 0.26}}))
    words = ["BT"]
    [motion]
    d = 0.26
    """
    if not isinstance(given, Mapping):
        raise InputError(f"{name} is {shown(given)}; a dict is needed", name)
    top: list[str] = []
    sections: list[str] = []
    with as_input_errors(name):
        for key, value in given.items():
            path = f"{name}[{shown(key)}]"
            if isinstance(value, Mapping):
                sections += [f"[{_key(key, name)}]", *_lines(value, path)]
            elif isinstance(value, (list, tuple)) and value and all(isinstance(item, Mapping) for item in value):
                for place, item in enumerate(value):
                    sections += [f"[[{_key(key, name)}]]", *_lines(item, f"{path}[{place}]")]
            else:
                top.append(f"{_key(key, name)} = {to_value(value, path)}")
        return "\n".join(top + sections)


def _lines(section: Mapping[str, Any], path: str) -> Iterator[str]:
    for key, value in section.items():
        yield f"{_key(key, path)} = {to_value(value, f'{path}[{shown(key)}]')}"


def _key(key: object, path: str) -> str:
    if not isinstance(key, str):
        raise InputError(f"{path}: the key {shown(key)} is not a string", path)
    plain = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return str.__str__(key) if plain else _text(key, f"{path}: the key {shown(key)}")


def _text(text: str, path: str) -> str:
    # an enumeration of strings has a `str` of its own
    text = check_text(str.__str__(text), path)
    # TeX is easier to find again as it was typed
    if "\\" in text and "'" not in text and text.isprintable():
        return f"'{text}'"
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def to_value(value: Any, path: str, depth: int = 0) -> str:
    """Returns one value as TOML.

    Parameters
    ----------
    value : object
        The value.
    path : str
        Its name in errors.
    depth : int, optional
        The number of dicts and lists around it.

    Raises
    ------
    InputError
        The value has no form in TOML, or is nested too deeply.
    """
    if depth > _DEEPEST:
        name = path.partition("[")[0]
        raise InputError(f"{name} is nested more than {_DEEPEST} levels deep, or contains itself", name)
    is_value = not isinstance(value, type)
    if is_value and hasattr(value, "item") and getattr(value, "shape", None) == ():
        value = value.item()  # a number of numpy
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int):
        try:
            return int.__repr__(value)
        except ValueError:
            raise InputError(f"{path} is {shown(value)}, an integer that is too large", path) from None
    if isinstance(value, Decimal):
        return str(value).lower()
    if isinstance(value, float):
        return float.__repr__(value)
    if isinstance(value, str):
        return _text(value, path)
    if isinstance(value, Mapping):
        pairs = (
            f"{_key(key, path)} = {to_value(item, f'{path}[{shown(key)}]', depth + 1)}" for key, item in value.items()
        )
        return "{ " + ", ".join(pairs) + " }"
    size = getattr(value, "size", None) if is_value else None
    if isinstance(value, (list, tuple)):
        size = len(value)
    if isinstance(size, int) and size > _MOST_ITEMS:
        raise InputError(f"{path} has {size} items; at most {_MOST_ITEMS} are possible", path)
    if is_value and hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        items = (to_value(item, f"{path}[{place}]", depth + 1) for place, item in enumerate(value))
        return "[" + ", ".join(items) + "]"
    raise InputError(f"{path} is {shown(value)}; a number, a string, a bool, a list or a dict is needed", path)
