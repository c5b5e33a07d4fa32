"""Error against run time, with the Pareto front."""
import html

from .. import words
from ..figure import Axis, Figure, Panel, Series
from ..section import Prose, Section
from ..style import Look


def build(report):
    section = Section("work-precision", "Error against run time")
    for run in report.having("work_precision"):
        points = [point for point in run.catena["work_precision"].get("points", []) if point.get("median_ms")]
        if points:
            section.blocks += report.heading(run) + [_figure(report, run, points)]
            out = run.catena["work_precision"].get("left_out", [])
            if out:
                section.blocks.append(_left_out(out))
    return section if section.blocks else None


def _left_out(lines):
    """Lines "variant: reason", by reason."""
    reasons = {}
    for line in lines:
        variant, _, reason = line.partition(": ")
        reasons.setdefault(reason, []).append(html.escape(variant))
    return Prose(
        f"{words.plural(len(lines), 'variant').capitalize()} left out, with the reason",
        [f"{html.escape(reason)}: {words.listed(variants)}" for reason, variants in reasons.items()],
        folded=True,
    )


def _figure(report, run, points):
    front = sorted((point for point in points if point["front"]), key=lambda point: point["median_ms"])
    panels = []
    for tube in dict.fromkeys(_tube(point) for point in points):
        mine = [point for point in points if _tube(point) == tube]
        panels.append(
            _panel(
                report,
                run,
                mine,
                [point for point in front if _tube(point) == tube],
                "tube_error",
                "error of tube and answer",
                f"{tube}: what the spheres make of the tube",
            )
        )
        wrong = [point for point in mine if point["answer_error"] > 0]
        if wrong:
            panels.append(
                _panel(
                    report,
                    run,
                    wrong,
                    [],
                    "answer_error",
                    "error of the answer alone",
                    f"{tube}: what the arithmetic adds",
                )
            )
    names = sorted({run.info(point["variant"]).label for point in front})
    return Figure(
        f"work-precision{report.key(run)}",
        (
            f"Of {words.plural(len({p['variant'] for p in points}), 'variant')}, {words.listed(names, 4)} "
            f"{'are' if len(names) > 1 else 'is'} on the Pareto front"
        ),
        (
            "Each point is one variant at one number of spheres; further left is faster, lower is more"
            " precise. The line joins the points that no other beats in both; points that another beats are"
            " grey. More spheres approximate the tube better and take longer. Bars are the quartiles of the"
            " time."
        ),
        panels,
        columns=min(2, len(panels)),
    )


def _tube(point):
    return point["tube"] + (f", moved by {point['offset']:g} radii" if point.get("offset") else "")


def _panel(report, run, points, front, key, what, title):
    panel = Panel(
        title, Axis("build + find, ms", log=True), Axis(f"{what}, tube radii", log=True), height=420
    )
    for variant in sorted(
        {point["variant"] for point in points}, key=lambda name: (not run.info(name).exact, name)
    ):
        for on_front in (False, True):
            rows = [
                p for p in points if p["variant"] == variant and p["front"] is on_front and _error(p, key) > 0
            ]
            if rows:
                look = report.look(run, variant)
                look = look if on_front else Look("faint", look.marker, look.dash, look.hollow)
                panel.series.append(
                    Series(
                        run.info(variant).label if on_front else "dominated",
                        [p["median_ms"] for p in rows],
                        [_error(p, key) for p in rows],
                        look,
                        line=False,
                        low=[p["lower_quartile_ms"] for p in rows],
                        high=[p["upper_quartile_ms"] for p in rows],
                        across=True,
                        hover=[_hover(run, p) for p in rows],
                        size=1.25 if on_front else 0.8,
                        legend=on_front or not any(s.name == "dominated" for s in panel.series),
                    )
                )
    if front:
        panel.series.insert(
            0,
            Series(
                "Pareto front",
                [p["median_ms"] for p in front],
                [_error(p, key) for p in front],
                Look("muted"),
                markers=False,
            ),
        )
    return panel


def _error(point, key):
    return point[key] if key == "answer_error" else point["tube_error"] + point["answer_error"]


def _hover(run, point):
    return (
        f"<b>{run.info(point['variant']).label}</b><br>{_tube(point)}, n ="
        f" {words.count(point['n'])}<br>{words.duration(point['median_ms'])}, quartiles"
        f" {words.ms(point['lower_quartile_ms'])} to {words.ms(point['upper_quartile_ms'])} ms<br>error of"
        f" the tube {point['tube_error']:.2e}, of the answer {point['answer_error']:.2e} radii"
    )
