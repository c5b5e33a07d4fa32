"""Two runs of the same cases, so that a CI can gate on it: what was counted is compared exactly (work.py),
what was timed by one test for each variant and stage over all chains (gate.py).

  slower     surely (one alarm in 500 runs of unchanged code), and by at least LEAST_RATIO
  faster     the same the other way round
  same       the whole 95 % interval of the ratio lies within 1 / 1.05 and 1.05
  undecided  anything else; it is said how much slower would have been seen

Peers, which are not catena's to mend, get the same verdicts and fail nothing.
"""
import numpy

from . import gate, paired, runfile, words, work

LEAST_RATIO = gate.LEAST_RATIO
BLIND = 2.0  # a comparison that would not have seen this ratio in any family is no gate
PLACES = {paired.HOST: "the host", paired.THREADS: "threads of the host", paired.DEVICE: "the device"}


def main(old_path, new_path, least_ratio):
    """Prints what changed; 1 if a count rose, something is slower or is no longer answered, otherwise 0. A
    BadRunFile when nothing can be compared, or so little that a doubled time would not have been seen.
    """
    old, new = runfile.load(old_path), runfile.load(new_path)
    cases, counted = paired.cases(old, new), work.compared(old, new)
    broken = _broken(old, new)
    if not cases and not broken:
        raise runfile.BadRunFile(
            f"{old_path} and {new_path} timed no case in common; measure both with the same profile"
        )
    families, common = gate.decide(cases, least_ratio)
    _print_work(counted)
    if families:
        _print_times(families, common)
    for case in broken:
        print(f"{'/'.join(case)}: {'no longer answered' if case in old.samples else 'failed'}: {new.refused[case]}")
    _print_notes(old, new, cases)
    if families:
        _print_seen(families)
    regressed = [case[1] for case in broken] + [change.variant for change in counted.more]
    regressed += [family.variant for family in families if family.verdict == gate.SLOWER]
    peers = sorted({variant for variant in regressed if _is_peer(variant, old, new)})
    if peers:
        print(f"note: no regression of catena's, as these are peers: {words.listed(peers)}")
    if len(set(regressed)) > len(peers) or any(part.verdict == gate.SLOWER for part in common):
        return 1
    if not families:  # what broke was a peer's, and said so
        print("note: no time was compared, as no case was timed in both")
        return 0
    if min(family.seen for family in families) > BLIND:  # a gate that cannot close must not say: all is well
        fewest = min(case.repetitions for case in cases)
        raise runfile.BadRunFile(
            f"{new_path}: not even a doubled time would have been seen, by too few repetitions ({fewest}) or too"
            " much load; measure both again, with more --repetitions"
        )
    return 0


def _broken(old, new):
    """The cases that OLD answered and NEW refuses, and those that fail in NEW by a fault of their own and did not in
    OLD: one that threw in the middle of its rounds has samples, too.
    """
    refused = set(old.samples) & set(new.refused) - set(new.samples)
    return sorted(refused | set(new.faults) - set(old.faults))


def _is_peer(variant, *runs):
    """False of an algorithm, "*+CPU2": no peer has stages."""
    return any((run.catena.get("variants") or {}).get(variant, {}).get("peer", False) for run in runs)


def _print_work(counted):
    for title, changes in (
        ("more work, by count", counted.more),
        ("work traded (times decide)", counted.traded),
        ("less work, by count", counted.fewer),
        (f"work changed by less than {100 * (work.LEAST_RATIO - 1):.1f} %", counted.small),
    ):
        for change in changes:
            ratio = f" ({change.ratio:.4f})" if change.old else ""
            print(
                f"{_title(title, change)}: {change.input}/{change.variant}: {change.count} {words.count(change.old)} ->"
                f" {words.count(change.new)}{ratio}"
            )
    changed = any((counted.more, counted.traded, counted.fewer, counted.small))
    if counted.compared and not changed:
        print(f"the counts of all {words.plural(counted.compared, 'case')} are the same")


def _title(title, change):
    """Pairs that are wrong are no work."""
    if change.count not in work.ANSWERED:
        return title
    return "more wrong pairs" if change.new > change.old else "fewer wrong pairs"


def _print_times(families, common):
    width = max(len(family.name) for family in families)
    print(f"{'variant/stage':<{width}}  {'cases':>5}  {'new/old [95 %]':<20}  {'p':>9}  {'seen':>6}  verdict")
    for family in sorted(families, key=lambda family: (family.verdict == gate.SLOWER, family.name)):
        ratio = f"{family.ratio:.3f} [{family.low:.3f}, {family.high:.3f}]"
        print(
            f"{family.name:<{width}}  {family.cases:>5}  {ratio:<20}  {family.p:>9.2g} "
            f" {_ratio(family.seen):>6}  {family.verdict}"
        )
    for part in common:
        told = f"{part.ratio:.3f}, of the calibration kernel {part.kernel:.3f}"
        if part.verdict == gate.SLOWER:
            print(
                f"everything on {PLACES[part.place]} is slower: new/old {told}; a machine explains"
                f" {part.least:.2f}"
            )
        elif not 0.95 < part.ratio < 1.05:
            print(f"note: new/old of everything on {PLACES[part.place]} is {told}: taken for the machine's")
    print(
        ", ".join(
            f"{sum(family.verdict == name for family in families)} {name}"
            for name in (gate.SAME, gate.FASTER, gate.SLOWER, gate.UNDECIDED)
        )
    )


def _print_notes(old, new, cases):
    if old.context.get("cpu") != new.context.get("cpu") or old.context.get("gpu") != new.context.get("gpu"):
        print(
            f"note: different machines ({old.device}; {new.device}), so a difference need not be the code's"
        )
    changed = paired.changed_inputs(old, new)
    if changed:
        print(f"note: not compared, as the chain is another: {words.listed(sorted(changed))}")
    gone, added = (len(set(a.samples) - set(b.samples)) for a, b in ((old, new), (new, old)))
    if gone or added:
        print(f"note: {words.plural(gone, 'case')} only in OLD, {words.plural(added, 'case')} only in NEW")
    loads = [max(case.load) for case in cases]
    if loads and numpy.median(loads) > paired.IDLE:
        print(
            f"note: the machine was loaded: even beside the quietest samples the calibration kernel took"
            f" {numpy.exp(numpy.median(loads)):.1f} times its best; measure on an idle machine to see more"
        )


def _print_seen(families):
    seen = sorted(family.seen for family in families)
    small = sum(ratio <= 1.05 for ratio in seen)
    print(
        f"what would have been seen in {100 * gate.SEEN:.0f} %: {_ratio(seen[0])} in the surest family,"
        f" {_ratio(seen[len(seen) // 2])} in the middle one, {_ratio(seen[-1])} in the least sure;"
        f" 1.05 or less in {small} of {len(seen)}. An unchanged program fails once in"
        f" {1 / gate.ALARMS:.0f} runs"
    )


def _ratio(ratio):
    return f"{ratio:.3f}" if ratio < 10 else ">10"
