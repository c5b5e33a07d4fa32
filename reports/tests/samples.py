"""Runs for tests of the gate: quick runs drawn from the samples of a stored one, so that nothing has changed
between two of them, and changes planted in one.
"""
import dataclasses
import functools
import math

import made
import numpy
from catena_report import paired, runfile

STORED = made.REPORTS / "results" / "idle.json.gz"  # the H200 run of 2026-11-21, its timing alone


@functools.lru_cache(maxsize=None)
def stored():
    """({case: paired.Timed}, {case: (algorithm, place)}) of the stored quick run: 1,080 cases of 192 variants
    and stages, 6 to 12 samples each.
    """
    run = runfile.load(STORED)
    timed = paired.timed(run)
    return timed, {case: (paired.algorithm(run, case), paired.place(run, case)) for case in timed}


def unchanged(generator, repetitions=12):
    """[paired.Case] of two quick runs of one program."""
    timed, kinds = stored()
    draw = lambda: {  # noqa: E731
        case: paired.Timed(generator.choice(of.ms, repetitions), {}) for case, of in timed.items()
    }
    return paired.pairs(draw(), draw(), kinds)


def slower(cases, factor, where):
    """The same with NEW slower by `factor` in the cases that `where` picks."""
    return [
        dataclasses.replace(case, new=case.new * factor, change=case.change + math.log(factor))
        if where(case)
        else case
        for case in cases
    ]


def generator(seed):
    return numpy.random.default_rng(seed)
