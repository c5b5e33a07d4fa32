"""What two runs counted: the same in every run of the same program, so that a change in it needs no test."""
import dataclasses

from . import paired

COUNTED = ("pair_tests", "node_visits", "bytes")
ANSWERED = ("missing", "invented")  # pairs, by an arithmetic that rounds
LEAST_RATIO = 1.005  # a smaller change of a count is told, but no regression


@dataclasses.dataclass(frozen=True)
class Change:
    """A count of one case that is another in NEW."""

    input: str
    variant: str
    count: str
    old: int
    new: int

    @property
    def ratio(self):
        return self.new / self.old if self.old else float("inf")


@dataclasses.dataclass(frozen=True)
class Work:
    """Of each list: [Change]. A case whose counts moved both ways has traded, and its time decides."""

    more: list
    fewer: list
    traded: list
    small: list  # by less than LEAST_RATIO
    compared: int  # cases


def compared(old, new):
    """The Work of two runs, of inputs whose chains are the same in both."""
    others = paired.changed_inputs(old, new)
    before, after = counts(old), counts(new)
    shared = sorted(case for case in set(before) & set(after) if case[0] not in others)
    found = Work([], [], [], [], len(shared))
    for case in shared:
        changes = [
            Change(*case, key, before[case][key], after[case][key])
            for key in (*COUNTED, *ANSWERED)
            if key in before[case] and key in after[case] and before[case][key] != after[case][key]
        ]
        grown, shrunk = ([c for c in changes if (c.new > c.old) == up] for up in (True, False))
        grown_much = [c for c in grown if c.ratio >= LEAST_RATIO or c.count in ANSWERED]
        shrunk_much = [c for c in shrunk if c.ratio <= 1 / LEAST_RATIO or c.count in ANSWERED]
        wrong = [c for c in grown_much if c.count in ANSWERED]  # no saving of work pays for it
        if wrong or (grown_much and not shrunk_much):
            found.more.extend(grown_much)
        elif grown_much:
            found.traded.extend(changes)
        elif shrunk_much:
            found.fewer.extend(shrunk_much)
        else:
            found.small.extend(changes)
    return found


def counts(run):
    """{(input, variant): {count: number}} of a run, what was searched and what was answered."""
    found = {}
    for row in run.list("counts"):
        found.setdefault((row["input"], row["variant"]), {}).update(
            {key: int(row[key]) for key in COUNTED if key in row}
        )
    for (input_, variant, _), counters in run.counters.items():
        case = found.setdefault((input_, variant), {})
        for key in ANSWERED:  # the most of any stage
            case[key] = max(case.get(key, 0), int(counters.get(key, 0)))
    return found
