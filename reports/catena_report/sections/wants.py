"""What find costs by what is asked for."""
import numpy

from .. import words
from ..section import Section
from ..table import Cell, Table

WANTS = ("any", "counts", "pairs")


def build(report):
    section = Section("wants", "What it costs to ask for more")
    for run in report.having("wants"):
        section.blocks += report.heading(run) + [_table(report, run)]
    return section if section.blocks else None


def _table(report, run):
    found = {}
    for row in run.list("wants"):
        found.setdefault((row["input"], row["variant"]), {})[row["want"]] = row["ms"]
    rows = [
        [
            input_,
            variant,
            *[
                (
                    Cell(words.ms(numpy.median(asked[want])), float(numpy.median(asked[want])))
                    if asked.get(want)
                    else ""
                )
                for want in WANTS
            ],
        ]
        for (input_, variant), asked in sorted(found.items())
    ]
    return Table(
        f"wants{report.key(run)}",
        "What find costs by what is asked for",
        (
            "Median milliseconds: whether anything collides, counts for each sphere, or counts and the list"
            " of pairs."
        ),
        ["scene", "variant", *[f"{want}, ms" for want in WANTS]],
        rows,
        words=2,
    )
