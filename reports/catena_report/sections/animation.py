"""An animation frame by frame: what each frame costs, and what a moved frame saves over a new chain."""
import numpy

from .. import compare, statistics, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Section
from ..style import Look
from ..table import Cell, Table


def build(report):
    section = Section("animation", "Frame by frame")
    for run in report.runs:
        rows = [row for row in run.list("animation") if len(row.get("frames", [])) > 1]
        if rows or run.list("coherence"):
            section.blocks += report.heading(run)
        if rows:
            section.blocks.append(_figure(report, run, rows))
        if run.list("coherence"):
            section.blocks.append(_table(report, run))
    return section if section.blocks else None


def _figure(report, run, rows):
    panels = []
    for input_ in dict.fromkeys(row["input"] for row in rows):
        mine = [row for row in rows if row["input"] == input_]
        times = Panel(f"{input_}: time of a frame", Axis("frame"), Axis("update + find, ms", log=True))
        for row in mine:
            costs = [frame["update_ms"] + frame["find_ms"] for frame in row["frames"]]
            times.series.append(
                Series(
                    row["variant"],
                    [frame["frame"] for frame in row["frames"]],
                    costs,
                    report.looks.variant(row["variant"]),
                    size=0.6,
                    hover=[_hover(row["variant"], frame, cost) for frame, cost in zip(row["frames"], costs)],
                    chains=[
                        {**report.chain(run, input_, row["variant"]), "frame": frame["frame"]}
                        for frame in row["frames"]
                    ],
                )
            )
        frames = mine[0]["frames"]
        pairs = Panel(
            f"{input_}: pairs",
            Axis("frame"),
            Axis("pairs"),
            [
                Series(
                    "pairs",
                    [frame["frame"] for frame in frames],
                    [frame["pairs"] for frame in frames],
                    Look("ink"),
                    size=0.6,
                    legend=False,
                    hover=[
                        f"frame {frame['frame']}: {words.plural(frame['pairs'], 'pair')}" for frame in frames
                    ],
                )
            ],
        )
        panels += [times, pairs]
    medians = {}
    for row in rows:
        medians.setdefault(row["variant"], []).extend(
            frame["update_ms"] + frame["find_ms"] for frame in row["frames"]
        )
    leader = min(medians, key=lambda name: numpy.median(medians[name]))
    return Figure(
        f"animation{report.key(run)}",
        (
            f"A frame takes {words.duration(float(numpy.median(medians[leader])))} with {leader}, the "
            f"fastest of {words.plural(len(medians), 'variant')}"
        ),
        (
            "Each point is one frame: update of the moved chain and find. Peaks are frames with many pairs or"
            " with more of the chain moved. Right: the pairs of the same frames."
        ),
        panels,
    )


def _hover(variant, frame, cost):
    moved = f"<br>{words.count(frame['moved'])} spheres moved" if frame.get("moved") is not None else ""
    return (
        f"<b>{variant}</b><br>frame {frame['frame']}: {words.duration(cost)}<br>update"
        f" {words.ms(frame['update_ms'])}, find"
        f" {words.ms(frame['find_ms'])} ms<br>{words.plural(frame['pairs'], 'pair')}{moved}"
    )


def _table(report, run):
    rows = []
    for row in run.list("coherence"):
        if not row.get("rebuild_ms") or not row.get("update_ms"):
            continue
        ratio = statistics.ratio(row["rebuild_ms"], row["update_ms"])
        p = statistics.mann_whitney(row["rebuild_ms"], row["update_ms"])
        verdict = {compare.FASTER: "rebuild is faster", compare.SLOWER: "update is faster"}.get(
            compare.verdict(ratio, p, compare.LEAST_RATIO), "no significant difference"
        )
        rows.append(
            [
                row["input"],
                row["variant"],
                verdict,
                *[
                    Cell(words.ms(numpy.median(row[key])), float(numpy.median(row[key])))
                    for key in ("rebuild_ms", "update_ms")
                ],
                Cell(words.interval(ratio), ratio.value),
            ]
        )
    return Table(
        f"coherence{report.key(run)}",
        "A new chain against update() of a moved frame",
        (
            f"Median milliseconds; faster is a ratio past {compare.LEAST_RATIO:g} and significant by"
            " Mann-Whitney at 5 %."
        ),
        ["chain", "variant", "verdict", "rebuild, ms", "update, ms", "ratio"],
        rows,
        words=3,
    )
