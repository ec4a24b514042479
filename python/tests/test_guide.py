"""The examples of the guide run as they stand, one after the other; the crates are those of the command."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("page", ["doc/python.md"])
def test_the_examples_run(page):
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), re.M | re.S)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, page, "exec"), names)


def test_the_crates_are_those_of_the_command():
    def versions(lock):
        packages = tomllib.loads((ROOT / lock).read_text(encoding="utf-8"))["package"]
        return {(package["name"], package["version"]) for package in packages}

    own, of_command = versions("python/Cargo.lock"), versions("Cargo.lock")
    shared = {name for name, _ in of_command}
    assert len(shared) > 50 and {crate for crate in own if crate[0] in shared} <= of_command
