"""Every query of every pair is the C++ library's answer to the bit, asked there row by row by the program row_by_row."""

import os
import subprocess

import numpy as np
import pytest

import thinwall as tw
from draw import KINDS, PAIRS, moving, ray, shape, turning

PROGRAM = os.environ["THINWALL_ROW_BY_ROW"]
ROWS = 10_000
SCALARS = (np.float64, np.float32)
RNG_SEED = 21


def numbers(body, rows):
    """The rows' numbers one after the other: the shape's, and of what is no ray those of its motion, zeros where it has none."""
    arrays = list(getattr(body, "shape", body)._arrays)
    if not isinstance(body, tw.Ray):
        zero = np.zeros((rows, 3), body.dtype)
        arrays += [getattr(body, "displacement", zero), getattr(body, "rotation", zero)]
    return np.concatenate([a.reshape(rows, -1) for a in arrays], axis=1).tobytes()


def in_cpp(query, a, b, fields, method="-"):
    rows = len(a)
    kinds = [type(getattr(x, "shape", x)).__name__ for x in (a, b)]
    command = [PROGRAM, query, a.dtype.name, *kinds, str(rows), method]
    run = subprocess.run(command, input=numbers(a, rows) + numbers(b, rows), capture_output=True)
    if run.returncode == 2:
        return None  # no such pair
    assert run.returncode == 0, run
    answer = np.frombuffer(run.stdout, np.dtype(fields))
    assert len(answer) == rows
    return answer


def assert_same_bits(ours, theirs, fields):
    for name in fields:
        x, y = np.ascontiguousarray(ours[name]), np.ascontiguousarray(theirs[name])
        assert x.dtype == y.dtype and x.shape == y.shape, name
        nan = np.isnan(x) & np.isnan(y) if x.dtype.kind == "f" else np.zeros(x.shape, bool)
        bits = np.dtype(f"u{x.itemsize}")
        wrong = np.flatnonzero(np.any((x.view(bits) != y.view(bits)).reshape(len(x), -1) & ~nan.reshape(len(x), -1), axis=1))
        assert len(wrong) == 0, f"{name}: {len(wrong)} rows, the first {wrong[0]}: {x[wrong[0]]} and {y[wrong[0]]}"


KERNELS = {frozenset(p) for p in (("Sphere",), ("Sphere", "Aabb"), ("Sphere", "Obb"), ("Sphere", "Capsule"), ("Aabb",))}


def assert_same_toi(ours, theirs, pair, method):
    """A batch kernel counts no evaluations: they are 1 in rows apart that it answered."""
    names = list(theirs.dtype.names)
    if method == "closed_form" and frozenset(pair) in KERNELS:
        names.remove("evaluations")
        apart = theirs["status"] == tw.ToiStatus.APART
        assert_same_bits(ours[~apart], theirs[~apart], ["evaluations"])
        assert np.all((ours["evaluations"] == 1) | (ours["evaluations"] == theirs["evaluations"]))
    assert_same_bits(ours, theirs, names)


def toi_fields(s):
    return [("status", "i4"), ("evaluations", "i4"), ("time", s), ("normal", s, 3), ("point", s, 3)]


def contact_fields(s):
    return [("local_a", s, 3), ("local_b", s, 3), ("normal", s, 3), ("penetration", s)]


def draws(pair, dtype):
    rng = np.random.default_rng([RNG_SEED, KINDS.index(pair[0]), KINDS.index(pair[1])])
    return rng, ROWS, dtype


each_pair = pytest.mark.parametrize("pair", PAIRS, ids="-".join)
each_scalar = pytest.mark.parametrize("dtype", SCALARS, ids=["float64", "float32"])


@each_pair
@each_scalar
def test_at_rest(pair, dtype):
    d = draws(pair, dtype)
    a, b = shape(pair[0], *d), shape(pair[1], *d)
    well = tw.valid(a) & tw.valid(b)
    assert 0.5 < well.mean() < 1

    theirs = in_cpp("overlaps", a, b, "?")
    touching = tw.overlaps(a, b, threads=2)
    assert touching.dtype == bool and 0 < touching.sum() < ROWS
    assert np.array_equal(touching, theirs)
    status = np.where(~well, tw.ToiStatus.INVALID, np.where(touching, tw.ToiStatus.OVERLAPPING, tw.ToiStatus.APART))

    fields = contact_fields(dtype)
    theirs = in_cpp("contact", a, b, [("touching", "?"), *fields])
    ours = tw.contact(a, b, threads=2)
    assert_same_bits(ours, theirs, [f[0] for f in fields])
    assert np.array_equal(ours["status"], status) and np.array_equal(theirs["touching"], touching)

    fields = [("distance", dtype), ("normal", dtype, 3), ("point_a", dtype, 3), ("point_b", dtype, 3)]
    ours = tw.separation(a, b, threads=2)
    assert_same_bits(ours, in_cpp("separation", a, b, fields), [f[0] for f in fields])
    assert np.array_equal(ours["status"] == tw.ToiStatus.INVALID, ~well)

    fields = [("count", "i4"), ("contacts", contact_fields(dtype), 4)]
    ours, theirs = tw.manifold(a, b, threads=2), in_cpp("manifold", a, b, fields)
    assert np.array_equal(ours["count"], theirs["count"]) and np.array_equal(ours["status"], status)
    for k in range(4):
        assert_same_bits(ours["contacts"][:, k], theirs["contacts"][:, k], [f[0] for f in contact_fields(dtype)])


@pytest.mark.parametrize("kind", KINDS)
@each_scalar
def test_rays(kind, dtype):
    d = draws((kind, kind), dtype)
    rays, b = ray(*d), shape(kind, *d)
    fields = [("hit", "?"), ("t", dtype), ("normal", dtype, 3), ("point", dtype, 3)]
    ours, theirs = tw.raycast(rays, b, threads=2), in_cpp("raycast", rays, b, fields)
    hit = np.isin(ours["status"], (tw.ToiStatus.HIT, tw.ToiStatus.OVERLAPPING))
    assert np.array_equal(hit, theirs["hit"]) and 0 < hit.sum() < ROWS
    assert_same_bits(ours[hit], theirs[hit], ["t", "normal", "point"])
    assert np.array_equal(ours["status"] == tw.ToiStatus.INVALID, ~(tw.valid(rays) & tw.valid(b)))
    apart = ours["status"] == tw.ToiStatus.APART
    assert np.array_equal(ours["t"][apart], rays.max_t[apart])


@each_pair
@each_scalar
def test_time_of_impact(pair, dtype):
    d = draws(pair, dtype)
    a, b = moving(pair[0], *d), moving(pair[1], *d)
    fields = toi_fields(dtype)
    theirs = in_cpp("time_of_impact", a, b, fields)
    if theirs is None:
        with pytest.raises(ValueError, match="is not served"):
            tw.time_of_impact(a, b)
        return
    ours = tw.time_of_impact(a, b, threads=2)
    assert_same_toi(ours, theirs, pair, "closed_form")
    assert {0, 1, 2, 4} <= set(ours["status"])

    # Without vectors, times may be the batch's: within its bound of the scalar code's, with the same verdicts.
    quick = tw.time_of_impact(a, b, threads=2, vectors=False)
    assert quick.dtype.names == ("status", "evaluations", "time")
    assert np.array_equal(quick["status"], ours["status"])
    if frozenset(pair) in KERNELS:
        close = np.abs(quick["time"] - ours["time"]) <= 1e4 * np.finfo(dtype).eps * ours["time"]  # a kappa of up to 2500
        assert np.mean(close | np.isnan(ours["time"])) > 0.99 and np.array_equal(np.isnan(quick["time"]), np.isnan(ours["time"]))
    else:
        assert_same_bits(quick, ours, ["time", "evaluations"])


METHOD_PAIRS = [("Sphere", "Aabb"), ("Obb", "Sphere"), ("Sphere", "Capsule"), ("Capsule", "Capsule")]


@pytest.mark.parametrize("pair", METHOD_PAIRS, ids="-".join)
@pytest.mark.parametrize("method", tw.methods())
@each_scalar
def test_methods(pair, method, dtype):
    d = draws(pair, dtype)
    a, b = moving(pair[0], *d), moving(pair[1], *d)
    theirs = in_cpp("method", a, b, toi_fields(dtype), method)
    if theirs is None:
        with pytest.raises(ValueError, match=f"is not served by '{method}'"):
            tw.time_of_impact(a, b, method)
    else:
        assert_same_toi(tw.time_of_impact(a, b, method, threads=2), theirs, pair, method)


@pytest.mark.parametrize("pair", METHOD_PAIRS, ids="-".join)
@each_scalar
def test_turning(pair, dtype):
    d = draws(pair, dtype)
    a = turning(pair[0], *d)
    b = moving(pair[1], *d) if pair[1] == "Aabb" else turning(pair[1], *d)
    theirs = in_cpp("turning", a, b, toi_fields(dtype))
    assert_same_bits(tw.time_of_impact(a, b, threads=2), theirs, [f[0] for f in toi_fields(dtype)])


@each_pair
def test_certified(pair):
    d = draws(pair, np.float64)
    a, b = moving(pair[0], *d), moving(pair[1], *d)
    fields = [("status", "i4"), ("lower", "f8"), ("upper", "f8"), ("decided_by", "i4")]
    theirs = in_cpp("certified", a, b, fields)
    if theirs is None:
        with pytest.raises(ValueError, match="is not served"):
            tw.certified_time_of_impact(a, b)
    else:
        assert_same_bits(tw.certified_time_of_impact(a, b, threads=2), theirs, [f[0] for f in fields])
