"""benchmarks[] of a run file made for tests: times of variants, drawn about lines in the number of spheres."""
import numpy

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

INPUTS = [f"{scene}/n:{n}" for scene in SCENES for n in SIZES]
EXACT = [variant for variant in COSTS if "/" not in variant]


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
