"""An animation frame by frame: what each frame costs."""
import numpy

from .. import words
from ..figure import Axis, Figure, Panel, Series
from ..section import Section
from ..style import Look


def build(report):
    section = Section("animation", "Frame by frame")
    for run in report.runs:
        rows = [row for row in run.list("animation") if len(row.get("frames", [])) > 1]
        if rows:
            section.blocks += report.heading(run) + [_figure(report, run, rows)]
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
                    report.look(run, row["variant"]),
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
            "Each point is one frame: update of the moved chain and find. Each was timed once: a peak of"
            " one variant alone is what else the machine did; one of all is a frame with many pairs, or with more of the"
            " chain moved. Right: the pairs of the same frames."
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
