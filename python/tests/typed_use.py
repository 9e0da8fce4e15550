"""What mypy must accept: a caller's code, as docs/python.md has it."""

import numpy as np

import thinwall as tw

rows = np.zeros((10, 3))
bullets = tw.Moving(tw.Sphere(rows, 0.01), rows + [5.0, 0.0, 0.0])
wall = tw.at_rest(tw.Aabb([10.0, 0.0, 0.0], [0.05, 5.0, 5.0]))
answer = tw.time_of_impact(bullets, wall, "conservative_advancement", threads=2, tolerance=1e-6)
hits = bullets[answer["status"] == tw.ToiStatus.HIT]
proven = tw.certified_time_of_impact(hits, wall)
spin: tw.Turning = tw.Turning(tw.Capsule([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 0.1), rows, rows)
pairs = tw.find_pairs(rows, rows + 1.0, "r_tree", max_pairs=100)
touching = tw.overlaps(bullets.shape[pairs[:, 0]], bullets.shape[pairs[:, 1]])
seen = tw.raycast(tw.Ray(rows, rows), wall.shape)["status"]
chance = tw.theory.tunneling_probability(speed=rows[:, 0] + 10, radius=0.02, thickness=0.01, fps=60)
result: tw.Result = tw.run("thin_wall", speed=[10, 40], seed=1, out="results/mine", progress=lambda done, total: None)
cells = tw.read("results/mine")["cells"]
advice = tw.advise(speed=300, radius=0.004, thickness=0.002, fps=60)
world = tw.world({"body": [{"shape": "sphere", "radius": 0.1}]})
world.move(np.uint32(1), [0.0, 0.0, 1.0])
speeds = np.linalg.norm(world.velocities, axis=1)[world.step(0.01, steps=2)["first"]]
