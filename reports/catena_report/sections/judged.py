"""What others published, or a formula knows, against what catena finds."""
from .. import words
from ..section import Section
from ..table import Cell, Table


def build(report):
    section = Section("judged", "Judged from outside")
    for run in report.having("judged"):
        section.blocks += report.heading(run) + [_table(report, run, run.list("judged"))]
    return section if section.blocks else None


def _table(report, run, rows):
    told = [row for row in rows if not row.get("open")]
    differ = [row for row in told if not row["agrees"]]
    title = (
        f"{words.plural(len(differ), 'number')} of {len(told)} {'differs' if len(differ) == 1 else 'differ'} from what is"
        " published"
        if differ
        else f"All {words.plural(len(told), 'number')} agree with what is published"
    )
    if len(told) < len(rows):
        title += f"; the interval of {words.plural(len(rows) - len(told), 'other')} is too wide to tell"
    return Table(
        f"judged{report.key(run)}",
        title,
        (
            "No number at the left was computed by catena, and no reference of its own is asked. A growth agrees"
            " where its interval of 95 % does not lie above the law's exponent, an exponent where its interval holds"
            " the published one. Beside the power of a growth a share that falls as n^(-1/3), that of a ball's surface,"
            " is fitted; what the plain power would be, and how many a sphere there were at last, is told after it."
            " A ropelength is a length over the radius at which spheres about the vertices first touch; it agrees where"
            " the edges between these explain the difference."
            " The command asks again."
        ),
        ["source", "what", "command", "published", "found"],
        [
            [
                row["source"],
                row["what"],
                row["command"],
                row["published"],
                Cell(row["found"], kind="open" if row.get("open") else "good" if row["agrees"] else "bad"),
            ]
            for row in rows
        ],
        words=5,
    )
