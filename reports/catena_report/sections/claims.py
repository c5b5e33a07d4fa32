"""Every claim of the paper with its measured verdict."""
import html

from .. import claims, committed, words
from ..section import Prose, Section
from ..table import Cell, Table

ORDER = [claims.FAILS, claims.HOLDS]
KINDS = {claims.HOLDS: "good", claims.FAILS: "bad"}


def verdicts(report):
    """[(claim, {run: verdict})]"""
    return [(claim, {run: claim.judge(run) for run in report.runs}) for claim in claims.CLAIMS]


def stored_verdicts(report):
    """claim key -> Verdict of the committed runs of another device; {} where they are not shown."""
    stored = committed.beside(report.runs)
    if not stored:
        return {}
    return {
        key: claims.Verdict(row["verdict"], row["evidence"]) for key, row in stored["claims"].items()
    }


def build(report):
    rows, open_, tally = [], [], {}
    stored = stored_verdicts(report)
    for claim, judged in verdicts(report):
        decided = [(report.label(run), v, "") for run, v in judged.items() if v.verdict != claims.UNTESTED]
        for _, verdict, _ in decided:
            tally[verdict.verdict] = tally.get(verdict.verdict, 0) + 1
        if not decided:
            open_.append((claim, next(iter(judged.values())).evidence, claim.key in stored))
        if claim.key in stored:
            decided.append((_committed_label(), stored[claim.key], "committed"))
        rows += [_row(claim, *one) for one in decided]
    if not rows:
        return None
    rows.sort(key=lambda row: (row[2].kind == "committed", ORDER.index(row[3].text)))
    columns = ["claim", "where", "run", "verdict", "what was measured"]
    several = len({row[2].text for row in rows}) > 1 or not tally  # committed rows are never without their mark
    if not several:
        columns, rows = columns[:2] + columns[3:], [row[:2] + row[3:] for row in rows]
    section = Section("claims", "The paper's claims, tested")
    section.blocks = [
        Prose(
            "Each verdict follows from the samples by a rule fixed beforehand; the rule is the hint of the"
            " verdict and is listed below the table. " + _tally(tally, stored)
            + (
                f" Rows marked <strong>committed</strong> are verdicts of {html.escape(_committed_label())}, stored"
                " with the program: not measured here."
                if stored
                else ""
            )
        ),
        Table(
            "claims",
            "Claims of the paper with measured verdicts",
            "A run appears where it can decide the claim.",
            columns,
            rows,
            words=len(columns),
        ),
        *([_open(open_)] if open_ else []),
        Prose(
            "The rules of the verdicts",
            [f"<strong>{claim.text}</strong> {claim.rule}" for claim in claims.CLAIMS],
            folded=True,
        ),
    ]
    return section


def _tally(tally, stored):
    if not tally:
        return "No run of this page can test any."
    return (
        f"Of {words.plural(sum(tally.values()), 'verdict')}{' of this page’s runs' if stored else ''}, "
        + words.listed(f"{number} {'say' if number > 1 else 'says'} “{verdict}”" for verdict, number in tally.items())
        + "."
    )


def _row(claim, label, verdict, kind):
    return [
        Cell(claim.text),
        Cell(claim.where),
        Cell(label, kind=kind),
        Cell(verdict.verdict, kind=KINDS[verdict.verdict], hint=claim.rule),
        Cell(verdict.evidence),
    ]


def _committed_label():
    stored = committed.beside([])
    return f"{stored['device']}, committed {stored['date']}"


def _open(rows):
    """One line that opens: what no run of the page decides, and why."""
    return Prose(
        f"{words.plural(len(rows), 'claim')} that no run of this page can test, with the reason",
        [
            f"<strong>{html.escape(claim.text)}</strong> {html.escape(reason)}"
            + (" (decided by the committed run, above)." if there else ".")
            for claim, reason, there in rows
        ],
        folded=True,
    )
