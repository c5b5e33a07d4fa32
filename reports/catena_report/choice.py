"""Which variant to use: the fastest of each chain, what cannot be told from it, how much faster than the rest;
and chains alike joined into one row of advice.
"""
import dataclasses
import math

import numpy

from . import paper, runfile, statistics

PAPERS = paper.STAGES["CPU2"][0]  # what the paper would run on a processor


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


@dataclasses.dataclass(frozen=True)
class Advice:
    """Of chains alike: one variant that is the fastest, or not significantly slower, on each."""

    inputs: list
    variant: str
    times: list  # its medians, ms
    next: object  # (variant, Interval above 1): of those slower on every chain the nearest, over the chains; or None
    papers: object  # (variant, Interval) of the paper's CPU2, over the chains that it was timed on; or None
    peer: object  # the same of the quickest peer; or None
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
    slower = set.intersection(*(_slower_than(run, cases[input_], choices[input_], variant) for input_ in inputs))
    ratios = lambda names: [(name, _slower(cases, inputs, name, variant)) for name in sorted(names)]  # noqa: E731
    nearest = lambda found: min(found, key=lambda entry: entry[1].value, default=None)  # noqa: E731
    return Advice(
        inputs,
        variant,
        medians(variant),
        nearest([entry for entry in ratios(slower) if entry[1].low > 1]),
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


def _slower(cases, inputs, name, variant):
    return over_chains(
        [
            statistics.ratio(cases[input_][name], cases[input_][variant])
            for input_ in inputs
            if name in cases[input_]
        ]
    )


def over_chains(ratios):
    """The geometric mean of measured ratios with the interval that follows from theirs: what the measurement
    leaves open on these very chains, not what other chains would give.
    """
    size = len(ratios)
    centre = sum(math.log(ratio.value) for ratio in ratios) / size
    down = math.hypot(*(math.log(ratio.value / ratio.low) for ratio in ratios)) / size
    up = math.hypot(*(math.log(ratio.high / ratio.value) for ratio in ratios)) / size
    return statistics.Interval(math.exp(centre), math.exp(centre - down), math.exp(centre + up))
