"""What a run file made for tests holds of measurements beside its rows; times(centre) draws eight times about that."""
from made_rows import EXACT, INPUTS, SCENES, SIZES


def rank_point(n, ranks, contacts):
    """What a chain costs that is shared out: a shell two blocks thick; 100 ns a sphere, 5 us a block that is asked for,
    2 us a rank, 30 us; and sends 24 bytes a sphere, 150 a block that is asked for, 40 a rank, in five messages to each
    other rank, if these are few, and 320 to many.
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
        "most_bytes": round(24 * n / ranks * (1 - 1 / ranks)) + 150 * asked + 40 * ranks * (ranks > 1),
        "most_messages": round(5 * (ranks - 1) / (1 + (ranks - 1) / 64)),
    }
    if ranks > 256:
        return point
    return point | {"pairs": contacts * n, "most_processor_ms": {"within": 1e-4 * n / ranks, "across": 1e-6 * across}}


def pivots():
    """Of a walk under the pivot algorithm: its speed, and many pivots at once beside a rebuild."""
    return {
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
    }


def ranks():
    """What ranks of two scenes exchange, and what that costs."""
    return {
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
    }


def counts():
    """What each exact variant counts, the later ones more."""
    return [
        {
            "input": i,
            "variant": v,
            "pair_tests": int(i.split(":")[1]) * (k + 3),
            "node_visits": int(i.split(":")[1]) * 20,
            "bytes": int(i.split(":")[1]) * 64,
        }
        for i in INPUTS
        for k, v in enumerate(EXACT)
    ]


def memory():
    """Bytes that variants of the host hold."""
    return [
        {
            "input": i,
            "variant": v,
            "held_bytes": 48 * int(i.split(":")[1]),
            "peak_bytes": 64 * int(i.split(":")[1]),
        }
        for i in INPUTS
        for v in EXACT
        if "GPU" not in v
    ]


def bandwidth():
    """Of an array that no cache holds, and of some as long as the chains: the shorter, the quicker."""
    copies = lambda rate: [rate * share for share in (1, 1.05, 0.95, 1.01, 0.99, 1)]  # noqa: E731
    return {
        "place": "host",
        "copied_bytes": 2**28,
        "gb_s": copies(10.0),
        "sizes": [{"copied_bytes": 32 * n, "gb_s": copies(20.0 * (len(SIZES) - k))} for k, n in enumerate(SIZES)],
    }


def steps():
    """Steps of two variants, the first of which counts two."""
    return [
        {
            "input": i,
            "variant": v,
            "pairs": 5 * int(i.split(":")[1]),
            "steps": [
                {"step": step, "times": int(i.split(":")[1]) * (k + 2)}
                for k, step in enumerate(("rows", "tests")[: 1 + (v == EXACT[0])])
            ],
        }
        for i in INPUTS
        for v in EXACT[:2]
    ]


def keyframes():
    """Pairs of each frame, of both scenes."""
    return [{"input": f"{scene}/n:10000", "pairs": [f % 46 for f in range(56)]} for scene in SCENES]


def wants(times):
    """Times by what is asked for."""
    return [
        {"input": INPUTS[0], "variant": v, "want": want, "ms": times(cost)}
        for v in EXACT
        for want, cost in (("any", 0.1), ("counts", 1), ("pairs", 1.5))
    ]


def savings(times):
    """Two of what is left out, of which one pays; and the scan over n, where all pairs pay up to 30 spheres."""
    return [
        {
            "input": INPUTS[1],
            "what": "pair list",
            "reason": "only counts were wanted",
            "with_ms": times(2),
            "without_ms": times(1),
            "identical": True,
        },
        {
            "input": INPUTS[1],
            "what": "radius stream",
            "reason": "radii are equal",
            "with_ms": times(2),
            "without_ms": times(2),
            "identical": True,
        },
        *[
            {
                "input": f"path1/n:{n}",
                "what": "hierarchy",
                "reason": f"{n} spheres: aCPU2+CPU2 against CPU1",
                "with_ms": times(n / 50),
                "without_ms": times(n * n / 2500),
                "identical": True,
            }
            for n in (10, 30, 100, 3000)
        ],
    ]


def regret(times):
    """What the choice of auto costs, the more the later the input."""
    return [
        {
            "input": i,
            "first": "Grid",
            "chosen": "Hybrid",
            "best": EXACT[0],
            "clock": "processor",
            "first_ms": times(5 + 3 * k),
            "best_first_ms": times(5),
            "auto_ms": times(2 + k),
            "best_ms": times(2),
        }
        for k, i in enumerate(INPUTS)
    ]


def animation():
    """Each frame of one scene, by each exact variant."""
    frames = lambda cost: [  # noqa: E731
        {
            "frame": f,
            "pairs": f % 46,
            "update_ms": cost,
            "find_ms": cost * (1 + f / 50),
            "moved": 100 + f,
        }
        for f in range(50)
    ]
    return [
        {"input": "path1/n:10000", "variant": v, "frames": frames(0.1 * (k + 1))}
        for k, v in enumerate(EXACT)
    ]


def coherence(times):
    """An update takes half of a rebuild."""
    return [
        {"input": i, "variant": v, "rebuild_ms": times(2), "update_ms": times(1)}
        for i in INPUTS
        for v in EXACT
    ]
