"""A dict as TOML: how scenes and sheets that are dicts reach the library."""

from __future__ import annotations

import json
from collections.abc import Mapping
from decimal import Decimal
from typing import Any

from ._errors import InputError


def to_toml(given: Mapping[str, Any], name: str = "dict") -> str:
    """The TOML of a scene or sheet that is a dict.

    A dict in it is a section, a list of dicts an array of sections (`equation`). Numbers are taken exactly as Python
    prints them; `decimal.Decimal` has as many figures as it is given. The places of errors are those of this text.

    >>> print(to_toml({"words": ["BT"], "motion": {"d": 0.26}}))
    words = ["BT"]
    [motion]
    d = 0.26
    """
    top: list[str] = []
    sections: list[str] = []
    for key, value in given.items():
        path = f"{name}[{key!r}]"
        if isinstance(value, Mapping):
            sections += [f"[{_key(key, name)}]", *_lines(value, path)]
        elif isinstance(value, (list, tuple)) and value and all(isinstance(item, Mapping) for item in value):
            for place, item in enumerate(value):
                sections += [f"[[{_key(key, name)}]]", *_lines(item, f"{path}[{place}]")]
        else:
            top.append(f"{_key(key, name)} = {to_value(value, path)}")
    return "\n".join(top + sections)


def _lines(section: Mapping[str, Any], path: str) -> list[str]:
    return [f"{_key(key, path)} = {to_value(value, f'{path}[{key!r}]')}" for key, value in section.items()]


def _key(key: object, path: str) -> str:
    if not isinstance(key, str):
        raise InputError(f"{path}: the key {key!r} is no string", path)
    plain = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if plain else _text(key)


def _text(text: str) -> str:
    # TeX is easier to find again as it was typed
    if "\\" in text and "'" not in text and text.isprintable():
        return f"'{text}'"
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def to_value(value: Any, path: str) -> str:
    """One value as TOML; `path` is how errors name it."""
    if hasattr(value, "item") and getattr(value, "shape", None) == ():
        value = value.item()  # a number of numpy
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, Decimal)):
        return str(value).lower()
    if isinstance(value, float):
        return float.__repr__(value)
    if isinstance(value, str):
        return _text(str(value))
    if isinstance(value, Mapping):
        pairs = (f"{_key(key, path)} = {to_value(item, f'{path}[{key!r}]')}" for key, item in value.items())
        return "{ " + ", ".join(pairs) + " }"
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(to_value(item, f"{path}[{place}]") for place, item in enumerate(value)) + "]"
    raise InputError(f"{path} is {value!r:.40}; a number, a string, a flag, a list or a dict is needed", path)
