"""Every public name has a numpydoc docstring, and the examples in docstrings run as they stand."""

import doctest
import importlib
import inspect
import sys

import pytest
import vibro_audit as va

MODULES = ("vibro_audit", "vibro_audit._errors", "vibro_audit._table", "vibro_audit._toml")


@pytest.mark.parametrize("module", MODULES)
def test_the_examples_of_docstrings_run(module):
    found = doctest.testmod(importlib.import_module(module), extraglobs={"va": va})
    assert found.attempted and not found.failed


def public():
    for name in va.__all__:
        own = getattr(va, name)
        yield name, own
        if inspect.isclass(own):
            methods = inspect.getmembers(own, inspect.isfunction)
            yield from (
                (f"{name}.{key}", method)
                for key, method in methods
                if not key.startswith("_") and method.__module__.startswith("vibro_audit")
            )


@pytest.mark.parametrize(("name", "own"), list(public()), ids=lambda part: part if isinstance(part, str) else "")
def test_a_docstring_names_every_parameter(name, own):
    lines = inspect.getdoc(own).splitlines()
    assert lines[0].endswith((".", ":")) or lines[1:2] != [""], lines[0]
    assert "Examples" in lines
    is_function = inspect.isfunction(own)
    if is_function:
        assert "Returns" in lines or "Raises" in lines
    given = [] if name == "NextImpact" else inspect.signature(own).parameters.values()
    named = {part.strip() for line in lines if " : " in line for part in line.partition(" : ")[0].split(",")}
    kinds = (inspect.Parameter.VAR_KEYWORD, inspect.Parameter.VAR_POSITIONAL)
    missing = {own.name for own in given if own.kind not in kinds} - named - {"self"}
    assert not missing, missing


def test_no_line_of_the_sources_is_long():
    for module in [*MODULES, "vibro_audit._arguments", "vibro_audit._messages"]:
        importlib.import_module(module)
        source = inspect.getsource(sys.modules[module])
        assert max(map(len, source.splitlines())) <= 120, module
