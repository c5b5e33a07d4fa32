"""Whether a run is slower than an earlier one, decided once for each variant and stage over all chains.

A change is the logarithm of NEW / OLD of a case's quick quarter of samples: load only ever adds time. The
changes of all cases at one place (host, its threads, a device) are fitted, robustly, by what the machine did:
one factor for all, the calibration kernel that was timed beside each sample, and how long a case takes, since
a long one is interrupted more often. What is left belongs to the code. A family, one variant and stage, or
the stage of one algorithm in all variants that have it, is tested by the weighted mean of that over its
chains; its variance comes from the scatter between them, moderated by that of all families (Smyth 2004), and
grows with the load that the kernel saw. One test a family, Bonferroni over the families. Where most of the
code changed, what all cases share is not the machine's: nothing is called slower, or faster, of which the
clock does not show a good part, with nothing but the kernel's share taken out.
"""
import dataclasses
import functools
import math

import numpy
import scipy.special

from . import paired

ALARMS = 0.002  # the chance of any alarm, of all families together, when nothing has changed
LEAST_RATIO = 1.02  # smaller changes do not matter
SEEN = 0.95  # the chance with which what "could have been seen" is seen
COMMON_RATIO = 1.1  # a factor of all cases at one place is the machine's up to this
UNCALIBRATED_RATIO = 1.5  # the same without a kernel
BY_CLOCK = 0.5  # of a change, on the logarithm, is to be seen without taking out what all cases share
LOADED = 0.25  # how much of the load that the kernel saw may be in a case's time, on each chain anew,
LOADED_ALL = 0.05  # and in a family's, on all its chains alike
# Degrees of freedom by which the scatter of all moderates that of a family: with FEW_CASES at least, and with
# fewer, whose mean is far from normal.
PRIOR_DEGREES = {True: 25.0, False: 6.0}
FEW_CASES = 4
FEW = 12  # with fewer families at a place, their common change cannot be told from the machine's
MACHINE = {True: 0.03, False: 0.05}  # then: the standard error of the machine's part; with a kernel, without
SAME, FASTER, SLOWER, UNDECIDED = "same", "faster", "slower", "undecided"


@dataclasses.dataclass(frozen=True)
class Family:
    variant: str  # or an algorithm that several have: "*+CPU2"
    stage: str
    cases: int
    ratio: float  # NEW / OLD, the machine's part taken out
    low: float  # 95 % interval
    high: float
    p: float  # two-sided, times the number of families
    seen: float  # the least ratio that would have been called slower in 95 % of such runs
    verdict: str

    @property
    def name(self):
        return f"{self.variant}/{self.stage}"


@dataclasses.dataclass(frozen=True)
class Common:
    """What all cases at one place have in common."""

    place: str
    ratio: float  # of the cases
    kernel: float  # of the calibration kernel; 1 without
    least: float  # a ratio of the cases to the kernel is the machine's up to this
    verdict: str  # SLOWER past that, else SAME


def decide(cases, least_ratio=LEAST_RATIO):
    """([Family], [Common]) of [paired.Case], families by their name. Neither of nothing."""
    if not cases:
        return [], []
    left, uncertain, common = _without_machine(cases)
    members = _members(cases)
    variances = numpy.array([case.variance for case in cases])
    own_clock = numpy.array([case.change - case.kernel for case in cases])
    loads = numpy.array([case.load for case in cases])
    found = {}
    for name, at in members.items():
        own, weights = left[at], 1 / variances[at]
        weights = numpy.minimum(weights, 4 * numpy.median(weights))  # no chain decides alone
        weights /= weights.sum()
        centre = float(weights @ own)
        squares = (loads[at] ** 2).sum(axis=1)
        load = math.hypot(LOADED * math.sqrt(weights**2 @ squares), LOADED_ALL * math.sqrt(weights @ squares))
        found[name] = (
            centre,
            float(weights @ own_clock[at]),
            float(weights**2 @ variances[at]),
            float(((own - centre) ** 2 / variances[at]).sum()),
            len(at) - 1,
            load,
            float(weights @ uncertain[at]),
        )
    degrees = sum(values[4] for values in found.values())
    # One scale for all; a family that changed on all chains alike adds no scatter to it.
    prior = max(0.25, sum(values[3] for values in found.values()) / degrees) if degrees >= 5 else 1.0
    families = [
        _family(*name, values, prior, len(found), least_ratio) for name, values in sorted(found.items())
    ]
    return families, common


def _members(cases):
    """{(variant or algorithm, stage): [index of a case]}; an algorithm that one variant has is that
    variant's.
    """
    members, variants = {}, {}
    for at, case in enumerate(cases):
        members.setdefault((case.variant, case.stage), []).append(at)
        variants.setdefault((case.algorithm, case.stage), set()).add(case.variant)
    for at, case in enumerate(cases):
        if case.algorithm and len(variants[case.algorithm, case.stage]) > 1:
            members.setdefault((case.algorithm, case.stage), []).append(at)
    return members


def _family(variant, stage, values, prior, tests, least_ratio):
    centre, by_clock, variance, scatter, degrees, load, machine = values
    freedom = PRIOR_DEGREES[degrees + 1 >= FEW_CASES] + degrees
    moderated = (scatter + (freedom - degrees) * prior) / freedom
    error = math.sqrt(variance * moderated + load**2)
    reach = math.hypot(_quantile(freedom, 0.025) * error, 2 * machine)
    bound = max(math.hypot(_quantile(freedom, ALARMS / tests) * error, 3 * machine), math.log(least_ratio))
    p = min(1.0, 2 * tests * float(scipy.special.stdtr(freedom, -abs(centre) / math.hypot(error, machine))))
    if abs(centre) >= bound:
        verdict = UNDECIDED if by_clock / centre < BY_CLOCK else SLOWER if centre > 0 else FASTER
    else:
        verdict = SAME if abs(centre) + reach < math.log(1.05) else UNDECIDED
    return Family(
        variant, stage, degrees + 1, math.exp(centre), math.exp(centre - reach), math.exp(centre + reach), p,
        math.exp(min(bound + _quantile(freedom, 1 - SEEN) * error, 700)), verdict,
    )  # fmt: skip


@functools.lru_cache(maxsize=None)
def _quantile(freedom, p):
    """What Student's t exceeds with probability p."""
    return -float(scipy.special.stdtrit(freedom, p))


def _without_machine(cases):
    """(the changes without the machine's part, how uncertain that part is, [Common])."""
    changes = numpy.array([case.change for case in cases])
    left, uncertain, common = changes.copy(), numpy.zeros(len(cases)), []
    for where in sorted({case.place for case in cases}):
        at = numpy.array([k for k, case in enumerate(cases) if case.place == where])
        own = [cases[k] for k in at]
        kernels = numpy.array([case.kernel for case in own])
        calibrated = all(case.calibrated for case in own)
        kernel = float(numpy.median(kernels))
        if len({(case.variant, case.stage) for case in own}) < FEW:
            machine = numpy.full(len(own), kernel)
            uncertain[at] = math.hypot(MACHINE[calibrated], kernel / 2)
        else:
            machine = _fit(_machine_terms(own, kernels), changes[at], [case.variance for case in own])
            common.append(_common(where, machine, kernel, calibrated, own))
        left[at] -= machine
    return left, uncertain, common


def _machine_terms(cases, kernels):
    """One column for each thing that a machine does to all cases: a factor, the kernel, and a slope over
    their duration that changes at 3 ms, about the time slice of a scheduler.
    """
    ms = numpy.array([case.old for case in cases])
    columns = [numpy.ones(len(cases)), kernels] + [numpy.log(numpy.maximum(ms, at) / at) for at in (0.3, 3)]
    return numpy.array(columns).T


def _fit(terms, changes, variances):
    """The fitted changes: weighted least squares, with Huber's weights against families that did change."""
    certain = 1 / (numpy.array(variances) + 0.02**2)
    weights = certain
    for _ in range(15):
        root = numpy.sqrt(weights)
        factors = numpy.linalg.lstsq(terms * root[:, None], changes * root, rcond=None)[0]
        off = (changes - terms @ factors) * numpy.sqrt(certain)
        spread = 1.4826 * numpy.median(numpy.abs(off)) + 1e-12
        weights = certain * numpy.minimum(1, 1.345 * spread / numpy.maximum(numpy.abs(off), 1e-12))
    return terms @ factors


def _common(where, machine, kernel, calibrated, cases):
    shift = float(numpy.median(machine))
    load = LOADED_ALL * math.hypot(*numpy.median([case.load for case in cases], axis=0))
    least = math.log(COMMON_RATIO if calibrated else UNCALIBRATED_RATIO) + abs(kernel) / 2 + 3 * load
    verdict = SLOWER if shift - max(0.0, kernel) > least else SAME
    return Common(where, math.exp(shift), math.exp(kernel), math.exp(least), verdict)
