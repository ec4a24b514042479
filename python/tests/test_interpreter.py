"""The interpreter is left alone: its lock, its signals, its threads, its forks, its start."""

import ctypes
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import pytest
import vibro_audit as va

LONG = "import vibro_audit as va; va.simulate('fig03', impacts=10**15, last=1)"
"""Hours of work that needs no memory."""


def long():
    va.simulate("fig03", impacts=10**15, last=1)


@pytest.mark.skipif(os.name != "posix", reason="no SIGINT to send")
def test_ctrl_c_ends_long_work():
    # a program that was started in the background ignores the signal, and so would its children
    hears = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    script = f"{hears}\nprint('begins', flush=True)\ntry:\n    {LONG}\nexcept KeyboardInterrupt:\n    print('ended')"
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout.readline() == "begins\n"
        time.sleep(0.5)
        assert program.poll() is None
        program.send_signal(signal.SIGINT)
        assert program.communicate(timeout=20)[0] == "ended\n"


class Cancelled(Exception):
    pass


def test_other_threads_run_meanwhile_and_may_cancel_it():
    raised = []

    def work():
        try:
            long()
        except Cancelled as error:
            raised.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    began, steps = time.monotonic(), 0
    while time.monotonic() < began + 0.5:
        steps += 1
    assert thread.is_alive() and steps > 1000
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(Cancelled))
    thread.join(timeout=20)
    assert not thread.is_alive() and len(raised) == 1
    assert va.orbits("fig02").rows > 0


def test_threads_ask_at_once_and_each_hears_its_own():
    def ask(number, found):
        d = 0.3 + 0.01 * number
        found[number] = va.orbits("fig02", set={"motion.d": d})["d"][0] - d

    found = [None] * 8
    threads = [threading.Thread(target=ask, args=(number, found)) for number in range(8)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert found == [0.0] * 8


def _verdicts():
    identity = {"label": "a", "role": "claim", "tex": "(x + y)^2 = x^2 + 2 x y + y^2"}
    return va.audit({"symbols": {"parameters": ["x", "y"]}, "equation": [identity]})["verdict"]


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_computes_as_well():
    expected = _verdicts()
    assert expected == ["proved"]
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(_verdicts).get(timeout=60) == expected


def test_import_is_quick_and_needs_nothing_else():
    script = "import time, sys; t = time.perf_counter(); import vibro_audit; print(time.perf_counter() - t, 'numpy' in sys.modules)"
    runs = [subprocess.check_output([sys.executable, "-c", script], text=True).split() for _ in range(5)]
    assert {found for _, found in runs} == {"False"}
    assert min(float(seconds) for seconds, _ in runs) < 0.1
