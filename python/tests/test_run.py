"""Runs in this process: the same bytes as the program's, Ctrl-C, progress, settings that are checked."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings as effort, strategies as st

import thinwall as tw
from thinwall import _lab, experiments
from lab_support import PROGRAM, SMALL, small


def test_returns_the_result_and_tells_progress(tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    result = tw.run("thin_wall", out=tmp_path / "run", seed=1, progress=lambda *now: told.append(now), **SMALL)
    assert result.folder == tmp_path / "run" and result.seed == 1
    done, total = zip(*told)
    assert set(total) == {result.manifest["total_trials"]} and list(done) == sorted(done) and done[-1] == total[0]
    cells = result.array("cells")
    assert set(cells["speed"]) == {10, 40} and (cells["shots"] == 200).all()


@pytest.mark.skipif(not PROGRAM.is_file(), reason="the program is not built")
def test_the_bytes_are_the_programs(tmp_path: Path) -> None:
    ours = small(tmp_path / "ours", speed=np.array([10, 40]), thickness=(0.01,)).manifest
    (tmp_path / "config.toml").write_text(experiments.toml({"experiment": "thin_wall", **SMALL}))
    subprocess.run([PROGRAM, "run", "config.toml", "--seed", "1", "--out", "theirs"], cwd=tmp_path, check=True, capture_output=True)
    theirs = json.loads((tmp_path / "theirs/manifest.json").read_bytes())
    assert ours["run_id"] == theirs["run_id"]
    dated = {"cite.bib"}  # by the day
    assert {f: h for f, h in ours["files"].items() if f not in dated} == {f: h for f, h in theirs["files"].items() if f not in dated}
    assert ours["program"]["sha256"] != theirs["program"]["sha256"]
    again = subprocess.run([PROGRAM, "reproduce", "ours"], cwd=tmp_path, capture_output=True, text=True)
    assert again.returncode == 0 and again.stdout.startswith("identical"), again


def test_the_module_is_the_program(tmp_path: Path) -> None:
    import hashlib

    module = hashlib.sha256(Path(str(_lab.__file__)).read_bytes()).hexdigest()
    assert small(tmp_path / "run").manifest["program"]["sha256"] == module


def test_threads_and_time_change_nothing(tmp_path: Path) -> None:
    one, two = small(tmp_path / "one"), tw.run("thin_wall", out=tmp_path / "two", seed=1, threads=1, **SMALL)
    assert one.manifest["files"]["data/cells.csv"] == two.manifest["files"]["data/cells.csv"]
    other = tw.run("thin_wall", out=tmp_path / "other", seed=2, **SMALL)
    assert one.manifest["files"]["data/cells.csv"] != other.manifest["files"]["data/cells.csv"]


def test_the_default_folder_is_that_of_the_call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    first = tw.run("thin_wall", seed=1, **SMALL)
    assert first.folder == Path("results") / f"thin_wall-{first.run_id}"
    written = (first.folder / "manifest.json").stat().st_mtime_ns
    assert tw.run("thin_wall", seed=1, **SMALL).run_id == first.run_id
    assert (first.folder / "manifest.json").stat().st_mtime_ns == written  # nothing was computed
    assert tw.run("thin_wall", seed=2, **SMALL).folder != first.folder


def test_trials_files_text_and_dicts(tmp_path: Path) -> None:
    fewer = tw.run("thin_wall", out=tmp_path / "fewer", trials=np.int64(50), **SMALL)
    assert (fewer.array("cells")["shots"] == 50).all()
    config = {"experiment": "thin_wall", **SMALL}
    (tmp_path / "my.toml").write_text(experiments.toml(config))
    ids = {
        tw.run(tmp_path / "my.toml", out=tmp_path / "a").run_id,
        tw.run(str(tmp_path / "my.toml"), out=tmp_path / "b").run_id,
        tw.run(experiments.toml(config), out=tmp_path / "c").run_id,
        tw.run(config, out=tmp_path / "d").run_id,
        tw.run("thin_wall", out=tmp_path / "e", **SMALL).run_id,
    }
    assert len(ids) == 1


@pytest.mark.parametrize(
    "call, error, said",
    [
        (lambda: tw.run("thin_wal"), ValueError, r"^experiment: 'thin_wal' is unknown; did you mean 'thin_wall'\?"),
        (lambda: tw.run("thin_wall", raduis=1), ValueError, r"^raduis: unknown key; did you mean 'radius'\? \(allowed: angle_deg"),
        (lambda: tw.run("thin_wall", speed=[0]), ValueError, r"^speed: 0 is not allowed; a list of numbers > 0 and <= 1000000000 \[m/s\]"),
        (lambda: tw.run("thin_wall", speed=float("nan")), ValueError, r"^speed: nan"),
        (lambda: tw.run("thin_wall", method="closed_from"), ValueError, r"^method: .*did you mean .*closed_form"),
        (lambda: tw.run("thin_wall", speed=None), TypeError, r"^speed: a NoneType is not allowed"),
        (lambda: tw.run("thin_wall", speed=1j), TypeError, r"^speed: a complex is not allowed"),
        (lambda: tw.run("thin_wall", speed=np.ones((2, 2))), TypeError, r"^speed: an array of shape \(2, 2\)"),
        (lambda: tw.run("thin_wall", shots=2**70), ValueError, r"^shots: \d+ is not allowed"),
        (lambda: tw.run("thin_wall", method="\ud800"), ValueError, r"^method: .*UTF-8"),
        (lambda: tw.run("thin_wall", seed=-1), ValueError, r"^seed: -1 is not allowed; a whole number from 0 to"),
        (lambda: tw.run("thin_wall", seed=1.5), TypeError, r"^seed: 1.5 is not allowed"),
        (lambda: tw.run("thin_wall", seed=True), TypeError, r"^seed: True is not allowed"),
        (lambda: tw.run("thin_wall", trials=0), ValueError, r"^trials: 0 is not allowed; a whole number from 1"),
        (lambda: tw.run("thin_wall", trials=2**62), ValueError, r"^trials: 4611686018427387904 is not allowed; in the place of"),
        (lambda: tw.run("thin_wall", threads=0), ValueError, r"^threads: 0 is not allowed; a whole number from 1 to 4096"),
        (lambda: tw.run("thin_wall", out=""), ValueError, r"^out: '' is not allowed"),
        (lambda: tw.run("thin_wall", out="nul\0x", trials=1), ValueError, r"^out: 'nul\\x00x' is not allowed; a folder"),
        (lambda: tw.run("thin_wall", out=Path("\udcff")), ValueError, r"^out: '\\udcff' is not allowed; a folder"),
        (lambda: tw.run("thin_wall", out=b"bb", trials=1), TypeError, r"^out: b'bb' is not allowed; a folder, as a str or a path"),
        (lambda: tw.run("thin_wall", out=3), TypeError, r"^out: 3 is not allowed"),
        (lambda: tw.run("thin_wall", progress=3), TypeError, r"^progress: 3 is not allowed"),
        (lambda: tw.run("nowhere.toml"), ValueError, r"^nowhere.toml: there is no such file"),
        (lambda: tw.run("a.toml", speed=1), ValueError, r"^speed: settings go with an experiment's name"),
        (lambda: tw.run({"speed": 1}), ValueError, r"^experiment:1: key 'experiment': missing|^experiment: missing"),
        (lambda: tw.run("experiment = \n"), ValueError, r"not TOML"),
        (lambda: tw.run(3), TypeError, r"^experiment: a int is not allowed"),
        (lambda: tw.run("thin_wall", **{"a.b": 1}), ValueError, r"a.b.*unknown key"),
    ],
)
def test_bad_input_is_named(call: Any, error: type[Exception], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error) as raised:
        call()
    assert re.search(said, str(raised.value)), str(raised.value)
    assert "\n" not in str(raised.value) and list(tmp_path.iterdir()) == []


def test_a_folder_that_holds_another_run(tmp_path: Path) -> None:
    small(tmp_path / "run")
    with pytest.raises(ValueError, match=r"^out .*run: holds another run \(seed = 1, not 0\)"):
        tw.run("thin_wall", out=tmp_path / "run", **SMALL)


def test_what_progress_raises_ends_the_run(tmp_path: Path) -> None:
    class Enough(Exception):
        pass

    def enough(done: int, total: int) -> None:
        raise Enough

    with pytest.raises(Enough):
        tw.run("thin_wall", out=tmp_path / "run", seed=1, progress=enough, **SMALL)
    assert small(tmp_path / "run").self_test_passed  # and it can go on


def test_others_run_meanwhile(tmp_path: Path) -> None:
    ticks: list[float] = []
    stop = threading.Event()

    def tick() -> None:
        while not stop.wait(0.01):
            ticks.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    small(tmp_path / "run", shots=100_000)
    seconds = time.perf_counter() - begin
    stop.set()
    thread.join()
    assert len(ticks) > 5 * seconds  # of 100 a second, had it the machine for itself


INTERRUPTED = """
    import os, signal, sys, threading
    import thinwall as tw
    sent = []
    def call(progress=None):
        return tw.run("thin_wall", out="run", seed=1, threads=1, progress=progress, **{settings!r})
    def soon(done, total):
        if done >= {done} and not sent:
            sent.append(done)
            threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    try:
        call(soon)
    except KeyboardInterrupt:
        pass
    else:
        sys.exit("it was not interrupted")
    try:
        tw.read("run")
    except ValueError as error:
        assert "not finished" in str(error), error
    else:
        sys.exit("it is finished")
    {then}
"""


def interrupted(where: Path, settings: dict[str, Any], done: int, then: str) -> str:
    """Presses Ctrl-C soon after `done` trials are."""
    script = textwrap.dedent(INTERRUPTED.format(settings=settings, done=done, then=then))
    ran = subprocess.run([sys.executable, "-c", script], cwd=where, capture_output=True, text=True, timeout=400)
    assert ran.returncode == 0, ran
    return ran.stdout


# Many short units, of which some are finished when Ctrl-C comes, and one that lasts for seconds.
SHORT = {**SMALL, "speed": list(range(10, 2010)), "method": ["bisection"], "shots": 2000}
LONG = {**SMALL, "speed": [10], "method": ["bisection"], "shots": 2_000_000}


def test_ctrl_c_keeps_what_is_finished(tmp_path: Path) -> None:
    count = "print('rows', open('run/journal.tsv').read().count(chr(10)))"
    out = interrupted(tmp_path, SHORT, 1, count)
    rows = int(out.split("rows ")[1])
    assert rows > 1  # beside the identity
    result = tw.run("thin_wall", out=tmp_path / "run", seed=1, **SHORT)
    assert result.manifest["resumed_units"] == rows - 1
    whole = tw.run("thin_wall", out=tmp_path / "whole", seed=1, **SHORT)
    assert whole.manifest["resumed_units"] == 0 and whole.manifest["files"] == result.manifest["files"]


def test_ctrl_c_within_a_long_unit(tmp_path: Path) -> None:
    then = "result = call(); print('resumed', result.manifest['resumed_units'], 'of', result.manifest['units'])"
    out = interrupted(tmp_path, LONG, 0, then)
    assert re.search(r"resumed [1-9]\d* of", out), out  # the unit that was under way was kept


def test_leaving_within_a_long_unit(tmp_path: Path) -> None:
    interrupted(tmp_path, {**LONG, "shots": 4_000_000}, 0, "sys.exit(0)")
    with pytest.raises(ValueError, match="not finished"):  # nor was it, behind the exit
        tw.read(tmp_path / "run")


words = st.text(max_size=8)
scalars = st.one_of(st.integers(), st.floats(), st.booleans(), words, st.none())
anything = st.recursive(scalars, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(words, inner, max_size=3), max_leaves=6)
keys = st.one_of(st.sampled_from(["speed", "step", "radius", "thickness", "method", "shots", "wall", "scalar", "substeps"]), words)


@effort(max_examples=400, deadline=None)
@given(st.dictionaries(keys, anything, min_size=1, max_size=3))
def test_any_settings_are_taken_or_refused(settings: dict[str, Any]) -> None:
    """Nothing is computed: the folder is one that cannot be, so that what is taken is refused for that."""
    try:
        tw.run({"experiment": "thin_wall", **settings}, out="/dev/null/run")
    except (ValueError, TypeError) as error:
        assert "\n" not in str(error) and str(error)
    else:
        raise AssertionError("it ran")


@effort(max_examples=300, deadline=None)
@given(st.dictionaries(words.filter(bool), st.recursive(st.one_of(st.integers(-(2**63), 2**63 - 1), st.floats(allow_nan=False), st.booleans(), words), lambda i: st.lists(i, max_size=3) | st.dictionaries(words, i, max_size=3), max_leaves=6)))
def test_toml_reads_back(settings: dict[str, Any]) -> None:
    tomllib = pytest.importorskip("tomllib")
    try:
        text = experiments.toml(settings)
    except ValueError as error:
        assert "UTF-8" in str(error)
    else:
        assert tomllib.loads(text) == settings


def test_defaults_and_catalog() -> None:
    assert "thin_wall" in experiments.catalog() and experiments.catalog()["thin_wall"].endswith("?")
    assert 'experiment = "thin_wall"' in tw.defaults("thin_wall")
    with pytest.raises(ValueError, match="did you mean 'hitscan'"):
        tw.defaults("hitscam")
