"""What a run file made for tests holds of judgements: answers and tubes, held against what is known of them."""
from made_rows import COSTS, SIZES


def judged():
    """What was published, found and not found."""
    return [
        {
            "source": source,
            "what": "self-avoiding walks of 8 steps, cubic lattice",
            "published": "387966",
            "found": found,
            "agrees": found == "387966",
            "command": "catena enumerate --walks 8",
        }
        for source, found in (("https://oeis.org/A001412", "387966"), ("nobody <b>", "387965"))
    ]


def stability():
    """Each arithmetic on extreme scenes: rounded ones fail in each way."""
    return [
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


def work_precision():
    """Error against time, by each variant."""
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
    return {"points": points, "left_out": ["CPU1: too slow", "CPU1/double: too slow"]}


def tube_errors():
    """Errors that fall about with the square of the spacing."""
    return [
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


def examine():
    """A tree that does not enclose."""
    return [
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
    ]


def motion():
    """A rope that slips through itself where the step is long or the arithmetic rounds."""
    return [
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
    ]
