#!/usr/bin/env python3
"""Holds cases/check.py against every case, random structures and forged answers.

    python3 tests/proof/run.py target/debug/voussoir [random structures, 60 unless told]

Exit code 1 where a proof fails or a forgery passes."""
import copy, json, math, pathlib, random, subprocess, sys, tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECK = [sys.executable, ROOT / "cases" / "check.py"]


def solve(voussoir, request):
    """The answer to a request; None where it is refused."""
    done = subprocess.run([voussoir, "solve", "--json", "-"], input=json.dumps(request), capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else None


def checked(folder, answers):
    """Names of the answers that check.py does not prove."""
    files = []
    for name, answer in answers.items():
        files.append(folder / f"{name}.json")
        files[-1].write_text(json.dumps(answer))
    done = subprocess.run([*CHECK, *files], capture_output=True, text=True)
    failed = {line.split(".json:")[0].rsplit("/")[-1] for line in done.stdout.splitlines() if "NOT PROVED" in line}
    if done.returncode != (1 if failed else 0):
        sys.exit(done.stderr)
    return failed, done.stdout


def profile(dice, radius):
    opening, offset = dice.uniform(90, 180), dice.uniform(0.1, 0.6)
    shapes = [{"circular": {"radius_m": radius, "opening_angle_deg": opening}},
              {"circular": {"span_m": 2 * radius, "rise_m": radius * dice.uniform(0.3, 1)}},
              {"elliptical": {"span_m": 2 * radius, "rise_m": radius * dice.uniform(0.4, 1)}},
              {"pointed": {"radius_m": radius, "centre_offset_m": offset * radius}}]
    return dice.choice(shapes)


def arch(dice):
    radius, line = dice.uniform(2, 10), dice.choice(["axis", "intrados"])
    whole = {"profile": profile(dice, radius), "line": line, "voussoirs": dice.randint(5, 40),
             "thickness": {"constant_m": radius * dice.uniform(0.06, 0.25)}}
    ends = dice.choice([{}, {}, {"abutments": {"height_m": 1}}, {"springing_joints": "bonded"}])
    return {"arch": whole | ends}, radius


def bridge(dice):
    spans, radius = dice.randint(1, 3), dice.uniform(2, 6)
    rings = [{"thickness_m": radius * dice.uniform(0.06, 0.15), "voussoirs": dice.randint(7, 21)} for _ in range(dice.randint(1, 2))]
    width, height = radius * dice.uniform(0.5, 1), radius * dice.uniform(0.5, 2)
    piers = [{"top_width_m": width, "height_m": height, "courses": dice.randint(1, 6)}] * (spans - 1)
    backing = {"backing": {"level_m": radius * dice.uniform(0.1, 0.3)}} if dice.random() < 0.3 else {}
    segment = {"circular": {"span_m": 2 * radius, "rise_m": radius * dice.uniform(0.4, 0.9)}}
    return {"bridge": {"spans": [{"profile": segment, "rings": rings}] * spans, "piers": piers} | backing}, radius * spans


def wall(dice):
    courses, columns, width, height = dice.randint(2, 7), dice.randint(1, 5), 0.4, dice.uniform(0.1, 0.3)
    polygons = []
    for course in range(courses):
        edges = [0] + [k + 0.5 * (course % 2) for k in range(1 - course % 2, columns)] + [columns]
        for left, right in zip(edges, edges[1:]):
            if left < right and (course == 0 or dice.random() > 0.03):
                box = [(left, course), (right, course), (right, course + 1), (left, course + 1)]
                polygons.append({"name": f"b{len(polygons)}", "corners_m": [[width * x, height * y] for x, y in box]})
    ground = [{"name": "ground", "segments_m": [[[-1, 0], [width * columns + 1, 0]]]}]
    return {"blocks": {"polygons": polygons, "joints": "found", "supports": ground}}, None


def scene(seed):
    dice = random.Random(seed)
    request, reach = dice.choice([arch, bridge, wall])(dice)
    request["stone"] = {"friction_angle_deg": dice.uniform(15, 45), "cohesion_pa": dice.choice([0, 0, 1e3])}
    grows = [{"body_acceleration": dice.choice([{"x_g": 1}, {"x_g": 1, "y_g": dice.uniform(-1, 1)}, {"y_g": dice.uniform(-1, 1)}])}]
    stays = [{"self_weight": {}}]
    if reach:
        grows.append({"point_load": {"force_n_per_m": 1000, "x_m": dice.uniform(-0.6, 0.6) * reach}})
        grows.append({"patch_load": {"force_n_per_m": 1000, "centre_x_m": dice.uniform(-0.4, 0.4) * reach, "width_m": 0.1 * reach}})
        fill = dice.random()
        stays += [{"fill_pressure": {"fill_height_m": dice.uniform(0.2, 2) * reach}}] if fill < 0.3 else []
        if fill > 0.6:
            passive = {"factor": dice.uniform(0, 1), "least": dice.choice(["none", "active"])}
            request["backfill"] = {"surface_height_m": dice.uniform(0.2, 2) * reach, "passive": passive}
    loads = [(load, False) for load in stays] + [(dice.choice(grows), True)]
    request["loads"] = [{"load": load, "scaled": scaled} for load, scaled in loads]
    return request


def forgeries(answer):
    """The same answer, made better or worse in ways that a reader might believe."""
    def changed(change):
        forged = copy.deepcopy(answer)
        change(forged)
        return forged

    def load(forged, factor):
        forged["limit_window_load_factor"][1] = forged["proof"]["highest"]["load_factor"] = factor

    def at_end(forged, name):
        return forged["proof"]["highest"]["forces"][name]

    end = answer["proof"]["highest"]["load_factor"]
    pressed = max(range(len(answer["structure"]["joints"])), key=lambda k: at_end(answer, "intrados_n_per_m")[k])
    motion = answer["proof"]["highest"]["motion"]
    moving = max(range(len(motion["x"])), key=lambda k: math.hypot(motion["x"][k], motion["y"][k]))
    crushing = {
        "a stronger stone": changed(lambda of: [joint.update(compressive_strength_pa=1.1 * joint["compressive_strength_pa"]) for joint in of["structure"]["joints"]]),
        "a weaker stone": changed(lambda of: [joint.update(compressive_strength_pa=0.9 * joint["compressive_strength_pa"]) for joint in of["structure"]["joints"]]),
        "a crushing end beyond its load": changed(lambda of: of["ends"][0].update(load_factor=1.01 * of["ends"][0]["load_factor"])),
        "hinges of stone that does not crush": changed(lambda of: of["ends"][0].update(of["ends"][0]["without_crushing"])),
        "joints that do not crush": changed(lambda of: of["ends"][0].update(governed_by="instability")),
    } if answer["ends"][0]["governed_by"] == "crushing" else {}
    pressing = answer["proof"]["highest"]["passive_n_per_m"]
    most = max(range(len(pressing)), key=pressing.__getitem__, default=None)
    soil = {
        "soil that resists less": changed(lambda of: [e.update(most_n_per_m=0.9 * e["most_n_per_m"]) for e in of["structure"]["passive_elements"]]),
        "soil that resists more": changed(lambda of: [e.update(most_n_per_m=1.1 * e["most_n_per_m"]) for e in of["structure"]["passive_elements"]]),
        "soil that does not press": changed(lambda of: of["proof"]["highest"].update(passive_n_per_m=[0] * len(pressing))),
        "soil that pulls": changed(lambda of: of["proof"]["highest"]["passive_n_per_m"].__setitem__(most, -pressing[most])),
        "an end whose soil does not press": changed(lambda of: of["ends"][0].update(passive_n_per_m=[])),
        "soil elsewhere": changed(lambda of: [e["at_m"].__setitem__(1, e["at_m"][1] + 0.1) for e in of["structure"]["passive_elements"]]),
    } if pressing else {}
    return crushing | soil | {
        "no proof": changed(lambda of: of.update(proof=None, limit_window=None, limit_window_load_factor=None)),
        "a higher end": changed(lambda of: load(of, 1.01 * end)),
        "a lower end": changed(lambda of: load(of, 0.99 * end)),
        "a window wider than its proof": changed(lambda of: of["limit_window_load_factor"].__setitem__(1, 1.01 * end)),
        "a collapse at less than is borne": changed(lambda of: of["ends"][0].update(load_factor=0.9 * end)),
        "a joint that pulls": changed(lambda of: at_end(of, "intrados_n_per_m").__setitem__(pressed, -at_end(of, "intrados_n_per_m")[pressed])),
        "a joint with more shear": changed(lambda of: at_end(of, "shear_n_per_m").__setitem__(pressed, 1.1 * at_end(of, "intrados_n_per_m")[pressed])),
        "a lighter stone": changed(lambda of: of["structure"]["bodies"][moving]["fixed_load"].update(y_n_per_m=0)),
        "a stone that stands still": changed(lambda of: [of["proof"]["highest"]["motion"][axis].__setitem__(moving, 0) for axis in motion]),
        "a joint elsewhere": changed(lambda of: of["structure"]["joints"][pressed]["ends_m"][0].__setitem__(0, of["structure"]["joints"][pressed]["ends_m"][0][0] + 0.1)),
        "a thrust line of another load": changed(lambda of: of["ends"][0]["thrust_line"].update(normal_n_per_m=[1.01 * n for n in of["ends"][0]["thrust_line"]["normal_n_per_m"]])),
        "less friction": changed(lambda of: [joint.update(friction_coefficient=0.01) for joint in of["structure"]["joints"]]),
        "a motion that closes joints": changed(lambda of: of["proof"]["highest"].update(motion={axis: [-v for v in column] for axis, column in motion.items()})),
    }


def main():
    voussoir, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 60
    requests = {path.parent.name: json.loads(path.read_text()) for path in sorted((ROOT / "cases").glob("*/request.json"))}
    requests["crushing on the path"] = requests["first-arch"] | {"stone": {"compressive_strength_pa": 2e9}, "crushing_in_path": True}
    answers = {name: solve(voussoir, request) for name, request in requests.items()}
    # The last ends where rounding takes its equilibrium from the path.
    scenes = {f"random {seed}": solve(voussoir, scene(seed)) for seed in [*range(count), 11497]}
    refused = [name for name, answer in (answers | scenes).items() if answer is None]
    whole = {name: answer for name, answer in (answers | scenes).items() if answer and answer.get("proof")}
    forged = {f"{name}: {how}": answer for name in ("first-arch", "wall", "resisting-backfill") for how, answer in forgeries(answers[name]).items()}
    # Where joints crush on the path forces need to balance to a thousandth only, and the window bounds the load.
    hard = copy.deepcopy(answers["crushing on the path"])
    hard["ends"][0]["load_factor"] = 1.0005 * hard["limit_window_load_factor"][1]
    forged["crushing on the path: beyond the window"] = hard
    with tempfile.TemporaryDirectory() as folder:
        unproved, said = checked(pathlib.Path(folder), whole)
        refuted, _ = checked(pathlib.Path(folder), {str(k): answer for k, answer in enumerate(forged.values())})
    passed = [name for k, name in enumerate(forged) if str(k) not in refuted]
    print(f"{len(whole)} answers, {len(whole) - len(unproved)} proved, {said.count('by sliding')} of them slide below the upper bound, {said.count('by crushing')} crush")
    print(f"{len(refused)} requests without an answer, {len((answers | scenes)) - len(refused) - len(whole)} answers without a window to prove")
    print(f"{len(forged)} forgeries, {len(refuted)} refuted")
    for name in [*unproved, *passed]:
        print("  wrong:", name)
    sys.exit(bool(unproved or passed or len(whole) < 0.9 * len(requests | scenes)))


main()
