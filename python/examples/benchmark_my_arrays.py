"""Discrete against swept, on your own arrays: what does each cost a shot, and how many hits does it miss?

    PYTHONPATH=build/release/python /usr/bin/python3 python/examples/benchmark_my_arrays.py [shots.npz] [--out picture.png]

The file holds `center` (N, 3), `radius` (N,) and `displacement` (N, 3) of what flies, and `wall_center` and `wall_half_extents`, (3,)
each or (N, 3). Without one, 100 000 bullets of 1 cm at 10 to 1000 m/s fly at a wall of 2 cm, in steps of 1/60 s.
"""

import argparse
import time

import matplotlib
import numpy as np

import thinwall as tw

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def bullets_at_a_wall(rows, seed=1):
    """The arrays of a file, drawn: the wall's place is uniform over the step's way, so that chance has no favorite."""
    rng = np.random.default_rng(seed)
    way = rng.uniform(10, 1000, rows) / 60
    center = np.zeros((rows, 3))
    displacement = np.zeros((rows, 3))
    displacement[:, 0] = way
    wall_center = np.zeros((rows, 3))
    wall_center[:, 0] = 0.02 + rng.uniform(0, 1, rows) * way
    return {
        "center": center,
        "radius": np.full(rows, 0.01),
        "displacement": displacement,
        "wall_center": wall_center,
        "wall_half_extents": np.array([0.01, 5.0, 5.0]),
    }


def quickest(ask, times=5):
    """[s] of the quickest of several calls, and its answer."""
    best = float("inf")
    for _ in range(times):
        start = time.perf_counter()
        answer = ask()
        best = min(best, time.perf_counter() - start)
    return best, answer


def measure(arrays, threads):
    """A row a method: its name, [s] a call, and the share of true hits that it misses."""
    bullets = tw.Moving(tw.Sphere(arrays["center"], arrays["radius"]), arrays["displacement"])
    walls = tw.at_rest(tw.Aabb(arrays["wall_center"], arrays["wall_half_extents"]))
    touched = (tw.ToiStatus.HIT, tw.ToiStatus.OVERLAPPING)
    truth = np.isin(tw.time_of_impact(bullets, walls)["status"], touched)
    ways = [
        ("end_of_step", "discrete, at the end", {}),
        ("substeps", "discrete, 4 substeps", {"n": 4}),
        ("substeps", "discrete, 32 substeps", {"n": 32}),
        ("centre_ray", "ray from the center", {}),
        ("conservative_advancement", "conservative advancement", {}),
        ("closed_form", "swept, closed form", {}),
    ]
    rows = []
    for method, label, options in ways:
        seconds, answer = quickest(lambda: tw.time_of_impact(bullets, walls, method, threads=threads, **options))
        missed = truth & ~np.isin(answer["status"], touched)
        rows.append((label, seconds, missed.sum() / max(truth.sum(), 1)))
    seconds, _ = quickest(lambda: tw.time_of_impact(bullets, walls, threads=threads, vectors=False))
    rows.append(("swept, times alone", seconds, 0.0))
    return rows, truth


def draw(rows, shots, out):
    labels = [row[0] for row in rows]
    nanoseconds = [row[1] / shots * 1e9 for row in rows]
    missed = [100 * row[2] for row in rows]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 0.5 * len(rows) + 1.4), sharey=True, layout="constrained")
    for axes, values, what, form in ((left, nanoseconds, "ns a shot", "%.0f"), (right, missed, "% of true hits missed", "%.1f")):
        bars = axes.barh(labels, values, color=["tab:blue" if label.startswith("swept") else "tab:gray" for label in labels])
        axes.bar_label(bars, fmt=form, padding=3)
        axes.set_xlabel(what)
        axes.margins(x=0.15)
        axes.spines[["top", "right"]].set_visible(False)
    left.invert_yaxis()
    figure.suptitle(f"{shots:,} shots".replace(",", " "))
    figure.savefig(out, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", help="an .npz; without it, bullets at a wall")
    parser.add_argument("--rows", type=int, default=100_000, help="bullets, without a file")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--out", default="benchmark_my_arrays.png", help="the picture")
    options = parser.parse_args()
    arrays = np.load(options.file) if options.file else bullets_at_a_wall(options.rows)
    rows, truth = measure(arrays, options.threads)
    print(f"{truth.sum()} of {len(truth)} shots hit")
    for label, seconds, missed in rows:
        print(f"{label:26s} {seconds / len(truth) * 1e9:9.1f} ns a shot, misses {100 * missed:5.1f} % of the hits")
    draw(rows, len(truth), options.out)
    print(f"{options.out}: the picture")


if __name__ == "__main__":
    main()
