"""How much the variant auto took beside the quickest single one, chain by chain."""
import numpy

from .. import runfile, statistics, words
from ..section import Section
from ..table import Cell, Table

NEAR = 1.05  # times the quickest


def build(report):
    section = Section("regret", "What the choice of auto costs")
    for run in report.having("regret"):
        rows = ratios(run)
        section.blocks += report.heading(run) + [_sizes(report, run, rows), _table(report, run, rows)]
    return section if section.blocks else None


def ratios(run):
    """(row, auto / best at once, auto / best in the end) of every row that has times, by scene and size; at once is
    None in a run of before that was measured."""
    rows = [row for row in run.list("regret") if row.get("auto_ms") and row.get("best_ms")]
    rows.sort(key=lambda row: (runfile.scene_of(row["input"]), runfile.n_of(row["input"])))
    return [
        (
            row,
            statistics.ratio(row["first_ms"], row["best_first_ms"])
            if row.get("first_ms") and row.get("best_first_ms")
            else None,
            statistics.ratio(row["auto_ms"], row["best_ms"]),
        )
        for row in rows
    ]


def _both(rows):
    return all(first is not None for _, first, _ in rows)


def _sizes(report, run, rows):
    both = _both(rows)
    by_size = {}
    for row, first, settled in rows:
        by_size.setdefault(runfile.n_of(row["input"]), []).append((first if both else settled, settled))
    return Table(
        f"regret-sizes{report.key(run)}",
        _verdict(rows),
        "By the number of spheres. "
        + (
            "Which variant is the quickest is not known beforehand: at once auto takes what it chooses before it"
            " searches, by what is known of a chain without reading it again. Of some 40 searches that follow it has"
            " others do a few, and goes on with who took less."
            if both
            else "After some 40 searches of a chain, of which auto had others do a few and went on with who took less;"
            " what it chose before it searched was not measured by itself."
        ),
        ["spheres", "chains", "auto / quickest, geometric mean", "the most", "more than 5 % above"]
        + (["after 40 searches, geometric mean", "the most then"] if both else []),
        [
            [
                Cell(words.count(n), n),
                Cell(str(len(pairs)), len(pairs)),
                *_summed([first.value for first, _ in pairs]),
                *(_summed([settled.value for _, settled in pairs])[:2] if both else []),
            ]
            for n, pairs in sorted(by_size.items())
        ],
    )


def _summed(values):
    return [
        *[Cell(words.significant(value, 3), value) for value in (_mean(values), max(values))],
        Cell(str(_above(values)), _above(values)),
    ]


def _table(report, run, rows):
    both = _both(rows)
    keys = ("first_ms", "best_first_ms") if both else ("auto_ms", "best_ms")
    return Table(
        f"regret{report.key(run)}",
        "What auto took, chain by chain",
        (
            "Build and find together, medians, in random turns"
            + (
                ": of variants made anew for each search, as who searches one chain once has them; then of what auto"
                " settled on in some 40 searches, beside the quickest that has searched as often. "
                if both
                else ". "
            )
            + "Of the processor, so that what else the machine did is not in it; by the wall clock where auto took"
            " several threads, or a device."
        ),
        [
            "chain",
            *(["auto took at once", "settled on"] if both else ["auto took"]),
            *["quickest single variant", "clock", "auto, ms", "quickest, ms", "ratio"],
            *(["ratio then"] if both else []),
        ],
        [
            [
                row["input"],
                *([row["first"]] if both else []),
                row["chosen"],
                row["best"],
                row.get("clock", "wall"),
                *[Cell(words.ms(numpy.median(row[key])), float(numpy.median(row[key]))) for key in keys],
                *[Cell(words.interval(ratio), ratio.value) for ratio in ([first, settled] if both else [settled])],
            ]
            for row, first, settled in rows
        ],
        words=5 if both else 4,
    )


def _mean(values):
    return float(numpy.exp(numpy.mean(numpy.log(values))))


def _above(values):
    return sum(value > NEAR for value in values)


def _verdict(rows):
    if not rows:
        return "No chain was measured"
    settled = [ratio.value for _, _, ratio in rows]
    if not _both(rows):
        return f"After some 40 searches auto took {_most(settled)}"
    return (
        f"At once auto took {_most([first.value for _, first, _ in rows])}; after some 40 searches"
        f" {words.significant(_mean(settled), 3)} times"
    )


def _most(values):
    return (
        f"at most 5 % more than the quickest variant on {len(values) - _above(values)} of"
        f" {words.plural(len(values), 'chain')}; {words.significant(_mean(values), 3)} times as much on the"
        " geometric mean"
    )
