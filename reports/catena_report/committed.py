"""The verdicts of the runs in reports/results, which the package carries so that a page of a machine without such
a device shows them beside its own. A test makes them again from those runs; CATENA_WRITE_GOLDEN=1 stores them.
"""
import json
import pathlib

from . import claims

PATH = pathlib.Path(__file__).parent / "committed_verdicts.json"


def verdicts_of(runs):
    """What the file holds: whose verdicts, and of each claim that a run decides {run, verdict, evidence} of the
    first run that does: give the one with the longest chains first.
    """
    first = runs[0].context
    return {
        "device": runs[0].device,
        "commit": first.get("commit", ""),
        "date": first.get("date", "")[:10],
        "claims": {
            claim.key: decided
            for claim in claims.CLAIMS
            if (decided := next(filter(None, (_decided(claim, run) for run in runs)), None))
        },
    }


def _decided(claim, run):
    verdict = claim.judge(run)
    if verdict.verdict == claims.UNTESTED:
        return None
    return {"run": run.path.name, "verdict": verdict.verdict, "evidence": verdict.evidence}


def beside(runs):
    """The committed verdicts, for a page of these runs; None where one of them is of that device itself."""
    stored = json.loads(PATH.read_text(encoding="utf-8"))
    return None if any(run.device == stored["device"] for run in runs) else stored
