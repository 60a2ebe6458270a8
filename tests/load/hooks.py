"""Gives schemathesis requests that describe an arch: what it makes up itself is nearly always refused for its geometry."""

import json
import pathlib
import random

import schemathesis

CASES = [
    json.loads(path.read_text())
    for path in sorted(pathlib.Path(__file__).parents[2].glob("cases/**/request.json"))
    if len(path.read_text()) < 20_000
]
SMALL = [case for case in CASES if case.get("geometry") != "updated" and "motion" not in case]
for case in SMALL:
    if "arch" in case and "analysis" not in case:
        case.setdefault("report", {}).setdefault("stress_fields", ["near_collapse"])
dice = random.Random(1)


@schemathesis.hook
def before_call(context, case, **kwargs):
    """Every other well-formed submission becomes a ready one."""
    known = case.operation.path in ("/v1/jobs", "/v1/validate") and case.method == "POST"
    positive = case.meta is None or case.meta.generation.mode.value == "positive"
    if known and positive and dice.random() < 0.5:
        case.body = dice.choice(SMALL)
