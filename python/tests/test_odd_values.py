"""Whatever a function is called with, an InputError comes out or a result; no message speaks of a command line."""

import datetime
import decimal
import fractions
import re

import numpy as np
import pandas as pd
import pytest
import vibro_audit as va

SCENE = {"motion": {"g": 0.122, "d": 0.4, "r_b": 0.5, "r_t": 0.5}, "start": {"phase": 6.18, "velocity": 0.5293}}
SHEET = {"equation": [{"label": "a", "role": "claim", "tex": "1 = 1"}]}
MOTION = {"g": 0.122, "d": 0.4, "r_b": 0.5, "r_t": 0.5}
ROW = {"id": "a", "place": "p. 1", "printed": "0.83", "scene": "fig02", "quantity": "orbits.velocities[0]"}
GRID = {"from": 0, "to": 6, "points": 2}
BASINS = {"impacts": 50, "phase": GRID, "velocity": {"from": 0, "to": 1, "points": 2}}
MAP = {
    "impacts": 50,
    "x": {"over": "d", "from": 0.1, "to": 0.5, "points": 2},
    "y": {"over": "r_b", "from": 0.3, "to": 0.9, "points": 2},
}
BOX = {"d": [0.2, 0.21], "r_b": [0.5, 0.51], "r_t": [0.5, 0.51]}


def _self_containing():
    own = {}
    own["a"] = own
    listed = []
    listed.append(listed)
    return [own, {"a": listed}, listed]


def _deep():
    deep = []
    for _ in range(100_000):
        deep = [deep]
    return [deep, {"a": deep}, {"a": {"b": deep}}]


ODD = {
    "numbers": [-1, 0, 3, 2**63, 2**64, 10**18, 10**400, 10**5000, -0.5, 0.5, 1e300, float("nan"), float("inf"), 1j],
    "exact": [decimal.Decimal("NaN"), decimal.Decimal("sNaN"), decimal.Decimal("1e999999"), fractions.Fraction(1, 3)],
    "flags": [True, False, np.True_, None, ..., NotImplemented],
    "texts": ["", " ", "x", "1", "a\nb", "\0", "x\0y", "\ud800", "x\udcff", "\ud800\n", "--help", "-", "é", "a" * 10_000],
    "bytes": [b"", b"x", b"\0", b"\xff\xfe", bytearray(b"x"), memoryview(b"xy"), memoryview(bytearray(16)).cast("d")],
    "lists": [[], [1], ["x"], ["\ud800"], ["\0"], [None], [[1], [1, 2]], (), ("a", 1), range(3), range(10**12)],
    "sets": [{1}, {"x"}, frozenset(), frozenset([1.5]), {"a": 1}.keys(), {"a": 1}.items()],
    "dicts": [{}, {1: 2}, {None: None}, {"a": 1}, {"\ud800": 1}, {"a": "\ud800"}, {"a": {1: 2}}, {"a": {1}}, {"": 1}],
    "keys": [{"motion": {"d": 10**5000}}, {"motion.d": b"x"}, {("a",): 1}, {"a=b": 1}, {"a\n": 1}, {"a\0": "\0"}],
    "arrays": [np.int64(3), np.float32(0.5), np.complex64(1j), np.array("a"), np.array([1j]), np.array([0.5, 0.6])],
    "shapes": [np.zeros((0,)), np.zeros((2, 2)), np.array(1.0), np.array(None), np.array([[1], None], dtype=object)],
    "huge": [np.broadcast_to(1.0, 10**12), np.broadcast_to(np.float32(1), (10**9,)), np.broadcast_to("x", 10**10)],
    "times": [np.datetime64("2020"), np.timedelta64(1), datetime.date(2020, 1, 1), pd.NaT, pd.Timestamp(0)],
    "masked": [np.ma.masked, np.ma.masked_array([1.0, 2.0], [0, 1]), pd.NA],
    "frames": [pd.Series([1.0, None]), pd.Series(["a"]), pd.Series([1, None], dtype="Int64"), pd.DataFrame({"a": [1]})],
    "objects": [object(), object, float, dict, len, lambda: 1, re.compile("a"), pytest, slice(1), type("A", (), {})()],
    "recursive": _self_containing(),
    "deep": _deep(),
}

CALLS = {
    "audit": [
        lambda odd: va.audit(SHEET if odd is None else odd),
        lambda odd: va.audit(SHEET, baseline=odd),
        lambda odd: va.audit(SHEET, repair=odd),
        lambda odd: va.audit(SHEET, effort=odd),
        lambda odd: va.audit({"equation": odd}),
        lambda odd: va.audit({"equation": [{"label": odd, "role": "claim", "tex": "1 = 1"}]}),
    ],
    "explain": [lambda odd: va.explain(SHEET if odd is None else odd, "a"), lambda odd: va.explain(SHEET, odd)],
    "check": [
        lambda odd: va.check(odd, add={}),
        lambda odd: va.check("/dev/null", add=odd),
        lambda odd: va.check("/dev/null/x", add={**ROW, "set": odd}),
        lambda odd: va.check("/dev/null/x", add={**ROW, "scene": odd}),
        lambda odd: va.check("/dev/null/x", add={**ROW, "printed": odd}),
        lambda odd: va.check("/dev/null/x", add={**ROW, "note": odd}),
    ],
    "orbits": [
        lambda odd: va.orbits(odd),
        lambda odd: va.orbits(SCENE, set=odd),
        lambda odd: va.orbits(SCENE, set={"motion.d": odd}),
        lambda odd: va.orbits({"motion": {**MOTION, "d": odd}}),
        lambda odd: va.orbits({**SCENE, "title": odd}),
        lambda odd: va.orbits(SCENE, strict=odd),
        lambda odd: va.orbits(SCENE, digits=odd),
    ],
    "branch": [lambda odd: va.branch(odd), lambda odd: va.branch(SCENE, digits=odd)],
    "simulate": [
        lambda odd: va.simulate(SCENE, last=odd),
        lambda odd: va.simulate(SCENE, proved=odd, impacts=2),
        lambda odd: va.simulate(odd, impacts=2),
    ],
    "trajectory": [
        lambda odd: va.trajectory(SCENE, samples=odd, until=1),
        lambda odd: va.trajectory(odd, samples=2),
        lambda odd: va.trajectory(SCENE, impacts=odd, until=1),
        lambda odd: va.trajectory(SCENE, digits=odd, samples=2, until=1),
    ],
    "sweep": [
        lambda odd: va.sweep("fig03", set={"sweep.points": 2, "sweep.impacts": 20, "sweep.keep": 2}, summary=odd),
        lambda odd: va.sweep("fig03", set=odd) if odd is None else va.sweep(odd),
    ],
    "map": [lambda odd: va.map("fig03", set={"map": MAP}, strict=odd), lambda odd: va.map(odd)],
    "basins": [
        lambda odd: va.basins("fig03", set={"basins": BASINS}, attractors=odd),
        lambda odd: va.basins("fig03", set={"basins": odd}),
    ],
    "optimise": [
        lambda odd: va.optimise("fig03", set={"box": BOX}, gap=odd),
        lambda odd: va.optimise("fig03", set={"box": BOX}, effort=odd),
        lambda odd: va.optimise("fig03", set={"box": odd}),
    ],
    "plot": [
        lambda odd: va.plot("fig03", set={"want": odd}),
        lambda odd: va.plot(odd),
    ],
    "run": [lambda odd: va.run(odd, "/dev/null"), lambda odd: va.plan(odd), lambda odd: va.plan("fig02", set=odd)],
    "run into": [lambda odd: va.run({**SCENE, "want": ["orbits"]}, odd)],
    "trade": [
        lambda odd: va.trade("dp" if odd is None else odd, method="none"),
        lambda odd: va.trade("multipliers", method=odd, number="f64", problems=True),
        lambda odd: va.trade("multipliers", number=odd, method="none"),
        lambda odd: va.trade("multipliers", problems=odd, method="none"),
        lambda odd: va.trade("multipliers", method="none", advise=odd),
        lambda odd: va.trade(advise={"digits": odd, "task": "none"}),
        lambda odd: va.trade(advise={"digits": 8, "task": odd, "error": 1}),
        lambda odd: va.trade(advise={"digits": 8, "proved": odd, "task": "none"}),
    ],
    "stress": [
        lambda odd: va.stress(odd, search=1) if odd is not None else None,
        lambda odd: va.stress("none", frozen=odd),
        lambda odd: va.stress("none", curve=odd),
        lambda odd: va.stress("none", search=odd),
    ],
    "columns": [lambda odd: va.columns(odd)],
    "problems": [
        lambda odd: va.problems(kind=["impact", odd], level="easy"),
        lambda odd: va.problems(kind="impact", level=["easy", odd]),
        lambda odd: va.problems(answers=odd, kind="impact", level="easy"),
    ],
    "score": [
        lambda odd: va.score(odd, kind="impact", level="easy"),
        lambda odd: va.score({"problem": odd, "quantity": odd, "answer": odd}, kind="impact", level="easy"),
        lambda odd: va.score({"problem": [odd], "quantity": [odd], "answer": [odd]}, kind="impact", level="easy"),
        lambda odd: va.score(exec="exit 1", kind="impact", level="easy", tolerances=odd),
        lambda odd: va.score(exec="exit 1", kind="impact", level="easy", tolerances=[odd]),
        lambda odd: va.score(exec="exit 1", kind="impact", level="easy", limit=odd),
        lambda odd: va.score(exec="exit 1", kind=["impact", odd], level="easy"),
        lambda odd: va.score(exec="exit 1", kind="impact", level="easy", summary=odd),
    ],
    "next_impact": [
        lambda odd: va.next_impact(odd, 1.0, 0.5, **MOTION),
        lambda odd: va.next_impact([odd], 1.0, 0.5, **MOTION),
        lambda odd: va.next_impact("bottom", odd, 0.5, **MOTION),
        lambda odd: va.next_impact("bottom", [odd, 1.0], 0.5, **MOTION),
        lambda odd: va.next_impact("bottom", 1.0, odd, **MOTION),
        lambda odd: va.next_impact("bottom", 1.0, 0.5, **{**MOTION, "g": odd}),
        lambda odd: va.next_impact("bottom", 1.0, 0.5, **{**MOTION, "d": odd}),
        lambda odd: va.next_impact("bottom", 1.0, 0.5, **{**MOTION, "r_b": odd}),
        lambda odd: va.next_impact("bottom", 1.0, 0.5, **{**MOTION, "r_t": odd}),
        lambda odd: va.next_impact("bottom", 1.0, 0.5, **MOTION, jacobian=odd),
    ],
    "to_toml": [lambda odd: va.to_toml(odd), lambda odd: va.to_toml({"a": odd}), lambda odd: va.to_toml({"a": {"b": odd}})],
}

# names of tables, such as "sweep --summary", stand in quotes
OF_A_SHELL = re.compile(
    r"(?<![\w`'\"-])--[a-z]|--help|<[A-Z]{3,}>|\[[A-Z]{3,}\]|stdin|possible values|\.\.=|target type|invalid value|cannot be used with"
)


def _sweep(call, values):
    for odd in values:
        try:
            call(odd)
        except va.InputError as error:
            message = str(error)
            assert message.replace("\n", "").isprintable(), ascii(message)
            # a message may repeat what was given
            said = re.sub(r'"[^"]*"', "", message.replace("--help", ""))
            assert not OF_A_SHELL.search(said), message


@pytest.mark.parametrize("kind", ODD)
@pytest.mark.parametrize("function", CALLS)
@pytest.mark.filterwarnings("error")
def test_only_input_errors_come_out(function, kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for call in CALLS[function]:
        _sweep(call, ODD[kind])


@pytest.mark.parametrize("function", CALLS)
def test_a_generator_is_read_once_or_refused(function):
    for call in CALLS[function]:
        for items in ([], [1.0], ["x"], ["\ud800"]):
            _sweep(call, [(item for item in items)])


def test_every_function_is_swept():
    functions = {name for name in va.__all__ if callable(getattr(va, name)) and name.islower()}
    swept = {*CALLS} - {"run into"} | {"plan"}
    assert functions == swept


def test_an_endless_generator_is_refused():
    import itertools

    with pytest.raises(va.InputError, match="more than 20000000"):
        va.next_impact("bottom", itertools.count(), 0.5, **MOTION)


@pytest.mark.parametrize("odd", [None, 3, "", "\0", "\ud800", 1.5, ["x"], object])
def test_a_path_that_cannot_be_is_refused(odd):
    with pytest.raises(va.InputError, match="path"):
        va.Figure("<svg/>").save(odd)
