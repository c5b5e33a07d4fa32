"""Two runs of the same cases: same, faster, slower or undecided, by a stated test, so that a CI can gate on
it.

For each case (chain, variant, stage) that both runs timed: the ratio NEW / OLD of the medians with its 95 %
interval, and the two-sided Mann-Whitney test, its p adjusted by Holm over all cases.
  slower     p < 5 % and the ratio is at least LEAST
  faster     p < 5 % and the ratio is at most 1 / LEAST
  same       the whole interval of the ratio lies within 1 / LEAST and LEAST
  undecided  anything else: more repetitions would tell
"""
import dataclasses

from . import runfile, statistics, words

LEAST_RATIO = 1.05
SAME, FASTER, SLOWER, UNDECIDED = "same", "faster", "slower", "undecided"
LEVEL = 1 - statistics.CONFIDENCE


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    verdict: str
    ratio: statistics.Interval
    p: float
    old: float
    new: float


def compared(old, new, least_ratio=LEAST_RATIO):
    """[Case] of what both runs timed."""
    shared = sorted(
        set(old.samples) & set(new.samples),
        key=lambda case: (runfile.scene_of(case[0]), runfile.n_of(case[0]), case[1:]),
    )
    ratios = [statistics.ratio(new.samples[case], old.samples[case]) for case in shared]
    p_values = statistics.holm(
        [statistics.mann_whitney(new.samples[case], old.samples[case]) for case in shared]
    )
    return [
        Case(
            "/".join(case),
            verdict(ratio, p, least_ratio),
            ratio,
            p,
            statistics.median(old.samples[case]).value,
            statistics.median(new.samples[case]).value,
        )
        for case, ratio, p in zip(shared, ratios, p_values)
    ]


def verdict(ratio, p, least_ratio):
    if p < LEVEL and ratio.value >= least_ratio:
        return SLOWER
    if p < LEVEL and ratio.value <= 1 / least_ratio:
        return FASTER
    if 1 / least_ratio <= ratio.low and ratio.high <= least_ratio:
        return SAME
    return UNDECIDED


def blind(old, new):
    """How many of the shared cases have so few samples that the corrected test could never call them
    slower.
    """
    shared = set(old.samples) & set(new.samples)
    return sum(
        statistics.least_p(len(old.samples[case]), len(new.samples[case])) * len(shared) >= LEVEL
        for case in shared
    )


def main(old_path, new_path, least_ratio):
    """Prints the table; 1 if a case is slower or is no longer answered, otherwise 0. A BadRunFile when the
    samples are too few for any case to be called slower.
    """
    old, new = runfile.load(old_path), runfile.load(new_path)
    cases = compared(old, new, least_ratio)
    if not cases:
        raise runfile.BadRunFile(
            f"{old_path} and {new_path} timed no case in common; measure both with the same profile"
        )
    broken = sorted(set(old.samples) & set(new.refused) - set(new.samples))
    _print(cases, broken, new)
    if old.context.get("cpu") != new.context.get("cpu") or old.context.get("gpu") != new.context.get("gpu"):
        print(
            f"note: different machines ({old.device}; {new.device}), so a difference need not be the code's"
        )
    gone, added = (len(set(a.samples) - set(b.samples)) for a, b in ((old, new), (new, old)))
    if gone or added:
        print(f"note: {words.plural(gone, 'case')} only in OLD, {words.plural(added, 'case')} only in NEW")
    if broken or any(case.verdict == SLOWER for case in cases):
        return 1
    if blind(old, new) == len(cases):  # a gate that cannot close must not say that all is well
        raise runfile.BadRunFile(
            f"{new_path}: too few repetitions to find a regression in {words.plural(len(cases), 'case')}; "
            "measure both with more, or fewer cases"
        )
    return 0


def _print(cases, broken, new):
    width = max(len(case.name) for case in cases)
    print(
        f"{'case':<{width}}  {'old ms':>10}  {'new ms':>10}  {'new/old [95 %]':<20}  {'p (Holm)':>9}  verdict"
    )
    for case in cases:
        print(
            f"{case.name:<{width}}  {words.ms(case.old):>10}  {words.ms(case.new):>10} "
            f" {words.interval(case.ratio):<20}  {case.p:>9.2g}  {case.verdict}"
        )
    for case in broken:
        print(f"{'/'.join(case):<{width}}  no longer answered: {new.refused[case]}")
    print(
        ", ".join(
            f"{sum(case.verdict == name for case in cases)} {name}"
            for name in (SAME, FASTER, SLOWER, UNDECIDED)
        )
    )
