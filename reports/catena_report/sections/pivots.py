"""Pivots of a self-avoiding walk: what an attempt costs, and k of them together beside a rebuild."""
import html
import itertools

from .. import words
from ..section import Prose, Section
from ..table import Cell, Table


def build(report):
    section = Section("pivots", "Pivots: one question, millions of times")
    for run in report.having("pivots"):
        found = run.catena["pivots"]
        section.blocks += report.heading(run) + [_speed(found["speed"]), _table(report, run, found)]
    return section if section.blocks else None


def _speed(speed):
    return Prose(
        f"Does a walk of {words.count(speed['n'])} points on the cubic lattice stay self-avoiding when one half is"
        f" turned? {words.significant(speed['us_per_attempt'], 3)} µs an attempt on one core, and"
        f" {words.significant(speed['bytes_per_point'], 3)} bytes a point; {speed['acceptance']:.3f} of"
        f" {words.count(speed['attempts'])} attempts were accepted. Published:"
        f" {words.significant(speed['published_us'], 3)} µs ({html.escape(speed['published_by'])})."
        f" <code>catena pivot --n {speed['n']} --warm-up {speed['warm_up']} --moves {speed['attempts']}</code>"
    )


def _cheap(rows):
    """Up to how many at once cost less than a rebuild, by the points of the walk; one is not several."""
    if all(row["times"] > 1 for row in rows):
        return "cost less than a rebuild"
    upto, never = [], []
    for n in sorted({row["n"] for row in rows}):
        mine = sorted((row["pivots"], row["times"]) for row in rows if row["n"] == n)
        cheap = [k for k, _ in itertools.takewhile(lambda row: row[1] > 1, mine)]
        if cheap and cheap[-1] > 1:
            upto.append(f"{words.count(cheap[-1])} of {words.count(n)} points")
        else:
            never.append(words.count(n))
    if not upto:
        return "cost no less than a rebuild"
    return f"cost less than a rebuild up to {words.listed(upto)}" + (f", and no less of {words.listed(never)} points" if never else "")


def _table(report, run, found):
    rows = found["at_once"]
    wrong = sum(not row["agree"] for row in rows)
    title = "Several pivots at once " + _cheap(rows)
    if wrong:
        title += f"; {words.plural(wrong, 'answer')} DIFFER"
    return Table(
        f"pivots{report.key(run)}",
        title,
        (
            f"Random pivots about as many points, made together; {found['rebuilt']} finds whether the walk's spheres"
            " collide after all its points were turned one after the other. Both answers were compared. Accepted is the"
            " share of attempts that keep the walk self-avoiding: what is refused ends at the first collision. Lotan,"
            " Schwarzer, Halperin and Latombe (2004) had ten times at 755 residues."
        ),
        ["points", "pivots at once", "µs", "accepted", f"{found['rebuilt']}, µs", "times as much"],
        [
            [
                Cell(words.count(row["n"]), row["n"]),
                Cell(words.count(row["pivots"]), row["pivots"]),
                Cell(words.significant(row["us_per_attempt"], 3), row["us_per_attempt"]),
                f"{row['acceptance']:.4f}",
                Cell(words.significant(row["rebuild_us"], 3), row["rebuild_us"]),
                Cell(words.significant(row["times"], 3), row["times"]),
            ]
            for row in rows
        ],
    )
