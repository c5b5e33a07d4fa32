"""Run files made for tests, with every array of reports/run_file.md, so that no section is left out. The
times are drawn from a stated law, so that a test knows what the report must find in them.
"""
import json
import pathlib
import sys

import made_judged
import made_measured
import numpy
from made_rows import COSTS, INPUTS, MOVES_COST, SCENES, SIZES, described, rows  # noqa: F401  (tests call them made)

REPORTS = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(REPORTS))
H200 = REPORTS / "results" / "h200_tables.json"


def run(**options):
    """A whole run file, as a Python value."""
    generator = numpy.random.default_rng(3)
    times = lambda centre: (centre * generator.normal(1, 0.02, 8)).tolist()  # noqa: E731
    return {
        "context": {
            "date": "2026-11-21T05:10:04+00:00",
            "host_name": "vm",
            "num_cpus": 2,
            "mhz_per_cpu": 2600,
            "caches": [],
            "cpu": "a processor",
            "gpu": "a GPU",
            "compiler": "GNU 12.2.0",
            "flags": "-O3",
            "commit": "0123456789ab-dirty",
        },
        "benchmarks": rows(**options) + [
            {
                "name": "path1/n:1000/bGPU2+GPU2/find",
                "run_type": "iteration",
                "error_occurred": True,
                "error_message": "takes at most <1536>",
            }
        ],
        "catena": {
            "schema": 1,
            "variants": {variant: described(variant) for variant in (*COSTS, "bGPU2+GPU2")},
            "profile": "custom",
            "command": "catena report --quick --output report",
            "seconds": 12.5,
            "stopping": {
                "interval": "95 %",
                "share": 0.05,
                "seconds": 90.0,
                "most_samples": 9,
                "seed": 1,
                "cases": 9,
                "narrow": 5,
            },
            "scenes": [
                {
                    "input": i,
                    "scene": i.split("/")[0],
                    "n": int(i.split(":")[1]),
                    "frame": 28 if "path1" in i else "all",
                    "frames": 56,
                    "summary": "a path",
                    "hash": "00ff",
                    "pairs": 45,
                    "max_count": 2,
                    "density": 45 / int(i.split(":")[1]),
                    "smallest_margin": 1e-5,
                }
                for i in INPUTS
            ],
            "judged": made_judged.judged(),
            "pivots": made_measured.pivots(),
            "ranks": made_measured.ranks(),
            "counts": made_measured.counts(),
            "memory": made_measured.memory(),
            "steps": made_measured.steps(),
            "bandwidth": made_measured.bandwidth(),
            "keyframes": made_measured.keyframes(),
            "wants": made_measured.wants(times),
            "savings": made_measured.savings(times),
            "regret": made_measured.regret(times),
            "animation": made_measured.animation(),
            "coherence": made_measured.coherence(times),
            "stability": made_judged.stability(),
            "work_precision": made_judged.work_precision(),
            "tube_errors": made_judged.tube_errors(),
            "examine": made_judged.examine(),
            "motion": made_judged.motion(),
        },
    }


def write(folder, value, name="run.json"):
    path = pathlib.Path(folder) / name
    path.write_text(json.dumps(value))
    return path
