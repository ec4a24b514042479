"""Trajectories, measurements, runs, descriptions of columns, and rows of golden values."""

import csv
import decimal

import numpy as np
import pytest
import vibro_audit as va

SCENE = {"motion": {"g": 0.122, "d": 0.4, "r_b": 0.5, "r_t": 0.5}, "start": {"phase": 6.18, "velocity": 0.5293}}
ROW = {
    "id": "bottom",
    "place": "Table 2",
    "printed": "0.83272",
    "scene": "fig02",
    "set": {"motion.d": 0.4, "row.stable": True},
    "quantity": "orbits.velocities[0]",
}


def test_a_trajectory_meets_the_impacts_of_the_simulation():
    found = va.trajectory(SCENE, samples=101, until=4)
    time, z = np.asarray(found["time"]), np.asarray(found["z"])
    assert np.allclose(time, np.linspace(0, 4, 101)) and np.abs(z).max() <= 0.2 + 1e-12
    assert np.allclose(np.asarray(found["capsule"]) - np.asarray(found["ball"]), z)
    events = va.simulate(SCENE, impacts=3)
    ends = va.trajectory(SCENE, samples=2, impacts=3)
    assert ends["time"][1] == pytest.approx(events["time"][2])
    assert abs(ends["z"][1]) == pytest.approx(0.2)
    assert va.trajectory("fig02").rows == 1001


def test_methods_of_a_task_are_listed_and_one_is_advised():
    found = va.trade("multipliers", number="f64", problems=True)
    assert {*found["number"]} == {"f64"} and {*found["method"]} == {"printed", "stable"}
    one = va.trade("multipliers", method="stable", number="f64")
    assert {*one["method"]} == {"stable"} and min(one["seconds"]) > 0 and one.notes
    for need in ({"digits": 8, "task": "multipliers"}, "digits=8,task=multipliers"):
        advice = va.trade(advise=need)
        assert {*advice["rank"]} == {"cheapest", "runner-up"} and advice.as_expected
    assert not va.trade(advise={"digits": 100, "task": "multipliers"}).as_expected


def test_digits_at_extremes_are_counted(tmp_path):
    found = va.stress("Delta near 0")
    assert found.as_expected and {*found["case"]} == {"Delta near 0"} and min(found["digits"]) >= 0
    assert {"extreme", "distance"} <= {*va.stress("Delta to 0", curve=True)}
    (tmp_path / "none.csv").write_text("nonsense\n")
    with pytest.raises(va.InputError, match="frozen points, line 1"):
        va.stress(frozen=tmp_path / "none.csv")


def test_a_run_writes_the_files_that_it_names(tmp_path):
    scene = {**SCENE, "want": ["orbits", "impacts"], "words": ["BT"]}
    found = va.run(scene, tmp_path / "out", digits=12)
    assert found["command"] == ["orbits", "simulate"]
    for file, rows in zip(found["file"], found["rows"]):
        with open(file, newline="") as lines:
            assert len(list(csv.DictReader(lines))) == rows
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"orbits.csv", "simulate.csv"}


def test_a_plan_computes_nothing_and_names_functions():
    plan = va.plan("fig03", set={"motion.d": 0.3})
    assert "`sweep`" in plan and "motion.d = 0.3" in plan and "vibro-audit " not in plan


@pytest.mark.parametrize(
    ("command", "table"),
    [
        ("orbits", lambda: va.orbits(SCENE)),
        ("simulate", lambda: va.simulate(SCENE, impacts=2)),
        ("trajectory", lambda: va.trajectory(SCENE, samples=2)),
        ("trade --problems", lambda: va.trade("multipliers", number="f64", problems=True)),
        ("stress", lambda: va.stress("Delta near 0")),
        ("stress --curve", lambda: va.stress("Delta to 0", curve=True)),
    ],
)
def test_every_column_is_described(command, table):
    described = va.columns(command)
    assert {*table()} <= {*described["column"]} and all(described["meaning"])
    assert {*described["command"]} == {command}


def test_a_row_of_golden_values_is_added(tmp_path):
    golden = tmp_path / "golden"
    added = va.check(golden, add=ROW)
    assert added["verdict"] == ["reproduced"] and added.as_expected and "printed.csv" in added.notes[-1]
    # a float has lost the figures that are printed; a Decimal has them
    other = {**ROW, "id": "other", "printed": decimal.Decimal("0.83272"), "unit": "1", "note": 'a, "b"'}
    assert va.check(golden, add=other)["verdict"] == ["reproduced"]
    word = {"row.word": "BT", "row.stable": True, "motion.d": 0.4}
    assert va.check(golden, add={**ROW, "id": "word", "set": word})["verdict"] == ["reproduced"]
    assert va.check(golden)["id"] == ["bottom", "other", "word"]


def test_a_row_that_is_not_as_expected_is_not_added(tmp_path):
    wrong = {**ROW, "id": "b", "printed": "0.84272"}
    refused = va.check(tmp_path, add=wrong)
    assert not refused.as_expected and "add['expected'] = 'wrong'" in refused.notes[-1]
    assert not (tmp_path / "printed.csv").exists()
    assert va.check(tmp_path, add={**wrong, "expected": "wrong"}).as_expected
    assert va.check(tmp_path).rows == 1


def test_a_directory_that_was_checked_takes_another_row(tmp_path):
    va.check(tmp_path, add=ROW)
    assert va.check(tmp_path).rows == 1
    assert va.check(tmp_path, add={**ROW, "id": "other"}).as_expected
    assert va.check(tmp_path).rows == 2


def test_a_scene_of_a_row_is_copied(tmp_path):
    (tmp_path / "mine.toml").write_text(va.to_toml(SCENE))
    printed = f"{va.orbits(SCENE)['velocities'][0][0]:.5f}"
    row = {**ROW, "scene": tmp_path / "mine.toml", "printed": printed, "set": {"row.stable": True}}
    assert va.check(tmp_path / "golden", add=row)["verdict"] == ["reproduced"]
    assert (tmp_path / "golden" / "scenes" / "mine.toml").exists()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"placed": "x"}, "add: unknown key 'placed'; did you mean 'place'?"),
        ({"id": None}, "add['id'] is missing; 'id', 'place' and 'printed' are needed"),
        ({"printed": 0.83272}, "add['printed'] is 0.83272; give it as a string with every figure"),
        ({"scene": SCENE}, "add['scene'] is {"),
        ({"set": {"row.word": "BT;x"}}, "add['set']['row.word'] is 'BT;x'; a word or a number is needed"),
        ({"set": {"motion.zeta": 1}}, "set['motion.zeta'] = 1: there is no key motion.zeta"),
        ({"set": 3}, "add['set'] is 3; a dict is needed"),
        ({"expected": "fine"}, "`fine` is no verdict to expect"),
        ({"quantity": None}, "add, column `quantity`: it is empty"),
    ],
)
def test_a_row_that_cannot_be_added_is_refused(change, words, tmp_path):
    with pytest.raises(va.InputError) as raised:
        va.check(tmp_path / "golden", add={**ROW, **change})
    assert words in str(raised.value), raised.value
    assert not (tmp_path / "golden" / "printed.csv").exists()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: va.orbits(SCENE, digits=0), "digits is 0; a whole number from 1 to 10000 is needed"),
        (lambda: va.trajectory(SCENE, samples=10**12), "samples is 1000000000000; a whole number from 1 to 10000000"),
        (lambda: va.trajectory(SCENE, until=3, impacts=3), "until and impacts exclude each other"),
        (lambda: va.simulate(SCENE, until=-1), "until is -1; a finite number, at least 0"),
        (lambda: va.optimise("fig03", gap=2), "gap is 2; a number above 0 and below 1 is needed, as in 1e-3"),
        (lambda: va.trade("none"), "task is 'none'; choose dp, multipliers"),
        (lambda: va.trade("multipliers", method="none"), "`trade` lists those there are"),
        (lambda: va.trade(advise={"digit": 8}), "advise: unknown key 'digit'; did you mean 'digits'?"),
        (lambda: va.stress("x", search=1), "search and case exclude each other"),
        (lambda: va.stress(search=0), "search is 0; it must be above 0 and at most 86400"),
        (lambda: va.columns("none"), "command is 'none'; choose audit"),
        (lambda: va.problems(kind="none"), "kind is 'none'; choose orbit"),
        (lambda: va.score(exec="exit 3", kind="impact", level="easy"), "`exit 3` ended with"),
        (lambda: va.score("x.csv", exec="true"), "exec and answers exclude each other"),
        (lambda: va.check("/nonexistent"), "`check(DIR, add={...})` makes one"),
        (lambda: va.orbits("fig02", set={"motion.d": -1}), "set['motion.d'] = -1: motion.d is -1, must be above 0"),
        (lambda: va.orbits("fig02", set={"motion": 1}), "write set={'motion.d': 0.3}"),
        (lambda: va.orbits("fig02", strict="yes"), "strict is 'yes'; True or False is needed"),
        (lambda: va.orbits("\ud800"), "scene contains '\\ud800' at index 0: a lone surrogate"),
        (lambda: va.run("fig02", "a\0b"), "directory is 'a\\x00b'; it contains a null character"),
    ],
)
def test_messages_name_the_arguments_of_python(call, words):
    with pytest.raises(va.InputError) as raised:
        call()
    assert words in str(raised.value), raised.value


def test_notes_name_the_arguments_of_python():
    notes = va.sweep("fig03", set={"sweep.points": 2, "sweep.impacts": 80, "digits": 30}).notes
    assert notes == ["a sweep runs in f64: 15 digits at most; `summary` says how many hold"]


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        ("invalid value '0' for '--digits <N>': 0 is not in 1..=9", "digits is 0; a whole number from 1 to 9 is needed"),
        ("invalid value 'a' for '[TASK]'\n  [possible values: b, c]", "task is 'a'; choose b, c"),
        ("the argument '[TASK]' cannot be used with '--advise <NEED>'", "task and advise exclude each other"),
        ("`trade --format csv` lists those", "`trade` lists those"),
        ("`orbits --digits 8` takes newton", "`orbits(digits=8)` takes newton"),
        ("`vibro-audit sweep` and `check DIR --bless`", "`sweep` and `vibro-audit check DIR --bless`"),
        ("several are a list: --set 'words=[\"BT\", \"T\"]'", "several are a list: set={'words': [\"BT\", \"T\"]}"),
        ("$a--b$ and x --setting", "$a--b$ and x --setting"),
        ("a bell \x07 and \u202e", "a bell \\x07 and \\u202e"),
    ],
)
def test_messages_are_translated(message, expected):
    from vibro_audit._messages import in_python

    assert in_python(message, "trade") == expected
