"""How far a run's own samples can be trusted: how often it would call a thing different from itself, and the
smallest slowdown that it could have seen.
"""
import dataclasses
import functools

import numpy

from . import statistics

LEVEL = 1 - statistics.CONFIDENCE
SURE = 0.95  # a slowdown is seen when the test tells it with this probability
DRAWS = 200  # of both sides, for each case
FEWEST = 8  # samples: two halves of fewer than four can never be told apart


@dataclasses.dataclass(frozen=True)
class Certainty:
    cases: int  # with enough samples
    of: int  # timed cases in all
    false_alarms: int  # of the cases, those whose two halves the test calls different
    smallest: tuple  # the factor of a slowdown seen with probability SURE: half of the cases, nine in ten


@functools.lru_cache(maxsize=None)
def certainty(run):
    """Of all cases with FEWEST samples or more; None where there is none. Halves are the even and the odd
    rounds, so what changed slowly meets both.
    """
    cases = [times for _, times in sorted(run.samples.items()) if len(times) >= FEWEST]
    if not cases:
        return None
    alarms = sum(statistics.mann_whitney(times[::2], times[1::2]) < LEVEL for times in cases)
    generator = numpy.random.default_rng(1)
    seen = [smallest_slowdown(times, generator) for times in cases]
    half, most = numpy.quantile(seen, (0.5, 0.9))
    return Certainty(len(cases), len(run.samples), int(alarms), (float(half), float(most)))


def smallest_slowdown(times, generator):
    """The least factor by which a second run of as many samples must be slower for the Mann-Whitney test at
    LEVEL to tell it with probability SURE; both runs are drawn from the samples given.
    """
    size = len(times)
    old, new = generator.choice(times, (2, DRAWS, size))
    ratios = old[:, :, None] / numpy.maximum(new[:, None, :], statistics.LEAST_TIME)
    needed = numpy.sort(ratios.reshape(DRAWS, -1), axis=1)[:, critical(size) - 1]
    return max(1.0, float(numpy.quantile(needed, SURE)))


@functools.lru_cache(maxsize=None)
def critical(size):
    """The least U, of two samples of that size, at which the exact two-sided test rejects at LEVEL."""
    u = size * size
    while u > 0 and _p_of(u - 1, size) < LEVEL:
        u -= 1
    return u


def _p_of(u, size):
    """p of two samples of that size without ties whose second has U = u."""
    full, rest = divmod(u, size)
    below = [0] * (size - full - 1) + [rest] * (full < size) + [size] * full  # of the first, below each of the second
    first = numpy.arange(size, dtype=float)
    second = [count - 0.5 + at * 1e-6 for at, count in enumerate(below)]
    return statistics.mann_whitney(first, second)
