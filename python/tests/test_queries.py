"""What NumPy's side of the queries promises: broadcasting, strides, threads, room for answers, options, and errors that say what is allowed."""

import functools
import inspect
import itertools
import os
import pathlib
import re
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import thinwall as tw
from draw import KINDS, PAIRS, moving, ray, shape, turning

SOURCE = pathlib.Path(os.environ["THINWALL_SOURCE"])
ROWS = 2000
S = tw.ToiStatus


def balls_at_boxes(rows=ROWS, dtype=np.float64, seed=1):
    rng = np.random.default_rng(seed)
    return moving("Sphere", rng, rows, dtype), moving("Aabb", rng, rows, dtype)


def bits(answer):
    """All fields, without the gaps between them."""
    if answer.dtype.names is None:
        return answer.tobytes()
    return b"".join(np.ascontiguousarray(answer[name]).tobytes() for name in answer.dtype.names)


QUERIES = {
    "overlaps": lambda a, b, **k: tw.overlaps(a.shape, b.shape, **k),
    "contact": lambda a, b, **k: tw.contact(a.shape, b.shape, **k),
    "separation": lambda a, b, **k: tw.separation(a.shape, b.shape, **k),
    "manifold": lambda a, b, **k: tw.manifold(a.shape, b.shape, **k),
    "raycast": lambda a, b, **k: tw.raycast(tw.Ray(a.shape.center, a.displacement), b.shape, **k),
    "time_of_impact": tw.time_of_impact,
    "times_alone": lambda a, b, **k: tw.time_of_impact(a, b, vectors=False, **k),
    "substeps": lambda a, b, **k: tw.time_of_impact(a, b, "substeps", **k),
    "certified": tw.certified_time_of_impact,
}
each_query = pytest.mark.parametrize("ask", QUERIES.values(), ids=QUERIES)


@each_query
def test_rows_broadcast(ask):
    a, b = balls_at_boxes()
    one = a[7]
    whole = ask(one, b)
    assert whole.shape == (ROWS,)
    repeated = tw.Moving(tw.Sphere(np.tile(one.shape.center, (ROWS, 1)), np.full(ROWS, one.shape.radius)), np.tile(one.displacement, (ROWS, 1)))
    assert bits(whole) == bits(ask(repeated, b)) == bits(ask(a[7:8], b))
    assert ask(a[:1], b[:1]).shape == (1,)
    single = ask(a[7], b[7])
    assert np.ndim(single) == 0 and bits(np.array(single)) == bits(ask(a[7:8], b[7:8]))


@each_query
@pytest.mark.parametrize("rows", [0, 1, 511, 512, 513, 1537])
def test_a_row_is_the_same_in_any_company(ask, rows):
    a, b = balls_at_boxes()
    part = ask(a[:rows], b[:rows])
    assert part.shape == (rows,)
    assert bits(part) == bits(ask(a, b)[:rows])
    assert ask(a[:0], b[0]).shape == (0,) and ask(a[:0], b[:1]).shape == (0,)


@each_query
def test_any_strides_are_read_where_they_lie(ask):
    a, b = balls_at_boxes()
    expected = bits(ask(a, b))

    def laid(array, how):
        if how == "fortran":
            return np.asfortranarray(array)
        if how == "gaps":
            wide = np.full((array.shape[0] * 3, *array.shape[1:]), np.nan)
            wide[1::3] = array
            return wide[1::3]
        if how == "backward":
            return array[::-1].copy()[::-1]
        room = np.empty(array.nbytes + 1, np.uint8)[1:]  # no multiple of 8
        odd = np.frombuffer(room.data, np.float64).reshape(array.shape)
        odd[...] = array
        return odd

    for how in ("fortran", "gaps", "backward", "unaligned"):
        ball = tw.Sphere(laid(a.shape.center, how), laid(a.shape.radius, how))
        box = tw.Aabb(laid(b.shape.center, how), laid(b.shape.half_extents, how))
        moved_a, moved_b = tw.Moving(ball, laid(a.displacement, how)), tw.Moving(box, laid(b.displacement, how))
        assert bits(ask(moved_a, moved_b)) == expected, how


@each_query
def test_threads_change_no_bit(ask):
    a, b = balls_at_boxes(5000)
    assert bits(ask(a, b)) == bits(ask(a, b, threads=2)) == bits(ask(a, b, threads=10**9))


def test_read_only_arrays_are_read():
    a, b = balls_at_boxes()
    expected = bits(tw.time_of_impact(a, b))
    for array in (a.shape.center, a.shape.radius, a.displacement, b.displacement):
        array.flags.writeable = False
    assert bits(tw.time_of_impact(a, b)) == expected


@each_query
def test_a_wrong_row_spoils_no_other(ask):
    a, b = balls_at_boxes()
    well = np.flatnonzero(tw.valid(a) & tw.valid(b))[:500]
    a, b = a[well], b[well]
    before = ask(a, b)
    a.shape.center[100, 1] = np.nan
    a.shape.radius[200] = -1
    after = ask(a, b)
    rest = np.ones(len(well), bool)
    rest[[100, 200]] = False
    assert bits(after[rest]) == bits(before[rest])
    wrong = [100] if ask is QUERIES["raycast"] else [100, 200]  # a ray has no radius
    if after.dtype.names:
        assert np.all(after["status"][wrong] == S.INVALID) and not np.any(after["status"][rest] == S.INVALID)
        for number in ("time", "lower", "distance", "t"):
            assert number not in after.dtype.names or np.all(np.isnan(after[number][wrong]))
    else:
        assert not after[wrong].any()
    assert np.array_equal(np.flatnonzero(~tw.valid(a)), [100, 200])


def test_valid_is_said_of_everything():
    rng = np.random.default_rng(4)
    for kind in KINDS:
        still = shape(kind, rng, 50)
        still_valid = tw.valid(still)
        assert 0 < still_valid.sum() < 50
        way = np.zeros((50, 3))
        way[3] = np.inf
        expected = still_valid & (np.arange(50) != 3)
        assert np.array_equal(tw.valid(tw.Moving(still, way)), expected)
        if kind != "Aabb":
            assert np.array_equal(tw.valid(tw.Turning(still, [0, 0, 0], way)), expected)
    assert np.array_equal(tw.valid(tw.Ray([0, 0, 0], [1, 0, 0], np.array([1.0, 0.0, -1.0, np.nan, np.inf]))), [1, 1, 0, 0, 1])
    skewed = tw.Obb([0, 0, 0], [1, 1, 1], np.array([np.eye(3), np.ones((3, 3))]))
    assert np.array_equal(tw.valid(skewed), [True, False])


def test_statuses_are_those_of_the_library():
    text = (SOURCE / "swept/toi.hpp").read_text()
    names = re.findall(r"^  (\w+),", text[text.index("enum class ToiStatus") : text.index("};")], re.M)
    assert [s.name.lower() for s in tw.ToiStatus] == names
    text = (SOURCE / "swept/certified/certified_toi.hpp").read_text()
    names = re.findall(r"^  (\w+),", text[text.index("enum class DecidedBy") : text.index("};")], re.M)
    assert [s.name.lower() for s in tw.DecidedBy] == names


def test_the_example_of_a_thin_wall():
    bullet = tw.Moving(tw.Sphere([0, 0, 0], 0.5), [10, 0, 0])
    wall = tw.at_rest(tw.Aabb([5, 0, 0], [0.5, 9, 9]))
    answer = tw.time_of_impact(bullet, wall)
    assert (answer["status"], answer["time"]) == (S.HIT, 0.4)
    assert answer["normal"].tolist() == [1, 0, 0] and answer["point"].tolist() == [4.5, 0, 0]
    assert tw.time_of_impact(wall, bullet)["normal"].tolist() == [-1, 0, 0]
    assert tw.time_of_impact(bullet, wall, "end_of_step")["status"] == S.APART  # it tunnels


# ---- Room for answers.


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("vectors", [True, False])
def test_out_takes_the_answers(dtype, vectors):
    a, b = balls_at_boxes(dtype=dtype)
    expected = tw.time_of_impact(a, b, vectors=vectors)
    assert expected["time"].dtype == dtype
    room = np.empty_like(expected)
    assert tw.time_of_impact(a, b, vectors=vectors, out=room) is room
    assert bits(room) == bits(expected)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("turns", [False, True])
def test_times_alone_stay_in_their_room(turns, dtype):
    """By every method: row for row those of the whole answer, and not a byte behind the last."""
    rng = np.random.default_rng(8)
    a, b = (turning if turns else moving)("Sphere", rng, ROWS, dtype), moving("Aabb", rng, ROWS, dtype)
    for method, gap in itertools.product(tw.methods(turning=turns), (0.0, 0.01)):
        ask = functools.partial(tw.time_of_impact, a, b, method, min_separation=gap, threads=2)
        whole = ask()
        room = np.empty(8 * ROWS, tw.time_of_impact(a[:0], b[:0], vectors=False).dtype)
        room.view(np.uint8)[:] = 0xAB
        times = ask(vectors=False, out=room[:ROWS])
        assert np.all(room[ROWS:].view(np.uint8) == 0xAB), method
        by_batch = method == "closed_form" and gap == 0
        assert by_batch or bits(times) == bits(whole[["status", "evaluations", "time"]]), method


def wrong_rooms(a, b):
    right = tw.time_of_impact(a, b)
    locked = right.copy()
    locked.flags.writeable = False
    gaps = np.empty(2 * len(right), right.dtype)[::2]
    return [
        ([], TypeError, "out is list; allowed is an array"),
        (np.empty(len(right)), TypeError, "out is an array of float64; allowed is"),
        (right[:-1], ValueError, r"out has shape \(1999,\); allowed is \(2000,\)"),
        (locked, ValueError, "out is read-only"),
        (gaps, ValueError, "out has strides"),
    ]


@pytest.mark.parametrize("which", range(5))
def test_out_is_refused(which):
    a, b = balls_at_boxes()
    out, error, message = wrong_rooms(a, b)[which]
    with pytest.raises(error, match="time_of_impact: " + message):
        tw.time_of_impact(a, b, out=out)


def test_out_may_not_be_what_is_read():
    room = tw.time_of_impact(*balls_at_boxes(10))
    ball = tw.Sphere(room["normal"], 1.0)  # a view
    with pytest.raises(ValueError, match="out shares memory with what is read"):
        tw.time_of_impact(tw.Moving(ball, [0, 0, 0]), tw.at_rest(ball), out=room)


# ---- Arguments.

A, B = balls_at_boxes(4)
F = balls_at_boxes(4, np.float32)[1]
OTHER = balls_at_boxes(5)[1]
REFUSED = [
    (lambda: tw.overlaps(A, B.shape), TypeError, r"overlaps: a is Moving; allowed is Sphere, Aabb, Obb, Triangle or Capsule; ask about its .shape"),
    (lambda: tw.contact(A.shape, 3), TypeError, r"contact: b is int; allowed is"),
    (lambda: tw.raycast(A.shape, B.shape), TypeError, r"raycast: ray is Sphere; allowed is Ray"),
    (lambda: tw.time_of_impact(A, B.shape), TypeError, r"time_of_impact: b is Aabb; allowed is Moving or Turning; what stands still is at_rest"),
    (lambda: tw.time_of_impact(A, F), TypeError, r"time_of_impact: b holds float32; allowed is float64, as a holds"),
    (lambda: tw.time_of_impact(A, OTHER), ValueError, r"time_of_impact: b has 5 rows; allowed is 4, as a has, or 1"),
    (lambda: tw.time_of_impact(A[:0], OTHER), ValueError, r"b has 5 rows; allowed is 0"),
    (lambda: tw.certified_time_of_impact(F, F), TypeError, r"a holds float32; allowed is float64, for whose"),
    (lambda: tw.time_of_impact(A, B, threads=0), ValueError, r"threads is 0; allowed is a whole number of at least 1"),
    (lambda: tw.overlaps(A.shape, B.shape, threads=-3), ValueError, r"overlaps: threads is -3"),
    (lambda: tw.time_of_impact(A, B, threads=1.5), TypeError, r"threads is float 1.5"),
    (lambda: tw.time_of_impact(A, B, threads=True), TypeError, r"threads is bool"),
    (lambda: tw.time_of_impact(A, B, "closed_from"), ValueError, r"the method is 'closed_from'; did you mean 'closed_form'\?"),
    (lambda: tw.time_of_impact(A, B, "xyz"), ValueError, r"the method is 'xyz'; allowed is end_of_step, substeps,"),
    (lambda: tw.time_of_impact(A, B, 7), ValueError, r"the method is 7; allowed is"),
    (lambda: tw.time_of_impact(A, B, "bisection", tolerence=1e-3), TypeError, r"'bisection' has no option 'tolerence'; did you mean 'tolerance'\?"),
    (lambda: tw.time_of_impact(A, B, tolerance=1e-3), TypeError, r"'closed_form' has no option 'tolerance'; it has min_separation"),
    (lambda: tw.time_of_impact(A, B, "substeps", N=8), TypeError, r"'substeps' has no option 'N'; did you mean 'n'\? It has n, min_separation"),
    (lambda: tw.time_of_impact(A, B, "bisection", tolerance=0.0), ValueError, r"tolerance is 0.0; allowed is \[1\] a number from epsilon, 2.22e-16, to 1"),
    (lambda: tw.time_of_impact(F, F, "bisection", tolerance=1e-9), ValueError, r"from epsilon, 1.19e-07, to 1"),
    (lambda: tw.time_of_impact(A, B, "bisection", tolerance=10**400), ValueError, r"tolerance is inf; allowed is \[1\] a number from epsilon"),
    (lambda: tw.time_of_impact(F, F, "speculative", margin=-(10**400)), ValueError, r"margin is -inf; allowed is \[1\] a finite number"),
    (lambda: tw.time_of_impact(A, B, "bisection", tolerance="x"), TypeError, r"tolerance is str 'x'"),
    (lambda: tw.time_of_impact(A, B, "substeps", n=0), ValueError, r"n is 0; allowed is \[1\] a whole number of at least 1"),
    (lambda: tw.time_of_impact(A, B, "substeps", n=2.0), TypeError, r"n is float 2.0"),
    (lambda: tw.time_of_impact(A, B, "inclusion", max_evaluations=2**31), ValueError, r"max_evaluations is 2147483648"),
    (lambda: tw.time_of_impact(A, B, min_separation=-1.0), ValueError, r"min_separation is -1.0; allowed is \[length\] a finite number"),
    (lambda: tw.time_of_impact(A, B, min_separation=float("nan")), ValueError, r"min_separation is nan"),
    (lambda: tw.time_of_impact(F, F, min_separation=1e300), ValueError, r"min_separation is 1e\+300"),
    (lambda: tw.time_of_impact(A, B, vectors=2), TypeError, r"vectors is int 2"),
    (lambda: tw.overlaps(shape("Triangle", np.random.default_rng(0), 4), B.shape), ValueError, r"Triangle with Aabb is not served"),
    (lambda: tw.valid(3), TypeError, r"valid: shape is int"),
]


@pytest.mark.parametrize("ask, error, message", REFUSED, ids=[r[2][:40] for r in REFUSED])
def test_refuses(ask, error, message):
    with pytest.raises(error, match=message):
        ask()


def test_options_reach_the_method():
    a, b = balls_at_boxes()
    assert np.all(tw.time_of_impact(a, b, "substeps", n=9)["evaluations"] <= 9)
    assert np.any(tw.time_of_impact(a, b, "substeps", n=9)["evaluations"] == 9)
    few = tw.time_of_impact(a, b, "conservative_advancement", max_evaluations=2)
    assert np.any(few["status"] == S.GAVE_UP) and not np.any(tw.time_of_impact(a, b)["status"] == S.GAVE_UP)
    coarse, fine = (tw.time_of_impact(a, b, "bisection", tolerance=t)["evaluations"].mean() for t in (0.1, 1e-12))
    assert coarse < fine
    near = tw.time_of_impact(a, b, "speculative", margin=0.01)["status"] == S.HIT
    assert near.sum() < (tw.time_of_impact(a, b, "speculative")["status"] == S.HIT).sum()
    for method in tw.methods():
        if method not in ("swept_volume_ray", "sweep_then_confirm", "centre_ray"):
            wider = tw.time_of_impact(a, b, method, min_separation=0.5)["status"]
            assert np.isin(wider, (S.HIT, S.OVERLAPPING)).sum() > np.isin(tw.time_of_impact(a, b, method)["status"], (S.HIT, S.OVERLAPPING)).sum()


def test_every_method_and_option_is_written_down():
    text = tw.time_of_impact.__doc__
    for turns in (False, True):
        for options in tw.methods(turning=turns).values():
            assert all(f"        {option} : [" in text for option in options)
    stub = (SOURCE / "python/thinwall/queries.pyi").read_text()
    for name in {**tw.methods(), **tw.methods(turning=True)}:
        assert f'"{name}"' in stub
    page = (SOURCE / "docs/methods.md").read_text()
    assert all(name.title().replace("_", "") in page for name in tw.methods())


def test_docstrings_have_their_sections():
    for name in ("overlaps", "contact", "separation", "manifold", "raycast", "time_of_impact", "certified_time_of_impact", "find_pairs"):
        text = getattr(tw, name).__doc__
        for section in ("Parameters", "Returns", "Raises", "Notes"):
            assert f"    {section}\n    {'-' * len(section)}\n" in text, (name, section)
        assert "Source: docs/" in text.replace("\n    ", " ")
        for parameter in inspect.signature(getattr(tw, name)).parameters.values():
            if parameter.kind is not parameter.VAR_KEYWORD:
                assert re.search(rf"^    (\w+, )*{parameter.name}\b", text, re.M), (name, parameter.name)


# ---- Shapes that turn.


def test_turning_has_its_methods():
    rng = np.random.default_rng(5)
    rods, boxes = turning("Capsule", rng, 200), moving("Aabb", rng, 200)
    swept = tw.time_of_impact(rods, boxes)
    assert {0, 1, 2} <= set(swept["status"])
    assert bits(swept) == bits(tw.time_of_impact(rods, boxes, "conservative_advancement"))
    flipped = tw.time_of_impact(boxes, rods)
    assert bits(flipped[["status", "evaluations", "time", "point"]]) == bits(swept[["status", "evaluations", "time", "point"]])
    assert np.array_equal(flipped["normal"], -swept["normal"], equal_nan=True)
    with pytest.raises(ValueError, match="the method, where a shape turns, is 'closed_form'; .*allowed is end_of_step"):
        tw.time_of_impact(rods, boxes, "closed_form")
    still = tw.Turning(rods.shape, rods.displacement, [0, 0, 0])
    straight = tw.Moving(rods.shape, rods.displacement)
    linear, exact = tw.time_of_impact(still, boxes, "linear_sweep"), tw.time_of_impact(straight, boxes)
    assert np.array_equal(linear["status"], exact["status"])
    assert np.allclose(linear["time"], exact["time"], rtol=1e-12, atol=0, equal_nan=True)  # an oriented box's formula
    proven = tw.certified_time_of_impact(rods, boxes)
    sure = proven["status"] == S.HIT
    assert sure.any() and np.all(swept["time"][sure] <= proven["upper"][sure])


# ---- The interpreter.


def test_the_interpreter_runs_meanwhile():
    rng = np.random.default_rng(6)
    a, b = (tw.Moving(shape("Capsule", rng, 60_000), rng.uniform(-1, 1, (60_000, 3))) for _ in "ab")
    working = threading.Thread(target=lambda: tw.certified_time_of_impact(a, b))
    working.start()
    turns = 0
    while working.is_alive():
        turns += 1
        time.sleep(0.001)
    assert turns > 3  # one, if the thread held the interpreter


@pytest.mark.skipif("THINWALL_SANITIZED" in os.environ, reason="a sanitizer takes more of the stack")
def test_a_thread_may_have_a_short_stack():
    command = """
import threading, numpy as np, thinwall as tw
wall = tw.Aabb([3.0, 0, 0], [0.1, 5, 5])
balls = tw.Moving(tw.Sphere(np.zeros((5000, 3)), 0.1), np.full((5000, 3), 4.0))
def ask():
    print((tw.time_of_impact(balls, tw.at_rest(wall))["status"] == 1).sum(), tw.raycast(tw.Ray(np.zeros((5, 3)), [1, 0, 0]), wall)["t"].sum())
threading.stack_size(128 * 1024)
thread = threading.Thread(target=ask)
thread.start()
thread.join()
"""
    done = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, "5000 14.5\n"), done


def test_import_loads_what_queries_need():
    command = "import sys, thinwall; print(*sorted(m for m in sys.modules if m.startswith(('thinwall', 'pandas', 'matplotlib'))))"
    loaded = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True, check=True).stdout.split()
    assert loaded == ["thinwall", *(f"thinwall.{part}" for part in ("_queries", "_version", "queries", "shapes"))]


# ---- Any arrays whatever.

numbers = st.one_of(st.floats(width=64), st.sampled_from([0.0, 1.0, -1.0, 5e-324, 1e308, -1e308, float("nan"), float("inf")]))


@st.composite
def any_shape(draw, rows):
    dtype = draw(st.sampled_from([np.float64, np.float32]))
    kind = draw(st.sampled_from(KINDS))
    fields = {"Sphere": "vs", "Aabb": "vv", "Obb": "vvm", "Triangle": "vvv", "Capsule": "vvs"}[kind]

    def array(field):
        axes = {"s": (), "v": (3,), "m": (3, 3)}[field]
        lead = draw(st.sampled_from([(), (1,), (rows,)]))
        size = int(np.prod(lead + axes))
        with np.errstate(over="ignore"):
            array = np.array(draw(st.lists(numbers, min_size=size, max_size=size))).astype(dtype).reshape(lead + axes)
        return array[::-1] if lead and draw(st.booleans()) else array

    still = getattr(tw, kind)(*map(array, fields))
    if kind != "Aabb" and draw(st.booleans()):
        return tw.Turning(still, array("v"), array("v"))
    return tw.Moving(still, array("v"))


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.data(), st.integers(0, 3))
def test_no_array_crashes_a_query(data, rows):
    a, b = data.draw(any_shape(rows)), data.draw(any_shape(rows))
    method = data.draw(st.sampled_from([None, *tw.methods(), *tw.methods(turning=True)]))
    asks = [tw.overlaps, tw.contact, tw.separation, tw.manifold]
    asks = [lambda ask=ask: ask(a.shape, b.shape) for ask in asks]
    vectors = data.draw(st.booleans())
    asks += [lambda: tw.time_of_impact(a, b, method, vectors=vectors), lambda: tw.certified_time_of_impact(a, b), lambda: tw.valid(a)]
    for ask in asks:
        try:
            answer = ask()
        except (TypeError, ValueError) as error:
            assert "; " in str(error)  # what is allowed
            continue
        if answer.dtype.names and "time" in answer.dtype.names:
            t = answer["time"]
            assert np.all(((t >= 0) & (t <= 1)) | (np.isnan(t) & (answer["status"] == S.INVALID)))
