"""A model of what ranks cost: how much they ask of one another, how long the busiest takes, and where more of them stop
paying. Fitted to runs of up to FITTED ranks; more are what it is checked with.
"""
import dataclasses

import numpy
import scipy.optimize

FITTED = 64  # ranks
LEAST = 4  # points that a law is fitted to
EVER = 2**24  # ranks that are looked at for the best number of them


@dataclasses.dataclass(frozen=True)
class Law:
    """asked = factor * held ** exponent, of blocks: of the rank that asks most, and an even share."""

    factor: float
    exponent: float

    def asked(self, held):
        return self.factor * held**self.exponent


@dataclasses.dataclass(frozen=True)
class Model:
    """Processor time of the busiest rank: sphere_ns for each sphere of a share, asked_ns for each block that it asks for,
    rank_ns for each rank that there is, fixed_ns once. `blocks` is that of a sphere; `error` the median factor between the
    model and what it was fitted to, as a ratio of at least 1.
    """

    law: Law
    blocks: float
    sphere_ns: float
    asked_ns: float
    rank_ns: float
    fixed_ns: float
    error: float

    def ms(self, n, ranks):
        asked = self.law.asked(self.blocks * n / ranks) if ranks > 1 else 0
        return 1e-6 * (self.sphere_ns * n / ranks + self.asked_ns * asked + (self.rank_ns * ranks + self.fixed_ns) * (ranks > 1))

    def efficiency(self, n, ranks):
        return self.ms(n, 1) / (ranks * self.ms(n, ranks))

    def best(self, n):
        """The ranks, a power of two, with which the busiest takes least: more are slower."""
        return min(_doubled(), key=lambda ranks: self.ms(n, ranks))

    def half(self, n):
        """The most ranks, a power of two, of which no more than half is lost."""
        fit = 1
        for ranks in _doubled():
            if self.efficiency(n, ranks) < 0.5:
                break
            fit = ranks
        return fit


def _doubled():
    ranks = 1
    while ranks <= EVER:
        yield ranks
        ranks *= 2


def busiest_ms(point):
    """Processor time of a search, each phase that of the rank which takes longest in it; None where it was not timed."""
    times = point.get("most_processor_ms")
    return sum(times.values()) if times else None


def law(points):
    """Of points that were timed, or None for too few."""
    told = [p for p in points if p.get("most_processor_ms") and 1 < p["ranks"] <= FITTED and p["most_blocks_asked"] > 0]
    if len(told) < LEAST:
        return None
    held = numpy.log([p["blocks"] / p["ranks"] for p in told])
    exponent, factor = numpy.polyfit(held, numpy.log([p["most_blocks_asked"] for p in told]), 1)
    return Law(float(numpy.exp(factor)), float(exponent))


def model(chains):
    """Of the chains of one scene ({n, points}), or None for too few points. Relative errors are what is least."""
    fitted_law = law([point for chain in chains for point in chain["points"]])
    told = [
        (chain["n"], p["ranks"], p["most_blocks_asked"], busiest_ms(p))
        for chain in chains
        for p in chain["points"]
        if p["ranks"] <= FITTED and busiest_ms(p)
    ]
    if fitted_law is None or len(told) < 2 * LEAST:
        return None
    rows = numpy.array([[n / ranks, asked, ranks * (ranks > 1), ranks > 1] for n, ranks, asked, _ in told], float)
    times = numpy.array([1e6 * ms for *_, ms in told])
    factors, _ = scipy.optimize.nnls(rows / times[:, None], numpy.ones(len(told)))
    blocks = numpy.mean([p["blocks"] / chain["n"] for chain in chains for p in chain["points"]])
    error = numpy.median(numpy.exp(numpy.abs(numpy.log(rows @ factors / times))))
    return Model(fitted_law, float(blocks), *map(float, factors), float(error))


def excess(point):
    """Blocks asked for over those that truly touch, of all ranks; None where none do."""
    return point["blocks_asked"] / point["blocks_touching"] if point["blocks_touching"] else None


def checked(chains, fitted):
    """[(n, ranks, asked by the law, asked as counted)] of the rank that asks most, beyond the ranks that were fitted."""
    return [
        (chain["n"], p["ranks"], fitted.asked(p["blocks"] / p["ranks"]), p["most_blocks_asked"])
        for chain in chains
        for p in chain["points"]
        if p["ranks"] > FITTED and p["most_blocks_asked"]
    ]
