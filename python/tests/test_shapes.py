"""Shapes hold arrays, copy none of them, and refuse what is no array of rows by a message that says why."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import thinwall as tw
from draw import KINDS, moving, shape, turning

ROWS = 20
SHAPES = {kind: shape(kind, np.random.default_rng(1), ROWS) for kind in KINDS}
SHAPES["Ray"] = tw.Ray(np.zeros((ROWS, 3)), np.ones((ROWS, 3)), np.ones(ROWS))
SHAPES["Moving"] = moving("Obb", np.random.default_rng(2), ROWS)
SHAPES["Turning"] = turning("Capsule", np.random.default_rng(3), ROWS, np.float32)
each_shape = pytest.mark.parametrize("rows", SHAPES.values(), ids=SHAPES)


class Series:
    """What pandas calls so, as far as it is looked at."""

    def __init__(self, values):
        self._values = values

    def to_numpy(self):
        return self._values


def arrays(rows):
    return [*getattr(rows, "shape", rows)._arrays, *(rows._arrays if hasattr(rows, "shape") else ())]


def same(x, y):
    return type(x) is type(y) and all(map(lambda a, b: a.dtype == b.dtype and a.tobytes() == b.tobytes(), arrays(x), arrays(y)))


def test_holds_the_arrays_themselves():
    for dtype in (np.float64, np.float32):
        center, radius = np.ones((5, 3), dtype), np.ones(5, dtype)
        ball = tw.Sphere(center, radius)
        assert ball.center is center and ball.radius is radius and ball.dtype == dtype
        way = np.ones((5, 3), dtype)
        flying = tw.Moving(ball, way)
        assert flying.displacement is way and flying.shape is ball


@each_shape
def test_pickles_and_copies(rows):
    assert same(pickle.loads(pickle.dumps(rows)), rows)
    assert same(copy.copy(rows), rows)
    deep = copy.deepcopy(rows)
    assert same(deep, rows)
    assert not any(np.shares_memory(a, b) for a, b in zip(arrays(deep), arrays(rows)))
    assert all(a is b for a, b in zip(arrays(copy.copy(rows)), arrays(rows)))


def test_classes_made_of_a_shape_are_that_shape():
    class Ball(tw.Sphere):
        pass

    ball, box = Ball([0, 0, 0], 1.0), tw.Aabb([3, 0, 0], [1, 1, 1])
    assert tw.valid(ball) and not tw.overlaps(ball, box)
    assert tw.time_of_impact(tw.Moving(ball, [2, 0, 0]), tw.at_rest(box))["time"] == 0.5


@each_shape
def test_slices_without_copying(rows):
    part = rows[5:15:2]
    assert len(part) == 5 and len(rows) == ROWS
    assert all(np.shares_memory(a, b) and a.tobytes() == b[5:15:2].tobytes() for a, b in zip(arrays(part), arrays(rows)))
    one = rows[3]
    assert one.is_one and all(a.tobytes() == b[3].tobytes() for a, b in zip(arrays(one), arrays(rows)))
    assert same(rows[np.array([3, 1])], rows[[3, 1]]) and len(rows[np.arange(ROWS) % 2 == 0]) == ROWS // 2
    assert len(list(rows)) == ROWS and same(list(rows)[-1], rows[-1])
    with pytest.raises(IndexError):
        rows[ROWS]
    for wrong in ((1, 2), None, ..., np.zeros((2, 2), int)):
        with pytest.raises(TypeError, match="rows are indexed by"):
            rows[wrong]


def test_one_shape_broadcasts():
    ball = tw.Sphere([0, 0, 0], 1)
    assert ball.is_one and ball.dtype == np.float64 and "one" in repr(ball)
    with pytest.raises(TypeError, match="one shape, without rows, has no length"):
        len(ball)
    with pytest.raises(TypeError, match="cannot be indexed"):
        ball[0]
    many = tw.Sphere(np.zeros((7, 3)), 1.0)
    assert len(many) == 7 and len(many[2:4]) == 2 and many[2:4].radius == 1.0
    assert len(tw.Sphere(np.zeros((1, 3)), np.ones(7))[2:4]) == 2
    assert len(tw.Moving(ball, np.zeros((7, 3)))[:3]) == 3
    assert len(tw.Moving(many, [0, 0, 1])[:3]) == 3
    assert len(tw.Moving(tw.Sphere(np.zeros((1, 3)), 1.0), np.zeros((7, 3)))[:3]) == 3


def test_numbers_of_pythons_take_the_arrays_type():
    assert tw.Sphere(np.zeros((2, 3), np.float32), 0.1).dtype == np.float32
    assert tw.Moving(tw.Sphere(np.zeros((2, 3), np.float32), 1), [1, 2, 3]).displacement.dtype == np.float32
    assert tw.Sphere([[0, 0, 0], [1, 1, 1]], [1, 2]).dtype == np.float64
    assert tw.Ray(np.zeros(3, np.float32), np.ones(3, np.float32)).max_t.dtype == np.float32
    assert tw.Sphere([0, 0, 0], np.float32(1)).dtype == np.float32


V, W = np.zeros((4, 3)), np.zeros((4, 3), np.float32)
REFUSED = [
    (lambda: tw.Sphere(np.zeros((4, 3), int), 1.0), TypeError, r"Sphere: center is an array of int64; allowed is float64 or float32"),
    (lambda: tw.Sphere(np.zeros((4, 3), np.float16), 1.0), TypeError, r"center is an array of float16"),
    (lambda: tw.Sphere(np.zeros((4, 3), ">f8"), 1.0), TypeError, r"center is an array of >f8"),
    (lambda: tw.Sphere(V.astype(object), 1.0), TypeError, r"center is an array of object"),
    (lambda: tw.Sphere(np.ma.masked_less(V, 0), 1.0), TypeError, r"center is a masked array; allowed is one without a mask"),
    (lambda: tw.Sphere(V, Series(np.ones(4))), TypeError, r"radius is a Series; allowed is an array: convert it by \.to_numpy\(\)"),
    (lambda: tw.Sphere(V, np.zeros(4, np.float32)), TypeError, r"radius is an array of float32; allowed is float64, as the arrays"),
    (lambda: tw.Moving(tw.Sphere(V, 1.0), W), TypeError, r"Moving: displacement is an array of float32; allowed is float64"),
    (lambda: tw.Sphere(np.zeros((4, 2)), 1.0), ValueError, r"center is an array of shape \(4, 2\); allowed is shape \(3,\) or \(N, 3\)"),
    (lambda: tw.Sphere(np.zeros((3, 4)), 1.0), ValueError, r"shape \(3, 4\)"),
    (lambda: tw.Sphere(np.zeros((2, 4, 3)), 1.0), ValueError, r"shape \(2, 4, 3\)"),
    (lambda: tw.Sphere(np.zeros(()), 1.0), ValueError, r"shape \(\); allowed is shape \(3,\)"),
    (lambda: tw.Sphere(V, np.zeros((4, 1))), ValueError, r"radius is an array of shape \(4, 1\); allowed is shape \(\) or \(N,\)"),
    (lambda: tw.Obb(V, V, np.zeros((4, 3))), ValueError, r"axes is an array of shape \(4, 3\); allowed is shape \(3, 3\) or \(N, 3, 3\)"),
    (lambda: tw.Sphere(V, np.zeros(5)), ValueError, r"radius is an array of 5 rows; allowed is 4, as the arrays before it have, or 1"),
    (lambda: tw.Moving(tw.Sphere(V, 1.0), np.zeros((5, 3))), ValueError, r"displacement is an array of 5 rows; allowed is 4, as the shape has"),
    (lambda: tw.Turning(tw.Sphere(V, 1.0), V, np.zeros((5, 3))), ValueError, r"rotation is an array of 5 rows; allowed is 4"),
    (lambda: tw.Sphere("abc", 1.0), TypeError, r"center is str 'abc'; allowed is an array, a number or a list"),
    (lambda: tw.Sphere(None, 1.0), TypeError, r"center is NoneType"),
    (lambda: tw.Sphere([0, 0, True], 1.0), TypeError, r"center is list"),
    (lambda: tw.Sphere([[0, 0, 0], [0, 0]], 1.0), ValueError, r"numbers in rows of equal length"),
    (lambda: tw.Sphere([0, 0, 10**400], 1.0), ValueError, r"center is"),
    (lambda: tw.Moving(V, V), TypeError, r"Moving: shape is ndarray; allowed is Sphere, Aabb, Obb, Triangle or Capsule"),
    (lambda: tw.Turning(tw.Aabb(V, V), V, V), TypeError, r"Turning: shape is Aabb.*an Obb"),
    (lambda: tw.Moving(tw.at_rest(tw.Sphere(V, 1.0)), V), TypeError, r"shape is Moving"),
]


@pytest.mark.parametrize("make, error, message", REFUSED, ids=[r[2][:40] for r in REFUSED])
def test_refuses(make, error, message):
    with pytest.raises(error, match=message):
        make()


def test_equality_is_of_numbers():
    a = tw.Sphere(np.zeros((3, 3)), np.ones(3))
    assert a == tw.Sphere(np.zeros((3, 3)), np.ones(3)) and a != tw.Sphere(np.ones((3, 3)), np.ones(3))
    assert a != tw.Aabb(np.zeros((3, 3)), np.zeros((3, 3))) and a != 3
    assert tw.Moving(a, [0, 0, 0]) == tw.at_rest(a) and tw.Moving(a, [0, 0, 1]) != tw.at_rest(a)
    assert tw.at_rest(a) != tw.Turning(a, [0, 0, 0], [0, 0, 0]) != tw.at_rest(a)
    assert all(tw.at_rest(a) != other and other != tw.at_rest(a) for other in (None, 3, a))
    with pytest.raises(TypeError, match="unhashable"):
        hash(a)


anything = st.one_of(
    st.none(),
    st.floats(),
    st.integers(),
    st.text(max_size=3),
    st.lists(st.floats(), max_size=4),
    st.lists(st.lists(st.integers(), max_size=4), max_size=4),
    st.builds(
        lambda shape, dtype: np.zeros(shape, dtype),
        st.lists(st.integers(0, 4), max_size=3),
        st.sampled_from(["f8", "f4", "f2", "i8", "c16", "O", "?", ">f8", "M8[s]", "U1"]),
    ),
)


@settings(max_examples=500, deadline=None, derandomize=True)
@given(anything, anything)
def test_whatever_is_passed_is_held_or_refused(center, radius):
    try:
        ball = tw.Sphere(center, radius)
    except (TypeError, ValueError) as error:
        assert str(error).startswith("Sphere: ") and "; allowed is " in str(error)
    else:
        answers = tw.overlaps(ball, ball)
        assert answers.shape == (() if ball.is_one else (len(ball),))
