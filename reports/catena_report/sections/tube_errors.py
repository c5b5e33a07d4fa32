"""What a chain of spheres makes of a tube that is known exactly: the error falls with the square of the
spacing.
"""
from .. import statistics, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Section
from ..style import COLOURS, MARKERS, Look
from ..table import Cell, Table

MEASURES = {
    "gap": ("deepest dip between spheres", "gap, tube radii"),
    "volume_deficit": ("volume missing", "volume deficit, share of the tube"),
    "depth_error": ("error of contact depth", "depth error, tube radii"),
}
SMALL = (
    1.0  # spacing in radii: the law is that of spacings below it, and of the smaller half of those measured
)


def build(report):
    runs = report.having("tube_errors")
    if not runs:
        return None
    lines = runs[0].list("tube_errors")  # exact quantities: the same on every machine
    tubes = sorted({line["tube"] for line in lines})
    looks = {
        tube: Look(COLOURS[at % len(COLOURS)], MARKERS[at % len(MARKERS)]) for at, tube in enumerate(tubes)
    }
    panels, slopes = [], {}
    for key, (title, axis) in MEASURES.items():
        panel = Panel(title, Axis("spacing of neighbours, tube radii", log=True), Axis(axis, log=True))
        for tube in tubes:
            points = sorted(
                (line["spacing"], line[key], line["n"])
                for line in lines
                if line["tube"] == tube and line.get(key, 0) > 0
            )
            if not points:
                continue
            panel.series.append(
                Series(
                    tube,
                    [p[0] for p in points],
                    [p[1] for p in points],
                    looks[tube],
                    hover=[
                        f"<b>{tube}</b><br>n = {words.count(n)}, spacing {x:.3g}<br>{axis} {y:.3g}"
                        for x, y, n in points
                    ],
                )
            )
            small = [(x, y) for x, y, _ in points[: max(statistics.FEWEST_SIZES, (len(points) + 1) // 2)] if x <= SMALL]
            slope = statistics.exponent([x for x, _ in small], [y for _, y in small])
            if slope:
                slopes[tube, key] = slope
        if panel.series:
            panel.series.append(_law(panel))
            panels.append(panel)
    powers = [slope.value for slope in slopes.values()]
    message = (
        f"The error falls with the power {min(powers):.2f} to {max(powers):.2f} of the spacing: theory says 2"
        if powers
        else "What a chain of spheres makes of a tube"
    )
    section = Section("tube-errors", "What the spheres make of the tube")
    section.blocks = [
        Figure(
            "tube-errors",
            message,
            (
                "Both axes are logarithmic. A tube known in closed form is cut into spheres at shrinking"
                " spacing; the dotted line has slope 2. No algorithm and no arithmetic is involved: this is"
                " the approximation itself, the floor under every error."
            ),
            panels,
            columns=3,
        ),
        Table(
            "tube-slopes",
            "Fitted slopes of the error over the spacing",
            (
                f"The smaller half of the spacings, those up to {SMALL:g} radius only. Least squares on the"
                " logarithms with the 95 % t interval; theory: 2."
            ),
            ["tube", *[title for title, _ in MEASURES.values()]],
            [
                [
                    tube,
                    *[
                        (
                            Cell(words.interval(slopes[tube, key], 3), slopes[tube, key].value)
                            if (tube, key) in slopes
                            else ""
                        )
                        for key in MEASURES
                    ],
                ]
                for tube in tubes
                if any((tube, key) in slopes for key in MEASURES)
            ],
        ),
    ]
    if not slopes:
        section.blocks.pop()
    return section


def _law(panel):
    """Slope 2 through the middle point of the first series."""
    series = panel.series[0]
    xs = sorted(x for s in panel.series for x in s.x)
    middle = len(series.x) // 2
    scale = series.y[middle] / series.x[middle] ** 2
    return Series(
        "slope 2",
        [xs[0], xs[-1]],
        [scale * xs[0] ** 2, scale * xs[-1] ** 2],
        Look("muted", dash="dot"),
        markers=False,
    )
