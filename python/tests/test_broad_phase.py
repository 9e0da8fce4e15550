"""find_pairs: every method finds the pairs that a loop over all of them finds, in the library's order."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import thinwall as tw

METHODS = ("all_pairs", "all_ordered_pairs", "sort_and_sweep", "uniform_grid", "r_tree")
each_method = pytest.mark.parametrize("method", METHODS)


def by_loop(lower, upper, may_meet=lambda i, j: True):
    return [
        (i, j)
        for i in range(len(lower))
        for j in range(i + 1, len(lower))
        if np.all(lower[i] <= upper[j]) and np.all(lower[j] <= upper[i]) and may_meet(i, j)
    ]


def boxes(rows, dtype=np.float64, seed=1):
    rng = np.random.default_rng(seed)
    center = np.round(rng.uniform(-3, 3, (rows, 3)), 1)
    half = np.round(rng.uniform(0, 0.8, (rows, 3)), 1)
    return (center - half).astype(dtype), (center + half).astype(dtype)


@each_method
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_finds_what_a_loop_finds(method, dtype):
    lower, upper = boxes(150, dtype)
    pairs = tw.find_pairs(lower, upper, method)
    assert pairs.dtype == np.int64 and pairs.tolist() == [list(p) for p in by_loop(lower, upper)]
    assert len(pairs) > 50
    wide = np.zeros((300, 6), dtype)
    wide[::2, ::2], wide[::2, 1::2] = lower, upper
    assert np.array_equal(tw.find_pairs(wide[::2, ::2], wide[::2, 1::2], method), pairs)  # read where they lie


@each_method
def test_groups_masks_and_statics(method):
    lower, upper = boxes(120)
    rng = np.random.default_rng(2)
    group = rng.integers(0, 4, 120, dtype=np.uint32)
    mask = rng.integers(0, 4, 120, dtype=np.uint32)
    static = rng.random(120) < 0.3
    may_meet = lambda i, j: bool(group[i] & mask[j]) and bool(group[j] & mask[i]) and not (static[i] and static[j])
    pairs = tw.find_pairs(lower, upper, method, group=group, mask=mask, static=static)
    assert pairs.tolist() == [list(p) for p in by_loop(lower, upper, may_meet)]
    assert 0 < len(pairs) < len(by_loop(lower, upper))


def test_the_pairs_ask_the_narrow_query():
    lower, upper = boxes(150)
    bodies = tw.Aabb((lower + upper) / 2, (upper - lower) / 2)
    pairs = tw.find_pairs(lower, upper)
    assert tw.overlaps(bodies[pairs[:, 0]], bodies[pairs[:, 1]]).mean() > 0.9  # but for rounding of the centers


@each_method
def test_empty_and_single(method):
    none = np.zeros((0, 3))
    assert tw.find_pairs(none, none, method).shape == (0, 2)
    assert tw.find_pairs(np.zeros((1, 3)), np.ones((1, 3)), method).shape == (0, 2)
    everywhere = np.full((2, 3), np.inf)
    assert tw.find_pairs(-everywhere, everywhere, method).tolist() == [[0, 1]]


L, U = boxes(4)
N = L.copy()
N[2, 1] = np.nan
REFUSED = [
    (lambda: tw.find_pairs(L, U, "grid"), ValueError, "the method is 'grid'; "),
    (lambda: tw.find_pairs(L, U, "r-tree"), ValueError, "did you mean 'r_tree'"),
    (lambda: tw.find_pairs(L.tolist(), U), TypeError, "find_pairs: lower is list; allowed is an array"),
    (lambda: tw.find_pairs(L, U.astype(int)), TypeError, "upper is an array of int64; allowed is float64 or float32"),
    (lambda: tw.find_pairs(np.ma.masked_less(L, 0), U), TypeError, "find_pairs: lower is a masked array; allowed is one without a mask"),
    (lambda: tw.find_pairs(L.astype(np.float32), U), TypeError, "upper is an array of float64; allowed is float32, as lower is"),
    (lambda: tw.find_pairs(L[:, :2], U), ValueError, r"lower has shape \(4, 2\); allowed is shape \(N, 3\)"),
    (lambda: tw.find_pairs(L[0], U), ValueError, r"lower has shape \(3,\)"),
    (lambda: tw.find_pairs(L, U[:3]), ValueError, "upper has 3 rows; allowed is 4"),
    (lambda: tw.find_pairs(N, U), ValueError, "lower and upper, row 2: its box is not a number"),
    (lambda: tw.find_pairs(U + 1, L), ValueError, "row 0: its box has low > high"),
    (lambda: tw.find_pairs(L, U, group=np.ones(4, int)), TypeError, "group is an array of int64; allowed is an array of uint32"),
    (lambda: tw.find_pairs(L, U, static=np.ma.array(np.ones(4, bool))), TypeError, "static is a masked array; allowed is an array of bool"),
    (lambda: tw.find_pairs(L, U, mask=3), TypeError, "mask is int"),
    (lambda: tw.find_pairs(L, U, static=np.ones(3, bool)), ValueError, r"static has shape \(3,\); allowed is shape \(4,\)"),
    (lambda: tw.find_pairs(L, U, max_pairs=-1), ValueError, "max_pairs is -1"),
    (lambda: tw.find_pairs(np.zeros((9, 3)), np.ones((9, 3)), max_pairs=3), RuntimeError, "more than 3 pairs"),
]


@pytest.mark.parametrize("ask, error, message", REFUSED, ids=[r[2][:40] for r in REFUSED])
def test_refuses(ask, error, message):
    with pytest.raises(error, match=message):
        ask()


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.lists(st.tuples(*[st.floats(-2, 2, width=16)] * 3, *[st.sampled_from([0.0, 0.25, 1.0, float("inf")])] * 3), max_size=12))
def test_all_methods_agree(rows):
    rows = np.array(rows).reshape(-1, 6)
    lower, upper = rows[:, :3] - rows[:, 3:], rows[:, :3] + rows[:, 3:]
    expected = [list(p) for p in by_loop(lower, upper)]
    for method in METHODS:
        assert tw.find_pairs(lower, upper, method).tolist() == expected
