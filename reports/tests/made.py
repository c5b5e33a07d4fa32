"""Run files made for tests, with every array of reports/run_file.md, so that no section is left out. The
times are drawn from a stated law, so that a test knows what the report must find in them.
"""
import json
import pathlib
import sys

import numpy

REPORTS = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(REPORTS))
H200 = REPORTS / "results" / "h200_tables.json"

SIZES = (1000, 3000, 10000, 100000)
SCENES = ("path1", "path2")
# variant -> milliseconds a sphere of build and find; all linear in n
COSTS = {
    "aCPU2+CPU2": (1e-4, 8e-4),
    "aCPU2+Dual": (1e-4, 2e-4),
    "aGPU2+GPU2": (2e-5, 1e-4),
    "aGPU2+GPUv2": (2e-5, 5e-5),
    "GPU1": (None, 2e-3),
    "aCPU2+CPU2/literal": (8e-5, 6e-4),
}
UPDATE_COST = 0.5  # of a build
MOVES_COST = {"aGPU2+GPUv2": 4e-4}  # a sphere, between memories: only the whole call has it


def described(name):
    """The entry of `catena.variants` that catena writes for a variant of these tests."""
    stages, _, arithmetic = name.partition("/")
    stages = [
        {
            "text": text,
            "strategy": text.partition("(")[0],
            "algorithm": text.partition("@")[0].partition("(")[0],
            "on_host": "@host" in text,
            "settings": {},
            "place": "device" if "GPU" in text and "@host" not in text else "host",
        }
        for text in stages.split("+")
    ]
    peer = name == "FCL"
    return {
        "stages": stages,
        "arithmetic": "binary64" if peer else arithmetic or "robust",
        "exact": not arithmetic and not peer,
        "has_tree": len(stages) == 2,
        "all_pairs": len(stages) == 1 and not peer,
        "peer": peer,
        "on_device": any(stage["place"] == "device" for stage in stages),
    }


def rows(repetitions=8, noise=0.03, slower=None, seed=7):
    """benchmarks[]; `slower` is {(variant, stage): factor}."""
    generator = numpy.random.default_rng(seed)
    found = []
    for repetition in range(repetitions):
        for scene in SCENES:
            for n in SIZES:
                for variant, costs in COSTS.items():
                    for stage, cost in zip(("build", "find"), costs):
                        if cost is None:
                            continue
                        time = cost * n * (slower or {}).get((variant, stage), 1) * generator.normal(1, noise)
                        found.append(
                            {
                                "name": f"{scene}/n:{n}/{variant}/{stage}/manual_time",
                                "run_type": "iteration",
                                "iterations": 10,
                                "repetition_index": repetition,
                                "real_time": time * 1e6,
                                "time_unit": "ns",
                                "pairs": 45.0,
                                "missing": 0.0,
                                "invented": 0.0,
                            }
                        )
    return found + wholes(repetitions, noise, slower or {}) + updates(repetitions, noise)


def wholes(repetitions, noise, slower):
    """Rows of the whole call: both stages and what is moved between memories."""
    generator = numpy.random.default_rng(21)
    return [
        {
            "name": f"{scene}/n:{n}/{variant}/whole/manual_time",
            "run_type": "iteration",
            "iterations": 10,
            "repetition_index": repetition,
            "real_time": n * generator.normal(1, noise) * 1e6
            * sum((cost or 0) * slower.get((variant, stage), 1) for stage, cost in zip(("build", "find"), costs))
            + 1e6 * n * MOVES_COST.get(variant, 0),
            "time_unit": "ns",
        }
        for repetition in range(repetitions)
        for scene in SCENES
        for n in SIZES
        for variant, costs in COSTS.items()
    ]


def updates(repetitions, noise):
    """Rows of the constructions that update path1, which moves; path2 does not here."""
    generator = numpy.random.default_rng(12)
    return [
        {
            "name": f"path1/n:{n}/{variant}/update/manual_time",
            "run_type": "iteration",
            "iterations": 10,
            "repetition_index": repetition,
            "real_time": UPDATE_COST * build * n * generator.normal(1, noise) * 1e6,
            "time_unit": "ns",
        }
        for repetition in range(repetitions)
        for n in SIZES
        for variant, (build, _) in COSTS.items()
        if build is not None
    ]


def rank_point(n, ranks, contacts):
    """What a chain costs that is shared out: a shell two blocks thick; 100 ns a sphere, 5 us a block that is asked for,
    2 us a rank, 30 us.
    """
    blocks, held = n // 8, n / 8 / ranks
    asked = round(contacts * ((held ** (1 / 3) + 2) ** 3 - held) * (1 - ranks ** (-1 / 3)))
    across = 5000 * asked + (2000 * ranks + 30_000) * (ranks > 1)
    point = {
        "ranks": ranks,
        "order": "space" if ranks > 1 else "chain",
        "blocks": blocks,
        "most_spheres": n // ranks,
        "most_rounds": 2,
        "blocks_asked": ranks * asked,
        "blocks_touching": round(ranks * asked * (0.8 if ranks < 64 else 0.4)),
        "most_blocks_asked": asked,
        "most_bytes": 150 * asked,
        "most_messages": ranks - 1,
    }
    if ranks > 256:
        return point
    return point | {"pairs": contacts * n, "most_processor_ms": {"within": 1e-4 * n / ranks, "across": 1e-6 * across}}


def run(**options):
    """A whole run file, as a Python value."""
    generator = numpy.random.default_rng(3)
    times = lambda centre: (centre * generator.normal(1, 0.02, 8)).tolist()  # noqa: E731
    inputs = [f"{scene}/n:{n}" for scene in SCENES for n in SIZES]
    exact = [variant for variant in COSTS if "/" not in variant]
    stability = [
        {
            "scene": f"{scene}:n=500",
            "n": 500,
            "variant": variant,
            "arithmetic": "literal" if "/" in variant else "robust",
            "outcome": outcome,
            "defect": False,
            "exact_pairs": 10,
            "missing": 3 * (outcome == "wrong"),
            "invented": 0,
            "worst_margin": "inf" if outcome == "not finite" else 1e-7,
            "wrong_counts": 2 * (outcome == "wrong"),
            "bounds": 900,
            "unenclosed": 5 * (outcome == "unenclosed"),
            "worst_shortfall": 1e-7 if outcome == "unenclosed" else 0.0,
            "not_finite_nodes": int(outcome == "not finite"),
            "reason": outcome,
        }
        for scene in ("grazing", "lattice", "far")
        for variant in COSTS
        for outcome in [
            (
                {"grazing": "wrong", "lattice": "unenclosed", "far": "not finite"}[scene]
                if "/" in variant
                else "exact"
            )
        ]
    ]
    errors = [
        {
            "tube": tube,
            "n": int(100 / h),
            "spacing": h,
            "gap": a * h * h,
            "volume_deficit": h * h / 12,
            "depth_error": a * h**1.9 / 2,
        }
        for tube, a in (("helix", 0.2), ("rod", 0.125))
        for h in (2, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)
    ]
    points = [
        {
            "tube": "helix",
            "n": n,
            "variant": variant,
            "arithmetic": "robust",
            "tube_error": 10 / n,
            "answer_error": 0.0,
            "repetitions": 5,
            "least_ms": cost * n,
            "lower_quartile_ms": cost * n,
            "median_ms": cost * n * 1.1,
            "upper_quartile_ms": cost * n * 1.2,
            "front": variant == "aGPU2+GPUv2",
            "dominated_by": 0,
        }
        for variant, (_, cost) in COSTS.items()
        for n in SIZES
    ]
    frames = lambda cost: [
        {
            "frame": f,
            "pairs": f % 46,
            "update_ms": cost,
            "find_ms": cost * (1 + f / 50),
            "moved": 100 + f,
        }  # noqa: E731
        for f in range(50)
    ]
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
                for i in inputs
            ],
            "judged": [
                {
                    "source": source,
                    "what": "self-avoiding walks of 8 steps, cubic lattice",
                    "published": "387966",
                    "found": found,
                    "agrees": found == "387966",
                    "command": "catena enumerate --walks 8",
                }
                for source, found in (("https://oeis.org/A001412", "387966"), ("nobody <b>", "387965"))
            ],
            "pivots": {
                "speed": {
                    "n": 1000,
                    "warm_up": 4000,
                    "attempts": 64000,
                    "acceptance": 0.25,
                    "us_per_attempt": 1.5,
                    "bytes_per_point": 12.0,
                    "published_us": 3.875,
                    "published_by": "somebody <b>",
                },
                "at_once": [
                    {
                        "n": n,
                        "pivots": k,
                        "attempts": 64,
                        "acceptance": 0.5 / k,
                        "us_per_attempt": 2.0 * k,
                        "rebuild_us": 80.0,
                        "times": 40.0 / k,
                        "agree": True,
                    }
                    for n in (100, 1000)
                    for k in (1, 8, 64)
                ],
                "rebuilt": "Hybrid",
            },
            "ranks": {
                "searched_by": "Hybrid",
                "chains": [
                    {
                        "input": f"{scene}:n={n}",
                        "n": n,
                        "points": [rank_point(n, ranks, contacts) for ranks in (1, 2, 4, 8, 16, 32, 64, 256, 1024)],
                    }
                    for scene, contacts in (("yarn", 4), ("hair", 1))
                    for n in (64_000, 512_000)
                ],
            },
            "counts": [
                {
                    "input": i,
                    "variant": v,
                    "pair_tests": int(i.split(":")[1]) * (k + 3),
                    "node_visits": int(i.split(":")[1]) * 20,
                    "bytes": int(i.split(":")[1]) * 64,
                }
                for i in inputs
                for k, v in enumerate(exact)
            ],
            "memory": [
                {
                    "input": i,
                    "variant": v,
                    "held_bytes": 48 * int(i.split(":")[1]),
                    "peak_bytes": 64 * int(i.split(":")[1]),
                }
                for i in inputs
                for v in exact
                if "GPU" not in v
            ],
            "steps": [
                {
                    "input": i,
                    "variant": v,
                    "pairs": 5 * int(i.split(":")[1]),
                    "steps": [
                        {"step": step, "times": int(i.split(":")[1]) * (k + 2)}
                        for k, step in enumerate(("rows", "tests")[: 1 + (v == exact[0])])
                    ],
                }
                for i in inputs
                for v in exact[:2]
            ],
            "bandwidth": {"place": "host", "copied_bytes": 2**28, "gb_s": [10.0, 10.5, 9.5, 10.1, 9.9, 10.0]},
            "keyframes": [{"input": f"{scene}/n:10000", "pairs": [f % 46 for f in range(56)]} for scene in SCENES],
            "wants": [
                {"input": inputs[0], "variant": v, "want": want, "ms": times(cost)}
                for v in exact
                for want, cost in (("any", 0.1), ("counts", 1), ("pairs", 1.5))
            ],
            "savings": [
                {
                    "input": inputs[1],
                    "what": "pair list",
                    "reason": "only counts were wanted",
                    "with_ms": times(2),
                    "without_ms": times(1),
                    "identical": True,
                },
                {
                    "input": inputs[1],
                    "what": "radius stream",
                    "reason": "radii are equal",
                    "with_ms": times(2),
                    "without_ms": times(2),
                    "identical": True,
                },
            ],
            "regret": [
                {
                    "input": i,
                    "first": "Grid",
                    "chosen": "Hybrid",
                    "best": exact[0],
                    "clock": "processor",
                    "first_ms": times(5 + 3 * k),
                    "best_first_ms": times(5),
                    "auto_ms": times(2 + k),
                    "best_ms": times(2),
                }
                for k, i in enumerate(inputs)
            ],
            "animation": [
                {"input": "path1/n:10000", "variant": v, "frames": frames(0.1 * (k + 1))}
                for k, v in enumerate(exact)
            ],
            "coherence": [
                {"input": i, "variant": v, "rebuild_ms": times(2), "update_ms": times(1)}
                for i in inputs
                for v in exact
            ],
            "stability": stability,
            "work_precision": {"points": points, "left_out": ["CPU1: too slow", "CPU1/double: too slow"]},
            "tube_errors": errors,
            "examine": [
                {
                    "input": "rod:n=1000",
                    "n": 1000,
                    "arithmetic": "literal",
                    "exact_pairs": 0,
                    "parents": 999,
                    "failing": 500,
                    "worst_shortfall": 1e-5,
                    "missing": 2,
                    "lost_by_tree": 2,
                    "invented": 0,
                    "levels": [],
                }
            ],
            "motion": [
                {
                    "stiffness": 100.0,
                    "step": step,
                    "offset": 0.0,
                    "n": 120,
                    "frames": 51,
                    "variant": v,
                    "outcome": outcome,
                    **({} if outcome == "holds" else {"failed_at": 72.0}),
                    "energy_drift": step,
                    "deepest_penetration": step / 10,
                    "contacts": 300,
                    "missed_by_variant": 2 * ("/" in v),
                    "invented_by_variant": 1 * ("/" in v),
                    "reference_step": 0.1,
                    "missed_against_fine_step": 3,
                    "ms_median": 100 / step,
                    "ms_lower": 90 / step,
                    "ms_upper": 110 / step,
                    "starts": [
                        {
                            "seed": seed,
                            "outcome": outcome if seed % 8 else "holds",
                            "failed_at": None if outcome == "holds" else 70.0,
                            "energy_drift": step,
                            "contacts": 300,
                            "missed": 2 * ("/" in v),
                            "invented": 0,
                        }
                        for seed in range(1, 33)
                    ],
                }
                for v in ("aCPU2+CPU2", "aCPU2+Dual", "aCPU2+CPU2/literal")
                for step, outcome in ((2.0, "slipped"), (1.0, "slipped" if "/" in v else "holds"))
            ],
        },
    }


def write(folder, value, name="run.json"):
    path = pathlib.Path(folder) / name
    path.write_text(json.dumps(value))
    return path
