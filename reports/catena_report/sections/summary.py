"""The page in plain words: what was compared, who wins where, what was wrong. Every sentence is made from
the data.
"""
import html

from .. import claims as paper_claims
from .. import runfile, words
from ..section import Prose, Section
from . import advice, claims, ranks, stability


def build(report):
    section = Section("summary", "In short")
    points = [text for run in report.runs for text in _compared(report, run)]
    for run in report.runs:
        on = f" on {html.escape(report.label(run))}" if len(report.runs) > 1 else ""
        points += [text for make in (_winners, _ranked, _wrong, _stable) for text in make(run, on)]
    points += _claims(report)
    section.blocks = [Prose("", points)]
    return section


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
        f"<strong>Compared</strong> on {html.escape(report.label(run))}:"
        f" {words.plural(len(variants), 'variant')} on"
        f" {words.plural(len(scenes), 'scene')} ({html.escape(words.listed(scenes, 6))}) of {span};"
        f" {repetitions:,} timed samples{took}."
    ]


def _winners(run, on):
    cases = advice._one_off(run)
    if not cases:
        return []
    wins = advice.leaders(cases)
    return [
        f"<strong>Fastest</strong>{on}, from chain to collisions: "
        + words.listed(
            (
                f"{html.escape(name)} on {number} of {words.plural(len(cases), 'chain')} (significantly on"
                f" {alone})"
                for name, (number, alone) in wins.items()
            ),
            4,
        )
        + "."
    ]


def _ranked(run, on):
    found = ranks.ranks(run)
    if not found:
        return []
    result = found[0]
    names = sorted(result.mean, key=result.mean.get)
    near = [name for name in names[1:] if result.mean[name] - result.mean[names[0]] <= result.difference]
    return [
        f"<strong>Over all chains</strong>{on} {html.escape(names[0])} ranks best"
        f" ({result.mean[names[0]]:.2f} of {len(names)})"
        + (
            f"; {html.escape(words.listed(near, 3))} cannot be told from it at 5 %."
            if near
            else ", significantly before all others."
        )
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
            f"<strong>Wrong answers while timed</strong>{on}: {html.escape(words.listed(names, 5))}, on "
            f"{html.escape(words.listed(sorted({case[0] for case in wrong}), 5))}."
        )
    elif any("missing" in counters for counters in run.counters.values()):
        points.append(
            f"<strong>No wrong answer</strong>{on} among what was timed: each was compared with the exact"
            " reference first."
        )
    if run.refused:
        reason = next(iter(run.refused.values()))
        points.append(
            f"<strong>Refused</strong>{on}: {words.plural(len(run.refused), 'measurement')} of "
            f"{html.escape(words.listed(sorted({run.info(case[1]).label for case in run.refused}), 4))} (“{html.escape(reason)}”)."
        )
    return points


def _stable(run, on):
    counted = stability.tally(run)
    if not counted:
        return []
    parts = []
    for name, outcomes in counted.items():
        bad = outcomes.get("wrong", 0) + outcomes.get("not finite", 0)
        tried = sum(outcomes.values()) - outcomes.get("refused", 0)
        parts.append(f"{html.escape(name)} wrong or not finite in {bad:,} of {tried:,}")
    return [f"<strong>On stiff and extreme scenes</strong>{on}: {words.listed(parts)} cases."]


def _claims(report):
    """Each claim once: where runs differ, neither verdict alone would be true."""
    titles = {
        (True, False): "Claims of the paper that hold",
        (True, True): "Claims that hold in one run and not in another",
        (False, True): "Claims that do not hold",
    }
    points = {key: [] for key in titles}
    for claim, judged in claims.verdicts(report):
        found = {verdict.verdict for verdict in judged.values()}
        key = paper_claims.HOLDS in found, paper_claims.FAILS in found
        if key in points:
            points[key].append(claim.text.rstrip("."))
    return [
        f"<strong>{titles[key]}</strong>: {html.escape('; '.join(texts))}."
        for key, texts in points.items()
        if texts
    ]
