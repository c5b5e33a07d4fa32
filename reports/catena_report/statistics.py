"""The statistics of the report. Times are skewed and few, so everything rests on medians and ranks."""
import dataclasses
import functools
import math

import numpy
import scipy.stats

CONFIDENCE = 0.95


@dataclasses.dataclass(frozen=True)
class Interval:
    value: float
    low: float
    high: float

    def __contains__(self, number):
        return self.low <= number <= self.high


@functools.cache
def rank_of_bound(size):
    """The greatest k with P(Binomial(size, 1/2) < k) <= 2.5 %, 0 when there is none: the k-th samples from both
    ends hold the median between them in at least 95 % of cases. As bench/timing/median_interval.cpp.
    """
    return int(scipy.stats.binom.ppf((1 - CONFIDENCE) / 2, size, 0.5))


def median(samples):
    """The median with its interval by order statistics, which assumes nothing of the distribution; with fewer
    than six samples the interval is their range, since five do not hold the median with 95 % confidence.
    """
    ordered = numpy.sort(numpy.asarray(samples, dtype=float)).tolist()
    k = max(1, rank_of_bound(len(ordered)))
    return Interval(_middle(ordered), ordered[k - 1], ordered[-k])


def _middle(ordered):
    """The median of sorted numbers, in a tenth of numpy's time for so few: reports take it a hundred thousand times."""
    half = len(ordered) // 2
    return ordered[half] if len(ordered) % 2 else (ordered[half - 1] + ordered[half]) / 2


LEAST_TIME = 1e-7  # ms; below the tick of any clock, so that a ratio to a time of 0 is a number


def ratio(new, old):
    """median(new) / median(old) with the interval that follows from those of the two medians: on logarithms the
    distances to their ends add as squares (Donner and Zou 2012, MOVER). Below six samples, where a median has
    no interval, the range of ratios.
    """
    new, old = (numpy.maximum(samples, LEAST_TIME) for samples in (new, old))
    a, b = median(new), median(old)
    value = a.value / b.value
    if min(len(new), len(old)) < 6:
        return Interval(value, a.low / b.high, a.high / b.low)
    down = math.hypot(math.log(a.value / a.low), math.log(b.high / b.value))
    up = math.hypot(math.log(a.high / a.value), math.log(b.value / b.low))
    return Interval(value, value * math.exp(-down), value * math.exp(up))


def mean_log(ratios):
    """The geometric mean of independent ratios with its t interval: one is a value without interval."""
    logs = numpy.log(ratios)
    centre = float(logs.mean())
    if len(logs) < 2:
        return Interval(math.exp(centre), 0.0, math.inf)
    reach = scipy.stats.t.ppf((1 + CONFIDENCE) / 2, len(logs) - 1) * logs.std(ddof=1) / math.sqrt(len(logs))
    return Interval(math.exp(centre), math.exp(centre - reach), math.exp(centre + reach))


def share(number, of):
    """number / of with Wilson's interval, which stays within 0 and 1 and has a width where all or none are."""
    z = scipy.stats.norm.ppf((1 + CONFIDENCE) / 2)
    value = number / of
    centre, widened = value + z * z / (2 * of), 1 + z * z / of
    reach = z * math.sqrt(value * (1 - value) / of + z * z / (4 * of * of))
    return Interval(value, max(0.0, (centre - reach) / widened), min(1.0, (centre + reach) / widened))


FEWEST_SIZES = 4  # two always lie on a power law, and with three the t interval says next to nothing


def exponent(ns, times):
    """b of time = a n^b by least squares on the logarithms, with its t interval; None with fewer than
    FEWEST_SIZES.
    """
    ns, times = numpy.asarray(ns, dtype=float), numpy.asarray(times, dtype=float)
    keep = (times > 0) & (ns > 0)
    if len(set(ns[keep])) < FEWEST_SIZES:
        return None
    fit = scipy.stats.linregress(numpy.log(ns[keep]), numpy.log(times[keep]))
    reach = scipy.stats.t.ppf((1 + CONFIDENCE) / 2, keep.sum() - 2) * fit.stderr
    return Interval(float(fit.slope), float(fit.slope - reach), float(fit.slope + reach))


def mann_whitney(a, b):
    """Two-sided p: exact for small samples without ties, asymptotic otherwise."""
    return _mann_whitney(tuple(a), tuple(b))


@functools.lru_cache(1 << 14)  # several sections compare the same samples
def _mann_whitney(a, b):
    if len(set(a) | set(b)) == 1:
        return 1.0
    return float(scipy.stats.mannwhitneyu(a, b, alternative="two-sided").pvalue)


def holm(p_values):
    """Holm's adjusted p values, in the order given: the family-wise error stays at the level each is
    compared with.
    """
    order = numpy.argsort(p_values)
    adjusted, worst = numpy.empty(len(p_values)), 0.0
    for rank, at in enumerate(order):
        worst = max(worst, min(1.0, (len(p_values) - rank) * p_values[at]))
        adjusted[at] = worst
    return adjusted.tolist()


def least_p(a_size, b_size):
    """The smallest two-sided p that samples of these sizes can reach: whether a test can decide at all."""
    return 2 / math.comb(a_size + b_size, a_size)


def best(samples):
    """Of {name: samples}: (the name of the least median, the names that do not differ from it significantly)."""
    leader = min(samples, key=lambda name: _middle(sorted(samples[name])))
    apart = differing(samples, leader)
    return leader, [name for name in samples if name != leader and name not in apart]


def differing(samples, named):
    """Of {name: samples}: the names that differ significantly from `named`, be they slower or faster.
    Mann-Whitney against that one with Holm's correction; where the samples are too few for that test to
    reach 5 % at all, those differ whose ranges do not overlap, and with fewer than three samples not even
    within a factor of 2.
    """
    others = [name for name in samples if name != named]
    p_values = holm([mann_whitney(samples[name], samples[named]) for name in others]) if others else []
    found = set()
    for name, p in zip(others, p_values):
        one, other = sorted((samples[name], samples[named]), key=min)
        able = least_p(len(one), len(other)) * len(others) < 1 - CONFIDENCE
        reach = max(one) * (2 if min(len(one), len(other)) < 3 else 1)
        if p <= 1 - CONFIDENCE if able else min(other) > reach:
            found.add(name)
    return found
