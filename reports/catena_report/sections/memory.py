"""Memory: what each host variant holds a sphere, and its stages against what the machine's memory carries."""
import numpy

from .. import runfile, statistics, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Section
from ..style import Look
from ..table import Cell, Table

SPHERE = 16  # bytes, as stored
SHOWN = 8  # series drawn at first
WELL_ABOVE = 2  # times the time of a copy, from which on something else than memory decides


def build(report):
    section = Section("memory", "Memory: how much, how fast")
    for run in report.runs:
        blocks = [_held(report, run), _roofline(report, run), _table(report, run)]
        blocks = [block for block in blocks if block]
        if blocks:
            section.blocks += report.heading(run) + blocks
    return section if section.blocks else None


def bandwidth(run):
    """The median of the measured copies, bytes a nanosecond (10^9 bytes a second), with its interval, or None."""
    copies = run.catena.get("bandwidth", {}).get("gb_s")
    return statistics.median(copies) if copies else None


def traffic(run):
    """[(input, variant, stage, bytes, milliseconds)] of host stages: a construction reads the chain once and
    writes what it holds afterwards; a traversal reads what its tests compare, as counted.
    """
    held = {(row["input"], row["variant"]): row["held_bytes"] for row in run.list("memory")}
    read = {(row["input"], row["variant"]): row["bytes"] for row in run.list("counts") if row.get("bytes")}
    found = []
    for (input_, variant, stage), times in sorted(run.samples.items()):
        info = run.info(variant)
        if not info.host_only or not info.recommended:
            continue
        if stage == "build" and (input_, variant) in held:
            size = SPHERE * runfile.n_of(input_) + max(0, held[input_, variant])
        elif stage == "find" and (input_, variant) in read:
            size = read[input_, variant]
        else:
            continue
        found.append((input_, variant, stage, size, float(numpy.median(times))))
    return found


def _held(report, run):
    rows = run.list("memory")
    panels, order = [], {}
    for row in rows:
        order.setdefault(row["variant"], []).append(row["held_bytes"] / runfile.n_of(row["input"]))
    shown = sorted(order, key=lambda name: (-len(order[name]), numpy.median(order[name])))[:SHOWN]
    for scene, inputs in report.sizes(run).items():
        panel = Panel(scene, Axis("spheres n", log=True), Axis("bytes held a sphere", log=True), height=280)
        for variant in sorted(order):
            mine = sorted(
                (runfile.n_of(row["input"]), row["held_bytes"], row["peak_bytes"], row["input"])
                for row in rows
                if row["variant"] == variant and row["input"] in inputs and row["held_bytes"] > 0
            )
            if mine:
                panel.series.append(
                    Series(
                        variant,
                        [n for n, *_ in mine],
                        [held / n for n, held, _, _ in mine],
                        report.look(run, variant),
                        shown=variant in shown,
                        hover=[
                            f"<b>{variant}</b><br>{input_}<br>{held / n:.1f} bytes a sphere held,"
                            f" {words.count(held)} in all; peak {words.count(peak)}"
                            for n, held, peak, input_ in mine
                        ],
                    )
                )
        if panel.series and max(len(series.x) for series in panel.series) > 1:
            panels.append(panel)
    if not panels or all(run.info(series.name).all_pairs for panel in panels for series in panel.series):
        return None
    drawn = [
        (size, series.name)
        for panel in panels
        for series in panel.series
        for size in series.y
        if not run.info(series.name).all_pairs
    ]
    (least, low), (most, high) = min(drawn), max(drawn)
    return Figure(
        f"memory{report.key(run)}",
        f"From {least:.3g} bytes a sphere ({low}) to {most:.3g} ({high}) over all chains, beside the chain's own {SPHERE}",
        (
            "What the heap holds after a build and a find, the answer apart, divided by n; host variants. A level"
            " line is memory in proportion to the chain. The table has the peak too."
        ),
        panels,
    )


def _roofline(report, run):
    carries, points = bandwidth(run), traffic(run)
    if not carries or not points:
        return None
    panels, share = [], {}
    for stage, title in (("build", "construction"), ("find", "traversal")):
        mine = [point for point in points if point[2] == stage and point[4] > 0]
        if not mine:
            continue
        panel = Panel(
            title, Axis("bytes a sphere", log=True), Axis("ns a sphere", log=True), height=340
        )
        ends = [size / runfile.n_of(input_) for input_, _, _, size, _ in mine]
        ends = [min(ends), max(ends)]
        panel.series.append(
            Series("copy bandwidth", ends, [x / carries.value for x in ends], Look("muted", dash="dash"), markers=False)
        )
        for variant in sorted({point[1] for point in mine}):
            own = [(i, runfile.n_of(i), size, ms) for i, name, _, size, ms in mine if name == variant]
            panel.series.append(
                Series(
                    variant,
                    [size / n for _, n, size, _ in own],
                    [1e6 * ms / n for _, n, _, ms in own],
                    report.look(run, variant),
                    line=False,
                    hover=[
                        f"<b>{variant}</b><br>{i}<br>{size / n:.3g} bytes and {1e6 * ms / n:.3g} ns a sphere:"
                        f" {_rate(size, ms):.3g} GB/s, {_rate(size, ms) / carries.value:.0%} of the copy"
                        for i, n, size, ms in own
                    ],
                )
            )
        panels.append(panel)
        slow = sum(_rate(size, ms) * WELL_ABOVE < carries.value for _, _, _, size, ms in mine)
        share[title] = slow, len(mine)
    text = words.listed(f"{slow} of {words.plural(of, title)}" for title, (slow, of) in share.items() if slow)
    slow, copies = sum(slow for slow, _ in share.values()), f"more than {WELL_ABOVE} times as long as a copy of as many bytes"
    return Figure(
        f"roofline{report.key(run)}",
        (
            f"Memory does not bound {text}: {'it takes' if slow == 1 else 'they take'} {copies}"
            if slow
            else f"Memory may bound every {' and every '.join(share)}: none takes {copies}"
        ),
        (
            f"The dashed line is a copy of arrays that no cache holds, on one core of this machine:"
            f" {words.interval(carries)} GB/s, read and written. Above it a stage waits for something else than"
            " memory; below it, its data came from a cache. Bytes of a construction: the chain read once, what it"
            " holds afterwards written once; of a traversal: what its tests read, as counted."
        ),
        panels,
    )


def _rate(size, ms):
    return size / (1e6 * ms)


def _table(report, run):
    rows = [
        [
            row["input"],
            row["variant"],
            *[
                Cell(f"{row[key] / runfile.n_of(row['input']):.3g}", row[key] / runfile.n_of(row["input"]))
                for key in ("held_bytes", "peak_bytes")
            ],
            Cell(words.count(row["held_bytes"]), row["held_bytes"]),
            Cell(words.count(row["peak_bytes"]), row["peak_bytes"]),
        ]
        for row in sorted(
            run.list("memory"),
            key=lambda row: (runfile.scene_of(row["input"]), runfile.n_of(row["input"]), row["variant"]),
        )
    ]
    if not rows:
        return None
    return Table(
        f"memory{report.key(run)}",
        "Memory of every host variant",
        (
            "Held: by the heap after a build and a find, the answer apart. Peak: what became resident meanwhile,"
            " in whole pages, the answer included; memory that the process had kept from before is not in it."
        ),
        ["chain", "variant", "held, bytes a sphere", "peak, bytes a sphere", "held", "peak"],
        rows,
        words=2,
    )
