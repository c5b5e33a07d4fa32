"""Every claim of the paper that a run can test, each with its rule and its judge (judges.py)."""
import dataclasses
import math

from .judges import (
    FAILS,
    HOLDS,
    TOLERANCE,
    UNTESTED,
    Verdict,
    brute,
    encloses,
    faster,
    growth,
    half,
    limit,
    pairs,
    slowest,
)

__all__ = ["CLAIMS", "FAILS", "HOLDS", "UNTESTED", "Claim", "Verdict"]


@dataclasses.dataclass(frozen=True)
class Claim:
    key: str
    text: str
    where: str  # in the paper
    rule: str
    judge: object  # Run -> Verdict


def _rule(name):
    return (
        f"Fit time / {name} = a n^b over all sizes of path1 and path2. Holds if the 95 % interval of b ends"
        f" at or below {TOLERANCE}, does not hold if it begins above {TOLERANCE}, otherwise not testable."
    )


def _law(name):
    return {
        "n^2": lambda n: n * n,
        "n log n": lambda n: n * math.log2(n),
        "n": float,
        "log n": math.log2,
        "log s + r": lambda n: math.log2(384) + n / 384,
    }[name]


def _growing(algorithm, law, where, text=None):
    return Claim(
        f"growth-{algorithm}-{law.replace(' ', '')}",
        text or f"{algorithm} takes O({law}) time.",
        where,
        _rule(f"({law})"),
        growth(algorithm, _law(law), law),
    )


CLAIMS = [
    _growing("CPU1", "n^2", "Section 3"),
    _growing("GPU1", "n", "Section 3", "GPU1 takes O(n) time, since its n threads run in parallel."),
    _growing("aCPU2", "n log n", "Table 1"),
    _growing("bGPU2", "log n", "Table 1"),
    _growing("aGPU2", "log s + r", "Table 1", "aGPU2 takes O(log s + r) time for r subtrees of s leaves."),
    _growing("CPU2", "n log n", "Table 2"),
    _growing("GPU2", "log n", "Table 2", "GPU2 takes O(log n) time, since its n threads run in parallel."),
    _growing("GPUv2", "log n", "Table 2", "GPUv2 takes 1/2 O(log n) time: it grows as log n."),
    Claim(
        "half",
        "Two threads per sphere (GPUv2) reduce the time of GPU2 by half.",
        "Sections 3 and 5.2",
        (
            "Geometric mean of median GPUv2 / median GPU2 over all sizes of both paths. Holds if its 95 %"
            " interval ends at or below 0.55, does not hold if it begins above."
        ),
        half,
    ),
    Claim(
        "build-20000",
        "aGPU2 is faster than aCPU2 from 20,000 spheres on.",
        "Section 6",
        (
            "Holds if the 95 % interval of the ratio of medians is below 1 at every measured n of 20,000 or"
            " more, does not hold if it is above 1 at any."
        ),
        faster("aGPU2", "aCPU2", 20000, "build"),
    ),
    Claim(
        "gpu1-slowest",
        "Despite the GPU, GPU1 is the slowest traversal.",
        "Section 6",
        (
            "Holds if at every n with all four timed, GPU1's time over that of CPU2, GPU2 and GPUv2 has a 95"
            " % interval above 1."
        ),
        slowest,
    ),
    Claim(
        "cpu2-exceeded-gpu2",
        "CPU2 is exceeded by GPU2 when the number of spheres passes 50,000.",
        "Section 6",
        "As for aGPU2, at every measured n above 50,000.",
        faster("GPU2", "CPU2", 50001, "find"),
    ),
    Claim(
        "cpu2-exceeded-gpuv2",
        "CPU2 is exceeded by GPUv2 when the number of spheres passes 50,000.",
        "Section 6",
        "As for aGPU2, at every measured n above 50,000.",
        faster("GPUv2", "CPU2", 50001, "find"),
    ),
    Claim(
        "pairs",
        "Both paths generate a maximum of 45 pairs of collisions.",
        "Section 6",
        (
            "The largest number of pairs must be 45 on both paths. More in any frame counts against it; otherwise it"
            " is decided only when every keyframe of both paths was run."
        ),
        pairs,
    ),
    Claim(
        "cpu1-slow",
        "CPU1 needs 1,500 ms or more for 10,000 spheres.",
        "Section 6",
        "Holds if the interval of the median lies at or above 1,500 ms.",
        brute,
    ),
    Claim(
        "limit",
        "aGPU2 takes at most 589,824 leaf spheres.",
        "Section 4.3",
        "Does not hold if a longer chain was built.",
        limit,
    ),
    Claim(
        "encloses",
        "A parent encloses its two children.",
        "Section 4.1",
        (
            "The paper's formulas in binary32, checked in exact arithmetic (catena examine): holds if no"
            " parent fails."
        ),
        encloses,
    ),
]
