"""Worlds that are stepped by hand against motion by hand, and against the same scene as the program runs it."""

from __future__ import annotations

import subprocess
import sys
import textwrap
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import thinwall as tw
from lab_support import SOURCE

SCENES = sorted((SOURCE / "experiments/scenes").glob("*.toml"))

PAIR: dict[str, Any] = {
    "scene": "pair",
    "dt": 0.25,
    "body": [
        {"name": "ball", "shape": "sphere", "radius": 0.5, "at": [0, 0, 0], "velocity": [4, 0, 0], "restitution": 1},
        {"name": "wall", "shape": "box", "size": [1, 9, 9], "at": [3, 0, 0], "motion": "static"},
        {"name": "ghost", "shape": "none", "velocity": [0, 1, 0]},
    ],
}


def test_a_ball_meets_a_wall() -> None:
    world = tw.world(PAIR)
    assert (world.name, world.dt, world.time, world.policy, len(world)) == ("pair", 0.25, 0, "event_driven", 3)
    assert world.names.tolist() == ["ball", "wall", "ghost"] and world.shapes.tolist() == ["sphere", "box", "none"]
    assert world.ids.dtype == np.uint32 and world.ids.tolist() == [1, 2, 3]
    assert world.sizes.tolist() == [[1, 1, 1], [1, 9, 9], [0, 0, 0]] and world.is_static.tolist() == [False, True, False]
    assert world.masses.shape == (3,) and world.restitutions.tolist() == [1, 0, 0]
    assert world.energy == pytest.approx(0.5 * 16 + 0.5)
    assert len(world.step()) == 0 and world.positions[0].tolist() == [1, 0, 0]
    assert world.time == 0.25
    events = world.step(steps=2)  # it touches at x = 2, after 0.5 s
    assert events["kind"].tolist()[0] == "begin" and (events["first"][0], events["second"][0]) == (1, 2)
    assert events["time"][0] == pytest.approx(0.5)
    assert world.velocities[0].tolist() == [-4, 0, 0] and world.velocities.dtype == np.float64
    hits = world.hits
    assert hits["normal"][0].tolist() == [1, 0, 0] and hits["point"][0] == pytest.approx([2.5, 0, 0])
    assert "3 bodies" in repr(world) and "pair" in repr(world)


def test_discrete_tunnels() -> None:
    fast = {"scene": "fast", "policy": "discrete", "dt": 0.1, "body": [{**PAIR["body"][0], "velocity": [100, 0, 0]}, PAIR["body"][1]]}
    through, stopped = tw.world(fast), tw.world({**fast, "policy": "event_driven"})
    through.step()
    stopped.step()
    assert through.positions[0, 0] == pytest.approx(10) and stopped.positions[0, 0] < 3


def test_arrays_are_the_callers_own() -> None:
    world = tw.world(PAIR)
    before = world.positions
    before[:] = 7
    assert world.positions[0].tolist() == [0, 0, 0] and world.state_hash == tw.world(PAIR).state_hash
    kept = world.positions
    del world
    assert kept[0].tolist() == [0, 0, 0]


def test_by_hand() -> None:
    world = tw.world(PAIR)
    world.set_velocity("ball", [0, 0, 8])
    world.move(3, np.array([0, 0, 0], dtype=np.int32))
    world.step(0.5)
    assert world.positions[0].tolist() == [0, 0, 4]
    world.remove("wall")
    assert world.names.tolist() == ["ball", "ghost"]
    for call, said in [
        (lambda: world.set_velocity("bal", [0, 0, 0]), r"body: none is called 'bal'; did you mean 'ball'\?"),
        (lambda: world.set_velocity(1, [0, 0]), r"velocity: an array of shape \(2,\)"),
        (lambda: world.set_velocity(1, [0, 0, np.nan]), "velocity"),
        (lambda: world.move(1, "abc"), "by: an array of shape"),
        (lambda: world.remove(99), "99"),
        (lambda: world.step(0), "dt"),
        (lambda: world.step(float("nan")), "dt"),
        (lambda: world.step(10**400), "dt: inf is not allowed; a number > 0 and finite"),
        (lambda: world.step(steps=0), "steps: 0 is not allowed"),
    ]:
        with pytest.raises(ValueError, match=said):
            call()
    masked = np.ma.masked_less([-1.0, 0, 0], 0)
    for call in (
        lambda: world.step("1"), lambda: world.step(True), lambda: world.step(steps=1.5), lambda: world.remove(None),
        lambda: world.set_velocity(1, masked), lambda: world.move(1, masked),
    ):
        with pytest.raises(TypeError, match="is not allowed"):
            call()
    twins = tw.world({"body": [{"name": "twin", "shape": "none"}, {"name": "twin", "shape": "none"}]})
    with pytest.raises(ValueError, match="2 bodies are called 'twin'"):
        twins.remove("twin")


def test_what_leaves_the_world_changes_nothing() -> None:
    world = tw.world({"body": [{"shape": "sphere", "radius": 1, "velocity": [1e30, 0, 0]}]})
    before = world.state_hash
    with pytest.raises(RuntimeError):
        world.step(1e300)
    assert world.state_hash == before and world.time == 0


def test_a_step_that_fails_has_pushed_nothing() -> None:
    push = {"time": 0, "body": "ball"}
    pushes = [{**push, "velocity": [0, 0, 7]}, {**push, "velocity": [0, 0, 8]}]
    world = tw.world({"body": [PAIR["body"][0]], "push": pushes})
    before = world.state_hash
    with pytest.raises(RuntimeError):
        world.step(1e308)
    assert world.state_hash == before and world.velocities[0].tolist() == [4, 0, 0]
    world.step()
    assert world.velocities[0].tolist() == [0, 0, 8]


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_every_scene_goes_as_the_program_has_it(file: Path, tmp_path: Path) -> None:
    steps = 4
    result = tw.run(file, trials=steps, seed=3, out=tmp_path / "run")
    world = tw.world(file, seed=3)
    events = world.step(steps=steps)
    bodies = result.array("bodies")
    np.testing.assert_array_equal(world.ids, bodies["id"])
    kind = world.shapes != "none"
    for axis, name in enumerate("xyz"):
        np.testing.assert_array_equal(world.positions[kind, axis], bodies[name][kind])
    assert (events["kind"] == "begin").sum() == result.array("steps")["begins"].sum()
    assert len(world.hits) == result.array("steps")["hits"].sum()
    assert world.energy == result.array("steps")["energy"][-1]


def test_threads_change_nothing() -> None:
    file = SOURCE / "experiments/scenes/racing_field.toml"
    hashes = set()
    for threads in (1, 2):
        world = tw.world(file, threads=threads)
        world.step(steps=10)
        hashes.add(world.state_hash)
    assert len(hashes) == 1


def test_compare_gives_tables(tmp_path: Path) -> None:
    scene = {**PAIR, "steps": 4, "compare": {"policy": ["discrete", "event_driven"], "dt": [0.25], "repeats": 1}}
    result = tw.compare(scene, out=tmp_path / "out")
    rows = result.array("compare")
    assert result.experiment == "compare" and set(rows["policy"]) == {"discrete", "event_driven"}
    assert (rows["tunneled"] == 0).all() and "timings" in result.tables
    fast = {**scene, "dt": 0.5, "body": [{**PAIR["body"][0], "velocity": [100, 0, 0]}, PAIR["body"][1]]}
    rows = tw.compare(fast, out=tmp_path / "fast").array("compare")
    assert dict(zip(rows["policy"], rows["tunneled"])) == {"discrete": 1, "event_driven": 0}


@pytest.mark.parametrize(
    "scene, error, said",
    [
        ({"bdy": []}, ValueError, r"^bdy: unknown key; did you mean 'body'\?"),
        ({"body": [{"shape": "spere"}]}, ValueError, r"^body.shape: .*did you mean 'sphere'"),
        ({"body": [{"shape": "sphere", "radius": -1}]}, ValueError, r"^body.radius: -1 is not allowed"),
        ({"body": [{"shape": "sphere", "radius": float("nan")}]}, ValueError, r"^body.radius: nan is not allowed"),
        ({"body": 3}, ValueError, r"^body: "),
        ({"dt": 0}, ValueError, r"^dt: 0 is not allowed"),
        ({"body": [{"id": 1, "shape": "none"}, {"id": 1, "shape": "none"}]}, ValueError, "id"),
        ("nowhere.toml", ValueError, r"^nowhere.toml: "),
        ("body = []\nscene\n", ValueError, "not TOML"),
        ("body = []\n", ValueError, "scene"),
        (None, TypeError, r"^scene: a NoneType is not allowed"),
        ({"dt": object()}, TypeError, r"^dt: a object is not allowed"),
    ],
)
def test_bad_scenes_are_named(scene: Any, error: type[Exception], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for call in (tw.world, tw.compare):
        with pytest.raises(error, match=said) as raised:
            call(scene)
        assert "\n" not in str(raised.value)
    assert list(tmp_path.iterdir()) == []


def test_threads_of_python_wait_for_each_other() -> None:
    world = tw.world({**PAIR, "body": PAIR["body"] * 1})
    def step() -> None:
        for _ in range(200):
            world.step(0.001)
            assert world.positions.shape == (3, 3)
    threads = [threading.Thread(target=step) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert world.time == pytest.approx(0.6)


def test_a_signal_handler_may_read_and_step() -> None:
    script = """
        import signal
        import thinwall as tw
        ball = {"shape": "sphere", "radius": 0.5, "velocity": [4, 0, 0], "restitution": 1}
        wall = {"shape": "box", "size": [1, 9, 9], "at": [1.000001, 0, 0], "motion": "static"}
        world = tw.world({"body": [ball, wall]})
        seen = []
        def handle(*of):
            seen.append((world.time, world.positions[0, 0], len(world.events), len(world.step(1e-6))))
        signal.signal(signal.SIGALRM, handle)
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        events = world.step(1e-6, steps=300_000)
        [(time, place, before, within)] = seen
        assert 0 < time < 0.3 and place < 0 and (before, within) == (0, 0), seen
        assert events["kind"].tolist() == ["begin", "end"] == world.events["kind"].tolist() and len(world.hits) == 1
        assert abs(world.time - 0.300001) < 1e-9
        print("whole")
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, timeout=60)
    assert done.stdout == "whole\n", done


def test_ctrl_c_ends_between_steps() -> None:
    script = """
        import os, signal, threading
        import thinwall as tw
        world = tw.world({"body": [{"shape": "sphere", "radius": 1, "velocity": [1, 0, 0]}]})
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        try:
            world.step(1e-9, steps=10**12)
        except KeyboardInterrupt:
            assert 0 < world.time < 500
            world.step()
            print("whole")
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, timeout=60)
    assert done.stdout == "whole\n", done
