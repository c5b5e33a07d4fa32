"""Costs free of noise: pair tests, node visits and bytes moved."""
from .. import runfile, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Section
from ..table import Cell, Table

KINDS = {"pair_tests": "pair tests", "node_visits": "node visits", "bytes": "bytes moved"}


def build(report):
    section = Section("counts", "Costs counted, free of noise")
    for run in report.having("counts"):
        rows = run.list("counts")
        figure = _figure(report, run, rows)
        section.blocks += report.heading(run) + ([figure] if figure else []) + [_table(report, run, rows)]
    return section if section.blocks else None


def _figure(report, run, rows):
    panels = []
    for key, name in KINDS.items():
        for scene in sorted({runfile.scene_of(row["input"]) for row in rows}):
            panel = Panel(
                f"{scene}: {name}",
                Axis("spheres n", log=True),
                Axis(f"{name} a sphere", log=True),
                height=260,
            )
            for variant in sorted({row["variant"] for row in rows}):
                points = sorted(
                    (runfile.n_of(row["input"]), row[key], row["input"])
                    for row in rows
                    if row["variant"] == variant and runfile.scene_of(row["input"]) == scene and row.get(key)
                )
                if points:
                    info = run.info(variant)
                    panel.series.append(
                        Series(
                            info.label,
                            [p[0] for p in points],
                            [p[1] / p[0] for p in points],
                            report.looks.variant(info),
                            hover=[
                                f"<b>{info.label}</b><br>{i}<br>{words.count(c)} {name},"
                                f" {words.significant(c / n, 3)} a sphere"
                                for n, c, i in points
                            ],
                            chains=[report.chain(run, i, variant) for _, _, i in points],
                            shown=not info.rounded,
                        )
                    )
            if panel.series and max(len(s.x) for s in panel.series) > 1:
                panels.append(panel)
    if not panels:
        return None
    return Figure(
        f"counts{report.key(run)}",
        "What each variant does for each sphere, counted",
        (
            "Both axes are logarithmic; a level line is a cost that does not depend on the length of the"
            " chain. Counts are the same on every machine and in every repetition, so that a difference is a"
            " difference of algorithms."
        ),
        panels,
    )


def _table(report, run, rows):
    return Table(
        f"counts{report.key(run)}",
        "Counts",
        "The same on every machine and in every repetition.",
        ["chain", "variant", *KINDS.values()],
        [
            [
                row["input"],
                row["variant"],
                *[Cell(words.count(row[key]), row[key]) if row.get(key) is not None else "" for key in KINDS],
            ]
            for row in sorted(
                rows,
                key=lambda row: (runfile.scene_of(row["input"]), runfile.n_of(row["input"]), row["variant"]),
            )
        ],
        words=2,
    )
