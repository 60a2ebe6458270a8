"""Reads a stress field as VTU with meshio and holds its arrays against the JSON.

    python3 field.py URL TOKEN CASE"""
import json, pathlib, sys, tempfile, urllib.request

import meshio
import numpy as np

url, token, case = sys.argv[1:]


def call(path, body=None, **headers):
    headers = {"authorization": f"Bearer {token}", "content-type": "application/json", **headers}
    request = urllib.request.Request(url + path, data=body, headers=headers)
    with urllib.request.urlopen(request) as answer:
        return answer.headers, answer.read()


request = json.loads((pathlib.Path(case) / "request.json").read_text())
request["mesh"] = {"subblocks": {"uniform": {"radial": 2, "along": 3}}}
request["report"] = {"stress_fields": ["near_collapse"]}
headers, _ = call("/v1/jobs", json.dumps(request).encode(), prefer="wait=20")
results = headers["location"] + "/results"
answer = json.loads(call(results)[1])
with tempfile.NamedTemporaryFile(suffix=".vtu") as file:
    file.write(call(results + "/fields/near_collapse?f=vtu")[1])
    file.flush()
    mesh = meshio.read(file.name)

subblocks = answer["stress_fields"][0]["subblocks"]
corners = [(x, y, 0.0) for xs, ys in zip(subblocks["corners_x_m"], subblocks["corners_y_m"]) for x, y in zip(xs, ys)]
assert np.array_equal(mesh.points, np.array(corners))
for name, values in subblocks.items():
    # The grid has one stress for every cell, and none at its corners.
    if name.endswith("_pa") and not name.startswith("corner_") or name in ("voussoir", "radial", "along"):
        read = np.concatenate([np.ravel(part) for part in mesh.cell_data[name]])
        assert np.array_equal(read, np.array(values)), name
moved, blocks = mesh.point_data["displacement_m"], answer["near_collapse"]["blocks"]
for body, (x, y) in enumerate(zip(blocks["displacement_x_m"], blocks["displacement_y_m"])):
    of_body = [i for i, corner in enumerate(np.repeat(subblocks["voussoir"], 4)) if corner == body]
    centre = np.array(answer["structure"]["bodies"][body]["centroid_m"])
    arm = mesh.points[of_body][:, :2] - centre
    turned = blocks["rotation_rad"][body] * np.stack([-arm[:, 1], arm[:, 0]], axis=1)
    assert np.allclose(moved[of_body][:, :2], np.array([x, y]) + turned, rtol=0, atol=1e-12), body
print(f"field.py: meshio reads {len(mesh.points)} points with stresses and displacements")
