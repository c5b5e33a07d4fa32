"""All chains together: how many times the fastest time of each chain a variant takes."""
import dataclasses
import math

import numpy
import scipy.stats

from . import statistics, waits, words

SHARE = 0.9  # the rank test's power is that against a variant slower on so great a share of the chains
ENOUGH = 0.8  # below this power the test is not made


@dataclasses.dataclass(frozen=True)
class Slowdown:
    """Of one variant: its time over the least of any variant, chain by chain."""

    ratios: dict  # input -> how many times the least time; chains that it was not timed on are not there
    mean: statistics.Interval  # geometric, with the t interval over chains
    chains: int  # of the comparison


def slowdowns(run):
    """variant -> Slowdown by what a caller waits for end to end, those timed on every chain first, then by the
    mean. Only chains with two exact variants of catena; peers take part.
    """
    cases = {
        input_: {variant: float(numpy.median(times)) for variant, times in row.items()}
        for input_, row in waits.end_to_end(run).items()
        if sum(run.info(variant).recommended for variant in row) > 1
    }
    ratios = {}
    for input_, row in cases.items():
        least = max(min(row.values()), statistics.LEAST_TIME)
        for variant, time in row.items():
            ratios.setdefault(variant, {})[input_] = max(time, statistics.LEAST_TIME) / least
    found = {
        variant: Slowdown(mine, statistics.mean_log(list(mine.values())), len(cases))
        for variant, mine in ratios.items()
    }
    return dict(sorted(found.items(), key=lambda item: (-len(item[1].ratios), item[1].mean.value, item[0])))


def profile(slowdown):
    """[(tau, the share of all chains on which the variant takes at most tau times the least)], rising in tau
    (Dolan and More 2002). A chain that it was not timed on is never reached.
    """
    ordered = sorted(slowdown.ratios.values())
    return [(tau, (at + 1) / slowdown.chains) for at, tau in enumerate(ordered)]


@dataclasses.dataclass(frozen=True)
class RankTest:
    """Wilcoxon's signed-rank test of every variant against the first, on chains that all were timed on."""

    first: str
    chains: int
    others: int
    power: float  # at the level that Holm's correction gives the smallest p
    p: dict  # other -> p adjusted by Holm; empty where the power is below ENOUGH


def rank_test(run, found):
    """The test on what slowdowns() found, of catena's own variants timed on all its chains; None where fewer
    than two are.
    """
    own = [
        variant for variant, slow in found.items()
        if run.info(variant).recommended and len(slow.ratios) == slow.chains
    ]
    if len(own) < 2:
        return None
    first, others = own[0], own[1:]
    chains = found[first].chains
    power = signed_rank_power(chains, (1 - statistics.CONFIDENCE) / len(others))
    p = {}
    if power >= ENOUGH:
        logs = {name: numpy.log([found[name].ratios[input_] for input_ in found[first].ratios]) for name in own}
        values = [_wilcoxon(logs[name] - logs[first]) for name in others]
        p = dict(zip(others, statistics.holm(values)))
    return RankTest(first, chains, len(others), power, p)


def _wilcoxon(differences):
    return float(scipy.stats.wilcoxon(differences).pvalue) if numpy.any(differences) else 1.0


def signed_rank_power(size, level):
    """The probability with which the exact two-sided signed-rank test of so many differences rejects at the
    level when each is positive with probability SHARE, whatever its rank.
    """
    null, alternative = (_signed_ranks(size, positive) for positive in (0.5, SHARE))
    tails = numpy.cumsum(null[::-1])[::-1]  # P(W+ >= w)
    rejects = numpy.flatnonzero(2 * tails <= level)
    if not len(rejects):
        return 0.0
    critical = rejects[0]
    return float(alternative[critical:].sum() + alternative[: len(alternative) - critical].sum())


def _signed_ranks(size, positive):
    """P(W+ = w), w = 0, 1, ...: the sum of the ranks 1 to size, each taken with that probability."""
    found = numpy.zeros(size * (size + 1) // 2 + 1)
    found[0] = 1
    for rank in range(1, size + 1):
        taken = numpy.zeros_like(found)
        taken[rank:] = found[:-rank]
        found = (1 - positive) * found + positive * taken
    return found


def in_words(test):
    """What the rank test says, or why it is not made."""
    against = f"{test.chains} chains against {words.plural(test.others, 'other exact variant')} of catena's"
    if not test.p:
        return (
            f"no rank test: on {against}, it would tell a variant that is slower on {SHARE:.0%} of the chains"
            f" with a probability of {math.floor(100 * test.power) / 100:.2f} only"
        )
    told = [name for name, p in test.p.items() if p < 1 - statistics.CONFIDENCE]
    return (
        f"signed-rank test with Holm's correction ({against}; power {test.power:.2f} against a variant slower"
        f" on {SHARE:.0%} of the chains): at 5 % {test.first} is told from"
        f" {words.listed(told, 4) if len(told) < test.others else 'every one of them'}"
    )
