"""Which variant to use: over the number of spheres, the density of contacts and the coherence of frames."""
from .. import runfile, statistics, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Section
from ..style import Look
from ..table import Cell, Table

FLOOR = 1e-6  # where a chain without pairs is drawn on the logarithmic axis


def build(report):
    section = Section("advice", "Which variant should I use?")
    for run in report.runs:
        one_off, moving = _one_off(run), _moving(run)
        if not one_off and not moving:
            continue
        panels = [
            _panel(report, run, cases, title)
            for cases, title in (
                (one_off, "a chain seen once: build + find"),
                (moving, "a chain that moves: update + find"),
            )
            if cases
        ]
        section.blocks += report.heading(run) + [
            Figure(
                f"advice{report.key(run)}",
                _message(report, run, one_off or moving),
                (
                    "Each point is a chain that was timed: right is longer, up has more contacts (chains"
                    " without any lie at the bottom; chains that would coincide are set side by side). Its"
                    " colour and marker are the variant with the least median; a grey ring says that at least"
                    " one other variant does not differ from it significantly (Mann-Whitney with Holm's"
                    " correction; overlapping ranges where the repetitions are too few for it, within a"
                    " factor of 2 below three): hover for which, and take either. Exact variants"
                    " of catena's own only."
                ),
                panels,
            ),
            _table(report, run, one_off, moving),
        ]
    return section if section.blocks else None


def _one_off(run):
    """input -> {variant: samples}, where two variants or more were timed."""
    found = {}
    for input_ in run.inputs():
        row = {variant: run.total(input_, variant) for variant in run.recommended()}
        row = {variant: times for variant, times in row.items() if times is not None}
        if len(row) > 1:
            found[input_] = row
    return found


def _moving(run):
    """The same for moved frames: update() of `coherence` and the find that follows it."""
    found = {}
    for row in run.list("coherence"):
        find = run.samples.get((row["input"], row["variant"], "find"))
        if find is not None and run.info(row["variant"]).recommended and row.get("update_ms"):
            size = min(len(find), len(row["update_ms"]))
            found.setdefault(row["input"], {})[row["variant"]] = find[:size] + row["update_ms"][:size]
    return {input_: row for input_, row in found.items() if len(row) > 1}


def _panel(report, run, cases, title):
    panel = Panel(
        title, Axis("spheres n", log=True), Axis("contact density, pairs a sphere", log=True), height=380
    )
    points, places = {}, _beside(run, cases)
    for input_, row in cases.items():
        leader, alike = statistics.best(row)
        points.setdefault(leader, []).append((input_, alike))
    rings = [(input_, alike) for several in points.values() for input_, alike in several if alike]
    if rings:
        panel.series.append(
            Series(
                "no significant difference",
                [places[i] for i, _ in rings],
                [_height(run, i) for i, _ in rings],
                Look("muted", hollow=True),
                line=False,
                size=2.6,
            )
        )
    for leader, several in sorted(points.items()):
        panel.series.append(
            Series(
                leader,
                [places[input_] for input_, _ in several],
                [_height(run, input_) for input_, _ in several],
                report.look(run, leader),
                line=False,
                size=1.4,
                hover=[
                    f"<b>{leader}</b><br>{input_}, {run.density(input_) or 0:.3g} pairs a sphere<br>"
                    f"{words.duration(statistics.median(cases[input_][leader]).value)}"
                    + (f"<br>not significantly different:<br>{'<br>'.join(alike)}" if alike else "")
                    for input_, alike in several
                ],
                chains=[report.chain(run, input_, leader) for input_, _ in several],
            )
        )
    return panel


def _beside(run, cases):
    """input -> n as drawn: chains of one n and one density are set side by side."""
    taken, places = {}, {}
    for input_ in cases:
        spot = runfile.n_of(input_), round(_height(run, input_), 6)
        places[input_] = spot[0] * 1.06 ** taken.get(spot, 0)
        taken[spot] = taken.get(spot, 0) + 1
    return places


def _height(run, input_):
    return max(run.density(input_) or 0, FLOOR)


def leaders(cases):
    """variant -> (how many chains it is the fastest on, on how many of them significantly), most first."""
    found = {}
    for row in cases.values():
        leader, alike = statistics.best(row)
        wins, alone = found.get(leader, (0, 0))
        found[leader] = wins + 1, alone + (not alike)
    return dict(sorted(found.items(), key=lambda item: (-item[1][0], -item[1][1])))


def _message(report, run, cases):
    name, (wins, alone) = next(iter(leaders(cases).items()))
    return (
        f"{name} has the least median on {wins} of {words.plural(len(cases), 'chain')}, significantly on"
        f" {alone}"
    )


def _table(report, run, one_off, moving):
    rows = []
    for kind, cases in (("seen once", one_off), ("moving", moving)):
        for input_, row in cases.items():
            leader, alike = statistics.best(row)
            time = statistics.median(row[leader])
            rows.append(
                [
                    input_,
                    kind,
                    leader,
                    words.listed(alike, 3) if alike else "none",
                    Cell(f"{run.density(input_) or 0:.3g}", run.density(input_)),
                    Cell(words.ms(time.value), time.value),
                ]
            )
    return Table(
        f"choice{report.key(run)}",
        "The fastest variant for each chain",
        "With those that do not differ significantly from it.",
        ["chain", "use", "fastest", "no significant difference", "pairs a sphere", "median, ms"],
        rows,
        words=4,
    )
