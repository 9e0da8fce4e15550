"""What Python costs: a million sphere-AABB sweeps from NumPy arrays, beside the C++ batch on the same memory and a loop over rows.

    PYTHONPATH=build/release/python:build/release/python/bench /usr/bin/python3 python/bench/queries.py

The C++ call is `thinwall::time_of_impact` of swept/batch.hpp, put to the arrays' own columns by batch_call.cpp (built where
THINWALL_BUILD_BENCH is ON), so it needs arrays whose columns are contiguous: (N, 3) in Fortran's order. The same rows in NumPy's usual
order are measured, too.
"""

import gc
import time

import numpy as np

import batch_call
import thinwall as tw


def scene(rows, order):
    """A fifth of them hit. `order` F: a column after the other, C: a row after the other."""
    rng = np.random.default_rng(1)
    array = lambda low, high: np.array(rng.uniform(low, high, (rows, 3)), order=order)
    center, half, motion = array(-1, 1), array(0.2, 0.6), array(-2, 2)
    center[:, 0] += 2
    motion[:, 0] -= 2
    radius = rng.uniform(0.1, 0.5, rows)
    balls = tw.Moving(tw.Sphere(center, radius), motion)
    boxes = tw.Moving(tw.Aabb(array(-0.5, 0.5), half), array(-0.1, 0.1))
    return balls, boxes


def columns(moving):
    shape = moving.shape
    size = shape.radius if isinstance(shape, tw.Sphere) else shape.half_extents
    return shape.center, size, moving.displacement


def rounds(calls, times=25):
    """[s] of this thread for each call: the least of `times` turns, in which they take turns, so that other programs count for little."""
    took = {name: [] for name in calls}
    for _ in range(times):
        for name, call in calls.items():
            gc.collect()
            start = time.thread_time()
            call()
            took[name].append(time.thread_time() - start)
    return {name: float(np.min(t)) for name, t in took.items()}


def main(rows=1_000_000, loop_rows=20_000):
    balls, boxes = scene(rows, "F")
    same_c = scene(rows, "C")
    hits = np.mean(tw.time_of_impact(balls, boxes)["status"] == tw.ToiStatus.HIT)
    print(f"{rows} sweeps of a sphere and an Aabb, {100 * hits:.0f} % hits; the least of 25 turns, one thread")
    for vectors in (False, True):
        out = np.empty(rows, tw.time_of_impact(balls[:1], boxes[:1], vectors=vectors).dtype)
        cpp = batch_call.BatchCall(*columns(balls), *columns(boxes), vectors)
        calls = {
            "C++ batch, the same columns": cpp.run,
            "Python, out=": lambda: tw.time_of_impact(balls, boxes, vectors=vectors, out=out),
            "Python, a fresh answer": lambda: tw.time_of_impact(balls, boxes, vectors=vectors),
            "Python, rows in C order, out=": lambda: tw.time_of_impact(*same_c, vectors=vectors, out=out),
        }
        took = rounds(calls)
        first = next(iter(took.values()))
        print(f"vectors={vectors}")
        for name, seconds in took.items():
            print(f"  {name:32s} {seconds / rows * 1e9:9.2f} ns a row   x {seconds / first:.3f}")
    start = time.thread_time()
    for i in range(loop_rows):
        tw.time_of_impact(balls[i], boxes[i])
    print(f"  {'Python, a loop over the rows':32s} {(time.thread_time() - start) / loop_rows * 1e9:9.0f} ns a row")


if __name__ == "__main__":
    main()
