"""A model of what ranks cost: how much they ask of one another, how long the busiest takes, and where more of them stop
paying. Fitted to runs of up to FITTED ranks; more are what it is checked with.
"""
import dataclasses

import numpy
import scipy.optimize

FITTED = 256  # ranks
LEAST = 4  # points that a law is fitted to
EVER = 2**24  # ranks that are looked at for the best number of them
NEIGHBOURS = numpy.geomspace(4, 4096, 81)  # numbers of them that are tried
THICKNESS = numpy.linspace(0, 6, 61)  # of shells that are tried, in blocks


def shell(held, ranks, thickness):
    """Blocks around a cube of `held` blocks, `thickness` of them deep, as far as other ranks are there: of R cubes in a
    cube the share 1 - R^(-1/3) of all sides is a side of two.
    """
    return ((numpy.cbrt(held) + thickness) ** 3 - held) * (1 - numpy.cbrt(1 / ranks))


@dataclasses.dataclass(frozen=True)
class Law:
    """asked = factor * shell(held, R, thickness), of blocks: of the rank that asks most, and an even share."""

    factor: float
    thickness: float

    def asked(self, held, ranks):
        return float(self.factor * shell(held, ranks, self.thickness))


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
        if ranks == 1:
            return 1e-6 * self.sphere_ns * n
        return 1e-6 * (self.sphere_ns * n / ranks + self.asked_ns * self.asked(n, ranks) + self.rank_ns * ranks + self.fixed_ns)

    def asked(self, n, ranks):
        return self.law.asked(self.blocks * n / ranks, ranks)

    def efficiency(self, n, ranks):
        return self.ms(n, 1) / (ranks * self.ms(n, ranks))

    def best(self, n):
        """The ranks, a power of two, with which the busiest takes least: more are slower."""
        return min(_doubled(), key=lambda ranks: self.ms(n, ranks))

    def half(self, n):
        """The most ranks, a power of two, of which no more than half is lost."""
        return max(ranks for ranks in _doubled() if self.efficiency(n, ranks) >= 0.5)


@dataclasses.dataclass(frozen=True)
class Sending:
    """What the rank that sends most sends: bytes, sphere_bytes for each sphere of its share that another rank shall hold,
    asked_bytes for each block that a rank asks for, rank_bytes for each rank that there is; and messages, `each` to any
    other rank while these are few, and to no more than `neighbours` of many. The errors are the median factors between model and counts.
    """

    model: Model
    sphere_bytes: float
    asked_bytes: float
    rank_bytes: float
    bytes_error: float
    each: float
    neighbours: float
    messages_error: float

    def bytes(self, n, ranks):
        if ranks == 1:
            return 0.0
        moved = n / ranks * (1 - 1 / ranks)
        return self.sphere_bytes * moved + self.asked_bytes * self.model.asked(n, ranks) + self.rank_bytes * ranks

    def messages(self, ranks):
        return self.each * _met(ranks - 1, self.neighbours)

    def ms(self, n, ranks, network):
        return 1e3 * (network.seconds_a_message * self.messages(ranks) + self.bytes(n, ranks) / network.bytes_per_second)


@dataclasses.dataclass(frozen=True)
class Network:
    """Assumed, not measured: what one rank's link does while all use theirs."""

    seconds_a_message: float
    bytes_per_second: float


CLUSTER = Network(seconds_a_message=2e-6, bytes_per_second=10e9)


def best_in(network, sending, n):
    """The ranks, a power of two, with which the busiest computes and sends for the least time."""
    return min(_doubled(), key=lambda ranks: sending.model.ms(n, ranks) + sending.ms(n, ranks, network))


def sending(chains, model):
    """Of the chains of one scene, whose model there is, or None for too few points that were shared out by space. Relative
    errors are what is least.
    """
    told = [
        (chain["n"] / p["ranks"] * (1 - 1 / p["ranks"]), p)
        for chain in chains
        for p in chain["points"]
        if p["order"] == "space" and 1 < p["ranks"] <= FITTED
    ]
    if len(told) < LEAST:
        return None
    rows = numpy.array([[moved, p["most_blocks_asked"], p["ranks"]] for moved, p in told], float)
    sent = numpy.array([p["most_bytes"] for _, p in told], float)
    factors, _ = scipy.optimize.nnls(rows / sent[:, None], numpy.ones(len(told)))
    others = numpy.array([p["ranks"] - 1 for _, p in told], float)
    messages = numpy.array([p["most_messages"] for _, p in told], float)
    logs = {k: numpy.log(messages / _met(others, k)) for k in NEIGHBOURS}
    neighbours = min(logs, key=lambda k: numpy.std(logs[k]))
    each = numpy.exp(numpy.median(logs[neighbours]))
    off = lambda ratios: float(numpy.median(numpy.exp(numpy.abs(numpy.log(ratios)))))
    return Sending(
        model,
        *map(float, factors),
        off(rows @ factors / sent),
        float(each),
        float(neighbours),
        off(each * _met(others, neighbours) / messages),
    )


def _met(others, neighbours):
    return others / (1 + others / neighbours)


def _doubled():
    return [2**k for k in range(EVER.bit_length())]


def busiest_ms(point):
    """Processor time of a search, each phase that of the rank which takes longest in it; None where it was not timed."""
    times = point.get("most_processor_ms")
    return sum(times.values()) if times else None


def law(points):
    """Of points of a scene that was shared out by space, or None for too few. The median of the factors, for the
    thickness with which they differ least.
    """
    told = [p for p in points if p["order"] == "space" and p["ranks"] <= FITTED and p["most_blocks_asked"] > 0]
    if len(told) < LEAST:
        return None
    held = numpy.array([p["blocks"] / p["ranks"] for p in told])
    ranks = numpy.array([p["ranks"] for p in told])
    asked = numpy.array([p["most_blocks_asked"] for p in told])
    factors = {t: numpy.log(asked / shell(held, ranks, t)) for t in THICKNESS[1:]}
    thickness = min(factors, key=lambda t: numpy.std(factors[t]))
    return Law(float(numpy.exp(numpy.median(factors[thickness]))), float(thickness))


def model(chains):
    """Of the chains of one scene ({n, points}), or None for too few points. Relative errors are what is least."""
    fitted_law = law([point for chain in chains for point in chain["points"]])
    told = [
        (chain["n"], p["ranks"], p["most_blocks_asked"], busiest_ms(p))
        for chain in chains
        for p in chain["points"]
        if p["ranks"] <= FITTED and busiest_ms(p)
    ]
    if fitted_law is None or len(told) <= LEAST:
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


def sending_off(chains, fitted):
    """The largest factors by which bytes and messages are off beyond the ranks that were fitted; None where none were
    counted.
    """
    beyond = [(chain["n"], p) for chain in chains for p in chain["points"] if p["ranks"] > FITTED and p["order"] == "space"]
    if not beyond:
        return None
    factor = lambda a, b: max(a / b, b / a)
    return (
        max(factor(fitted.bytes(n, p["ranks"]), p["most_bytes"]) for n, p in beyond),
        max(factor(fitted.messages(p["ranks"]), p["most_messages"]) for _, p in beyond),
    )


def checked(chains, fitted):
    """[(n, ranks, asked by the law, asked as counted)] of the rank that asks most, beyond the ranks that were fitted."""
    return [
        (chain["n"], p["ranks"], fitted.asked(p["blocks"] / p["ranks"], p["ranks"]), p["most_blocks_asked"])
        for chain in chains
        for p in chain["points"]
        if p["ranks"] > FITTED and p["most_blocks_asked"]
    ]
