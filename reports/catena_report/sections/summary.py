"""The page in plain words: what was compared, who wins where, what was wrong. Every sentence is made from
the data.
"""
import html
import re

from .. import certainty, choice, runfile, spans, waits, words
from .. import claims as paper_claims
from ..section import Prose, Section, link
from . import claims, slowdown, stability
from .advice import summary_table


def build(report):
    section = Section("summary", "In short")
    points = []
    resident = report.best_informed({run: waits.resident(run) for run in report.runs})
    for run in report.runs:
        on = f" on {html.escape(report.label(run))}" if len(report.runs) > 1 else ""
        points += _on_device(run, on, resident[run], report.timed_beside(run, resident))
        points += [text for make in (_overall, _certain, _wrong, _stable) for text in make(run, on)]
    points += _claims(report)
    points += [text for run in report.runs for text in _compared(report, run)]
    section.blocks = [summary_table(report) or Prose(_no_advice(report)), Prose("", points)]
    return section


def _no_advice(report):
    """Why the first table is not there."""
    cases = ((run, row) for run in report.runs for row in waits.end_to_end(run).values())
    timed = {variant for run, row in cases for variant in row if run.info(variant).recommended}
    told = {0: "no exact variant was timed end to end", 1: "one exact variant was timed end to end"}
    what = told.get(len(timed), "no two exact variants were timed end to end on one chain")
    return f"<strong>No advice</strong>: {what}; to choose between them takes two."


def _compared(report, run):
    inputs, variants = run.inputs(), run.variants()
    if not inputs:
        return [f"<strong>{html.escape(report.label(run))}</strong>: no timings."]
    ns = sorted({runfile.n_of(name) for name in inputs})
    scenes = sorted({runfile.scene_of(name) for name in inputs})
    repetitions = sum(len(times) for times in run.samples.values())
    span = (
        f"{words.count(ns[0])} to {words.count(ns[-1])} spheres"
        if len(ns) > 1
        else f"{words.count(ns[0])} spheres"
    )
    took = f", in {words.significant(run.catena['seconds'], 3)} s" if "seconds" in run.catena else ""
    return [
        f"{link('times', 'Compared')} on {html.escape(report.label(run))}:"
        f" {words.plural(len(variants), 'variant')} on"
        f" {words.plural(len(scenes), 'scene')} ({html.escape(words.listed(scenes, 6))}) of {span};"
        f" {repetitions:,} timed samples{took}."
    ]


def _on_device(run, on, cases, timed):
    advices = choice.advise(run, cases)
    if not advices:
        return []
    return [
        f"{link('advice', 'If your chain lives on the device')}{on} and the answer stays there, the times and the"
        " choice are others: "
        + html.escape(
            words.apart(
                (
                    f"{advice.variant} for {spans.in_words(advice.inputs, timed)}, {words.ms(min(advice.times))} ms and more"
                    for advice in advices
                ),
                4,
            )
        )
        + "."
    ]


def _overall(run, on):
    found = slowdown.headline(run)
    if not found:
        return []
    name, slow, near = found
    return [
        f"{link('slowdown', 'Over all chains')}{on} {html.escape(name)} takes {slowdown.mean_text(slow)} times the"
        " fastest of each, end to end"
        + html.escape(slowdown.beside(run, name, near)) + "."
    ]


def _certain(run, on):
    found = certainty.certainty(run)
    if not found:
        few = max((len(times) for times in run.samples.values()), default=0)
        return [
            f"{link('environment', 'How sure')}{on}: at most {words.plural(few, 'sample')} of a case, too few to"
            " tell how often it would raise a false alarm."
        ] if few else []
    half, most = (100 * (factor - 1) for factor in found.smallest)
    return [
        f"{link('environment', 'How sure')}{on}: a slowdown of {words.significant(half, 2)} % would have been seen in"
        f" half of the cases, one of {words.significant(most, 2)} % in nine of ten; of {found.cases:,} cases set against"
        f" themselves {found.false_alarms:,} ({html.escape(words.percent(found.false_alarms, found.cases))}) were called different at"
        " the 5 % level."
    ]


def _wrong(run, on):
    """Variants that gave wrong answers while they were timed, and those refused."""
    wrong = {
        case: counters
        for case, counters in run.counters.items()
        if counters.get("missing") or counters.get("invented")
    }
    points = []
    if wrong:
        names = sorted({run.info(case[1]).label for case in wrong})
        points.append(
            f"{link('stability', 'Wrong answers while timed')}{on}: {html.escape(words.listed(names, 5))}, on "
            f"{html.escape(words.listed(sorted({case[0] for case in wrong}), 5))}."
        )
    elif any("missing" in counters for counters in run.counters.values()):
        points.append(
            f"<strong>No wrong answer</strong>{on} among what was timed: each was compared with the exact"
            " reference first."
        )
    refused = {case: reason for case, reason in run.refused.items() if case not in run.faults}
    for title, cases in (("Failed, by a fault of its own", run.faults), ("Refused", refused)):
        if cases:
            points.append(f"<strong>{title}</strong>{on}: {html.escape(words.apart(_by_reason(run, cases), 3))}.")
    return points


def _by_reason(run, cases):
    """Of those refused for one reason, but for its numbers, how many, who, and the first's reason."""
    found = {}
    for case, reason in cases.items():
        found.setdefault(re.sub(r"\d+", "", reason), []).append((run.info(case[1]).label, reason))
    for several in found.values():
        names = words.listed(sorted({name for name, _ in several}), 4)
        yield f"{words.plural(len(several), 'measurement')} of {names} (“{several[0][1]}”)"


def _stable(run, on):
    answered = {name: lines for name, lines in stability.answers(run).items() if lines}
    if not answered:
        return []
    shares = words.listed(
        html.escape(f"{name} in {words.percent(stability.right(lines), len(lines))} of {len(lines):,}")
        for name, lines in answered.items()
    )
    return [
        f"{link('stability', 'On stiff and extreme scenes')}{on} the pairs are right: {shares} cases."
    ]


def _claims(report):
    """Each claim once: where runs differ, neither verdict alone would be true."""
    titles = {
        (True, False): "Claims of the paper that hold",
        (True, True): "Claims that hold in one run and not in another",
        (False, True): "Claims that do not hold",
    }
    points = {key: [] for key in titles}
    stored, elsewhere = claims.stored_verdicts(report), []
    for claim, judged in claims.verdicts(report):
        found = {verdict.verdict for verdict in judged.values()}
        key = paper_claims.HOLDS in found, paper_claims.FAILS in found
        if key in points:
            points[key].append(claim.text.rstrip("."))
        elif claim.key in stored:
            elsewhere.append(stored[claim.key].verdict == paper_claims.HOLDS)
    told = [
        f"{link('claims', 'Not testable here')}: {words.plural(len(elsewhere), 'claim')} that the committed run of a"
        f" GPU decides; {sum(elsewhere)} of them hold there."
    ] if elsewhere else []
    return told + [
        f"{link('claims', titles[key])}: {html.escape('; '.join(texts))}."
        for key, texts in points.items()
        if texts
    ]
