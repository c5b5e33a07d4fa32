"""The error of the arithmetic where it starts: far from the origin, and for contacts near to touching. Part of the
section on error against run time.
"""
import shlex

from .. import runfile, words
from ..figure import Axis, Figure, Panel, Series
from ..style import DASHES, of_arithmetic
from .stability import NOT_ANSWERED

# scene of the stability matrix -> its one parameter, the axis that it makes, and the axis' value
SWEEPS = {
    "far": ("exponent", "distance from the origin, radii", lambda text: 2.0 ** float(text)),
    "grazing": ("margin", "margin of every contact, |q - t| / t", float),
}


def sweep(run, scene):
    """arithmetic -> {value of the sweep: its lines of the stability matrix} of catena's own variants."""
    parameter, _, value_of = SWEEPS[scene]
    found = {}
    for line in run.list("stability"):
        given = runfile.scene_and_n(line["scene"])[0].partition(":")
        info = run.info(line["variant"])
        name, _, text = given[2].partition("=")
        if given[0] != scene or name != parameter or "," in given[2] or info.peer or line["outcome"] in NOT_ANSWERED:
            continue
        if value_of(text) > 0:
            found.setdefault(info.arithmetic, {}).setdefault(value_of(text), []).append(line)
    return {
        name: dict(sorted(found[name].items()))
        for name in sorted(found, key=lambda name: list(DASHES).index(name) if name in DASHES else 9)
    }


def wrong_share(line):
    """Pairs missing and invented over the exact ones."""
    return (line.get("missing", 0) + line.get("invented", 0)) / max(1, line["exact_pairs"])


def figure(report, run):
    """Where each arithmetic gets pairs wrong and bounds fall short; None without sweeps."""
    panels, begins, swept = [], {}, set()
    for scene, (_, axis, _) in SWEEPS.items():
        found = sweep(run, scene)
        if not any(len(lines) > 2 for lines in found.values()):
            continue
        swept |= set(found)
        panel = Panel(f"{scene}: pairs wrong", Axis(axis, log=True), Axis("pairs wrong, % of the exact ones"), height=300)
        short = Panel(f"{scene}: bounds short", Axis(axis, log=True), Axis("shortfall, share of the bound", log=True), height=300)
        for arithmetic, lines in found.items():
            look = of_arithmetic(arithmetic)
            worst = {value: max(mine, key=wrong_share) for value, mine in lines.items()}
            panel.series.append(
                Series(
                    f"{arithmetic}",
                    list(worst),
                    [100 * wrong_share(line) for line in worst.values()],
                    look,
                    hover=[_bite(arithmetic, line) for line in worst.values()],
                    chains=[report.chain(run, line["scene"], command=_verify(line)) for line in worst.values()],
                )
            )
            wrong = [value for value, line in worst.items() if wrong_share(line)]
            if wrong:
                begins.setdefault(arithmetic, []).append(
                    f"{min(wrong):.2g} radii from the origin on" if scene == "far"
                    else f"for contacts with a margin of {max(wrong):.2g} and less"
                )
            bounds = {
                value: max(
                    (x for x in (line.get("worst_shortfall", 0) for line in mine) if isinstance(x, (int, float))),
                    default=0,
                )
                for value, mine in lines.items()
            }
            bounds = {value: size for value, size in bounds.items() if size > 0}
            if bounds:
                short.series.append(
                    Series(
                        arithmetic,
                        list(bounds),
                        list(bounds.values()),
                        look,
                        hover=[f"<b>{arithmetic}</b><br>a bound falls short by {size:.1e} of its radius" for size in bounds.values()],
                    )
                )
        panels += [panel] + ([short] if short.series else [])
    if not panels:
        return None
    message = "; ".join(
        f"{arithmetic} arithmetic gets pairs wrong {words.listed(where)}" for arithmetic, where in begins.items()
    )
    exact = [name for name in ("robust", "double") if name in swept and name not in begins]
    return Figure(
        f"arithmetic{report.key(run)}",
        (message[0].upper() + message[1:] + (f"; {words.listed(exact)} none" if exact else "") if message else "No arithmetic gets a pair wrong here"),
        (
            "The error of the arithmetic where it starts: a tangle moved away from the origin, whose stored"
            " coordinates become coarse, and a spring all of whose contacts are equally near to touching. Of each"
            " arithmetic the worst of its variants at each setting; scenes of the stability matrix."
        ),
        panels,
    )


def _bite(arithmetic, line):
    return (
        f"<b>{arithmetic}</b>: {line['variant']}<br>{line['scene']}<br>{line.get('missing', 0)} missing,"
        f" {line.get('invented', 0)} invented of {line['exact_pairs']} pairs<br>worst margin"
        f" {words.number(line.get('worst_margin', 0))}"
    )


def _verify(line):
    return f"catena verify {shlex.quote(line['scene'])} --variant {shlex.quote(line['variant'])}"
