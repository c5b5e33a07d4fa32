"""Every claim of the paper with its measured verdict."""
from .. import claims, words
from ..section import Prose, Section
from ..table import Cell, Table

ORDER = [claims.FAILS, claims.HOLDS, claims.UNTESTED]
KINDS = {claims.HOLDS: "good", claims.FAILS: "bad", claims.UNTESTED: "open"}


def verdicts(report):
    """[(claim, {run: verdict})]"""
    return [(claim, {run: claim.judge(run) for run in report.runs}) for claim in claims.CLAIMS]


def build(report):
    rows, tally = [], {}
    for claim, judged in verdicts(report):
        decided = {run: verdict for run, verdict in judged.items() if verdict.verdict != claims.UNTESTED}
        for run, verdict in (decided or dict([next(iter(judged.items()))])).items():
            tally[verdict.verdict] = tally.get(verdict.verdict, 0) + 1
            row = [
                Cell(claim.text),
                Cell(claim.where),
                Cell(verdict.verdict, kind=KINDS[verdict.verdict], hint=claim.rule),
                Cell(verdict.evidence),
            ]
            rows.append(
                row[:2] + [Cell(report.label(run) if decided else "")] + row[2:]
                if len(report.runs) > 1
                else row
            )
    rows.sort(key=lambda row: ORDER.index(row[-2].text))
    if set(tally) == {claims.UNTESTED}:
        return None
    columns = ["claim", "where", *(["run"] if len(report.runs) > 1 else []), "verdict", "what was measured"]
    section = Section("claims", "The paper's claims, tested")
    section.blocks = [
        Prose(
            "Each verdict follows from the samples by a rule fixed beforehand; the rule is the hint of the"
            f" verdict and is listed below the table. Of {words.plural(sum(tally.values()), 'verdict')}, "
            + words.listed(
                f"{number} {'say' if number > 1 else 'says'} “{verdict}”" for verdict, number in tally.items()
            )
            + "."
        ),
        Table(
            "claims",
            "Claims of the paper with measured verdicts",
            (
                "A run appears where it can decide the claim; a claim that no run can decide is listed once"
                " with the reason."
            ),
            columns,
            rows,
            words=len(columns),
        ),
        Prose(
            "The rules of the verdicts",
            [f"<strong>{claim.text}</strong> {claim.rule}" for claim in claims.CLAIMS],
            folded=True,
        ),
    ]
    return section
