# Traces the rays of a folder with Embree, by PyPI's embreex, in its fast and its robust mode.
#
# NAME.mesh  count of points and triangles (int32), points (float32 × 3), triangles (int32 × 3)
# NAME.rays  origin and direction (float32 × 6), one after the other
# NAME.far   distance of each hit (float64), where it is known; else every ray must hit anything
#
# Writes counts of faulty rays to the second argument: lines of name, fast, robust.
import os
import sys

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

folder, out, allowed = sys.argv[1], sys.argv[2], float(sys.argv[3])
lines = []
for name in sorted(f[:-5] for f in os.listdir(folder) if f.endswith(".mesh")):
    raw = open(os.path.join(folder, name + ".mesh"), "rb").read()
    points, triangles = np.frombuffer(raw, np.int32, 2)
    p = np.frombuffer(raw, np.float32, 3 * points, 8).reshape(-1, 3)
    t = np.frombuffer(raw, np.int32, 3 * triangles, 8 + 12 * points).reshape(-1, 3)
    rays = np.fromfile(os.path.join(folder, name + ".rays"), np.float32).reshape(-1, 6)
    o, d = np.ascontiguousarray(rays[:, :3]), np.ascontiguousarray(rays[:, 3:])
    far = os.path.join(folder, name + ".far")
    counts = []
    for robust in (False, True):
        scene = EmbreeScene(robust=robust)
        mesh = TriangleMesh(scene, p.copy(), t.copy())
        if os.path.exists(far):
            expected = np.fromfile(far, np.float64)
            found = scene.run(o, d, query="DISTANCE").astype(np.float64)
            counts.append(int(np.sum(~(np.abs(found - expected) <= allowed * np.abs(expected)))))
        else:
            counts.append(int(np.sum(scene.run(o, d) < 0)))
    lines.append("%s %d %d" % (name, *counts))
open(out, "w").write("\n".join(lines) + "\n")
