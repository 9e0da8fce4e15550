# %% [markdown]
# # How often does my bullet tunnel?
#
# A bullet of 8 mm flies at 300 m/s, a game steps 60 times a second: 5 m a step. Which walls does it fly through unseen, if the game
# tests where it is at the end of each step? Theory says so in a line, an experiment counts, and a figure holds one against the other.
#
# Run it as a script, or cell by cell in an editor that knows `# %%`. Set the numbers of the next cell to those of your bullet.

# %%
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import thinwall as tw

bullet = {"speed": 300.0, "radius": 0.004}  # [m/s], [m]
step = 1 / 60  # [s]
walls = [0.002, 0.1, 1.0, 2.5, 6.0]  # [m] thick

parser = argparse.ArgumentParser(description="How often does my bullet tunnel?")
parser.add_argument("--shots", type=int, default=100_000, help="at each wall, by each method")
parser.add_argument("--out", type=Path, default=Path("results/my_bullet"))
options, _ = parser.parse_known_args()  # a notebook has words of its own

# %% [markdown]
# ## What does theory expect?

# %%
expected = tw.theory.tunneling_probability(**bullet, thickness=walls, step=step)
for wall, probability in zip(walls, expected):
    print(f"{wall:6.3f} m: {probability:.3f}")

# %% [markdown]
# ## What happens?
#
# The same bullet is fired at each wall, by three methods: the pose at the end of a step, eight poses a step, and the swept answer. The run
# is kept in a folder: the same call finds it there, and goes on if it was interrupted.

# %%
result = tw.run(
    "thin_wall",
    speed=[bullet["speed"]],
    radius=[bullet["radius"]],
    thickness=walls,
    step=[step],
    angle_deg=[0],
    wall=["infinite"],
    method=["end_of_step", "substeps", "closed_form"],
    substeps=[8],
    scalar=["double"],
    shots=options.shots,
    seed=1,
    out=options.out / f"{options.shots}_shots",
)
cells = result["cells"]
cells = cells[cells["speed"] == bullet["speed"]]  # without the bullet of the textbook, which every run fires as well
print(cells[["method", "thickness", "shots", "tunneled", "probability", "theory"]].to_string(index=False))

# %% [markdown]
# ## Both in a figure
#
# The lines are theory, the points are counts with 95 % intervals.

# %%
figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
thickness = np.geomspace(0.001, 10, 400)
looks = {"end_of_step": ("o", "C1", 1), "substeps_8": ("s", "C2", 8), "closed_form": ("D", "C0", None)}
for method, (marker, color, poses) in looks.items():
    rows = cells[cells["method"] == method]
    error = [rows["probability"] - rows["lower"], rows["upper"] - rows["probability"]]
    axes.errorbar(rows["thickness"], rows["probability"], error, fmt=marker, color=color, capsize=3, label=method, zorder=3)
    line = np.zeros_like(thickness)
    if poses is not None:
        line = tw.theory.tunneling_probability(**bullet, thickness=thickness, step=step, poses=poses)
    axes.plot(thickness, line, color="black", linewidth=0.8, label="theory" if poses == 1 else None)
axes.set(
    xscale="log",
    xlabel="thickness of the wall [m]",
    ylabel="probability of tunneling",
    title=f"A bullet of {2000 * bullet['radius']:g} mm at {bullet['speed']:g} m/s, {1 / step:g} steps a second",
)
axes.legend(frameon=False)
figure.savefig(options.out / "tunneling.png", dpi=150)
print(f"figure: {options.out / 'tunneling.png'}")

# %% [markdown]
# ## What to use instead
#
# The advice names the cheapest method that misses nothing here, measured on this machine.

# %%
advice = tw.advise(**bullet, thickness=min(walls), step=step)
print(advice.sentence)
print(result.bibtex)
