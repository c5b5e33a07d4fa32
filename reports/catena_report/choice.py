"""Which variant to use: the fastest of each chain, what cannot be told from it, how much faster than the rest;
and chains alike joined into one row of advice.
"""
import dataclasses
import math
import typing

import numpy

from . import paper, runfile, statistics

PAPERS = paper.STAGES["CPU2"][0]  # what the paper would run on a processor
DEFAULT = "auto"  # what a caller gets who names none


@dataclasses.dataclass(frozen=True)
class Choice:
    """Of one chain."""

    leader: str  # of the exact variants of catena, the one of the least median
    alike: list  # those that do not differ from it significantly
    time: statistics.Interval  # its median, ms
    slower: dict  # every other timed variant, peers too -> how many times the leader's median it takes

    @property
    def candidates(self):
        return {self.leader, *self.alike}

    def as_good(self, run):
        """[name]: exact variants that are not told from the leader, be it by the test or by an interval that begins at 1 or below."""
        return [
            name for name, ratio in sorted(self.slower.items(), key=lambda entry: entry[1].value)
            if name in self.alike or (run.info(name).recommended and ratio.low <= 1)
        ]


class Beside(typing.NamedTuple):
    """A variant set against the one that is advised."""

    name: str
    ratio: statistics.Interval  # how many times as long it takes, over the chains that it was timed on
    chains: int  # so many


@dataclasses.dataclass(frozen=True)
class Advice:
    """Of chains alike: one variant that is the fastest, or not significantly slower, on each."""

    inputs: list
    variant: str
    times: list  # its medians, ms
    as_good: list  # of Beside by rising ratio: exact variants timed on every chain that are not told from it
    next: object  # Beside, its interval above 1: of the other exact variants timed on every chain the nearest; or None
    default: object  # Beside of auto; None where that is advised or was not timed
    papers: object  # the same of the paper's CPU2
    peer: object  # the same of the quickest peer
    others: int  # exact variants that it was compared with on some chain


def choose(run, cases):
    """input -> Choice, of a view of `waits`, where two exact variants or more were timed."""
    found = {}
    for input_, row in cases.items():
        own = {variant: times for variant, times in row.items() if run.info(variant).recommended}
        if len(own) < 2:
            continue
        leader, alike = statistics.best(own)
        slower = {name: statistics.ratio(times, row[leader]) for name, times in row.items() if name != leader}
        found[input_] = Choice(leader, alike, statistics.median(row[leader]), slower)
    return found


def advise(run, cases):
    """[Advice] by rising n: as few as there can be while each has a variant for all its chains."""
    choices = choose(run, cases)
    order = sorted(choices, key=lambda name: (runfile.n_of(name), run.density(name) or 0))
    groups = []
    for input_ in order:
        candidates = choices[input_].candidates
        if groups and groups[-1][1] & candidates:
            groups[-1] = groups[-1][0] + [input_], groups[-1][1] & candidates
        else:
            groups.append(([input_], candidates))
    return [_advice(run, cases, choices, inputs, candidates) for inputs, candidates in groups]


def _advice(run, cases, choices, inputs, candidates):
    medians = lambda name: [float(numpy.median(cases[input_][name])) for input_ in inputs]  # noqa: E731
    variant = min(sorted(candidates), key=lambda name: sum(map(math.log, medians(name))))
    timed = set().union(*(cases[input_] for input_ in inputs)) - {variant}
    own = [name for name in timed if run.info(name).recommended]
    slower = set().union(*(_slower_than(run, cases[input_], choices[input_], variant) for input_ in inputs))
    ratios = lambda names: [_beside(cases, inputs, name, variant) for name in sorted(names)]  # noqa: E731
    nearest = lambda found: min(found, key=lambda entry: entry.ratio.value, default=None)  # noqa: E731
    on_all = ratios(name for name in own if all(name in cases[input_] for input_ in inputs))
    told = [entry for entry in on_all if entry.name in slower and entry.ratio.low > 1]
    return Advice(
        inputs,
        variant,
        medians(variant),
        sorted((entry for entry in on_all if entry not in told), key=lambda entry: entry.ratio.value),
        nearest(told),
        nearest(ratios(timed & {DEFAULT})),
        nearest(ratios(timed & {PAPERS})),
        nearest(ratios(name for name in timed if run.info(name).peer)),
        len(own),
    )


def _slower_than(run, row, chosen, variant):
    """The exact variants of a chain that are significantly slower than the one that is named, which need not be the
    leader.
    """
    own = {name: times for name, times in row.items() if run.info(name).recommended}
    if variant == chosen.leader:
        return set(own) - chosen.candidates
    return {name for name in statistics.differing(own, variant) if numpy.median(own[name]) > numpy.median(own[variant])}


def _beside(cases, inputs, name, variant):
    rows = [cases[input_] for input_ in inputs if name in cases[input_]]
    return Beside(name, over_chains([statistics.ratio(row[name], row[variant]) for row in rows]), len(rows))


def over_chains(ratios):
    """The geometric mean of measured ratios with the interval that follows from theirs: what the measurement
    leaves open on these very chains, not what other chains would give.
    """
    size = len(ratios)
    centre = sum(math.log(ratio.value) for ratio in ratios) / size
    down = math.hypot(*(math.log(ratio.value / ratio.low) for ratio in ratios)) / size
    up = math.hypot(*(math.log(ratio.high / ratio.value) for ratio in ratios)) / size
    return statistics.Interval(math.exp(centre), math.exp(centre - down), math.exp(centre + up))
