"""The environment of every run: what the figures depend on."""
import html

from .. import certainty, words
from ..section import Prose, Section
from ..table import Cell, Table

SHOWN_FIRST = (
    "commit",
    "cpu",
    "num_cpus",
    "mhz_per_cpu",
    "caches",
    "governor",
    "gpu",
    "gpu unavailable",
    "gpu memory",
    "gpu driver",
    "gpu driver supports",
    "cuda toolkit",
    "compiler",
    "flags",
    "build type",
    "device cache",
    "date",
    "load_avg",
)
UNLIMITED = 1e9  # seconds of a timing that ends by its repetitions alone, as in reports/run_file.h
# library_build_type is Google Benchmark's own, and "debug" of Debian's would be taken for catena's.
SILENT = ("executable", "json_schema_version", "cores", "host_name", "library_build_type")


def build(report):
    keys = [key for key in SHOWN_FIRST if any(key in run.context for run in report.runs)]
    keys += sorted({key for run in report.runs for key in run.context} - set(keys) - set(SILENT))
    rows = [
        [key] + [_cell(key, run.context.get(key)) for run in report.runs] for key in keys if key not in SILENT
    ]
    for key, name in (("profile", "profile"), ("seconds", "measuring took, s")):
        if any(key in run.catena for run in report.runs):
            rows.append([name] + [Cell(_text(key, run.catena.get(key, ""))) for run in report.runs])
    blocks = [
        Table(
            "environment",
            "Environment of every run",
            "As each run recorded it of itself.",
            ["", *report.labels],
            rows,
            words=1 + len(report.runs),
        )
    ]
    stopping = [Prose(_stopping(report, run)) for run in report.having("stopping")]
    stopping += [Prose(text) for run in report.runs if (text := _certain(report, run))]
    stopping += [
        Prose(f"<strong>{html.escape(report.label(run))}</strong>, taken out: {html.escape(why)}.")
        for run in report.runs
        for why in run.catena.get("removed") or []
    ]
    scenes = [_scenes(report, run) for run in report.having("scenes")]
    return Section("environment", "Environment", blocks + stopping + scenes)


def _certain(report, run):
    """How far this run's samples can be trusted, and how that was found; empty where there are too few."""
    found = certainty.certainty(run)
    if not found:
        return ""
    half, most = (100 * (factor - 1) for factor in found.smallest)
    return (
        f"<strong>{html.escape(report.label(run))}, against itself</strong>: the samples of each of {found.cases:,}"
        f" cases ({certainty.FEWEST} or more of each; {found.of:,} were timed) were split into even and odd rounds;"
        f" the Mann-Whitney test at 5 % calls {found.false_alarms:,} of them"
        f" ({html.escape(words.percent(found.false_alarms, found.cases))}) different, which none is. The smallest slowdown that"
        f" such a run would see in {certainty.SURE:.0%} of attempts, by drawing both sides from the samples of the"
        f" case: {words.significant(half, 2)} % or less in half of the cases, {words.significant(most, 2)} % or less"
        " in nine of ten. What changes from one process to the next is in neither number."
    )


def _stopping(report, run):
    """When the measuring of a run ended, and what it reached."""
    stopping = run.catena["stopping"]
    missed = stopping.get("not_reached") or []
    if not stopping["share"]:  # asked for so many samples, however wide
        return (
            f"<strong>{html.escape(report.label(run))}</strong>: cases interleaved at random (seed"
            f" {stopping['seed']}), each measured {words.plural(stopping['most_samples'], 'time')}"
            + (f" where {stopping['seconds']:g} s in all sufficed" if stopping["seconds"] < UNLIMITED else "")
            + (f"; {len(missed):,} were not reached" if missed else "")
            + f". Intervals are {html.escape(stopping['interval'])}."
        )
    return (
        f"<strong>{html.escape(report.label(run))}</strong>: cases interleaved at random (seed"
        f" {stopping['seed']}), each repeated until its interval ({html.escape(stopping['interval'])}) was"
        f" within {100 * stopping['share']:g} % of the median, at most"
        f" {words.plural(stopping['most_samples'], 'time')} and {stopping['seconds']:g} s in all."
        f" {stopping['narrow']:,} of {words.plural(stopping['cases'], 'case')} became that"
        f" narrow{f', {len(missed):,} were not reached' if missed else ''}: the others are shown with the"
        " wider interval that they have."
    )


def _cell(key, value):
    text = _text(key, value)
    return Cell(
        text,
        kind="bad" if text == "DEBUG" or (key == "commit" and text.endswith(("-dirty", "+"))) else "",
        hint="built with uncommitted changes" if key == "commit" and text.endswith(("-dirty", "+")) else "",
    )


def _text(key, value):
    if value is None:
        return ""
    if key == "caches":
        return ", ".join(f"L{c['level']} {c['type'].lower()} {_size(c['size'])}" for c in value)
    if key == "load_avg":
        return ", ".join(f"{load:.1f}" for load in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return words.significant(value, 4)
    return str(value).strip()


def _size(size):
    return f"{size / 2**20:g} MiB" if size >= 2**20 else f"{size / 2**10:g} KiB"


def _scenes(report, run):
    boxes = any("box" in row for row in run.list("scenes"))
    rows = [
        [
            row["input"],
            row.get("summary", ""),
            row.get("hash", ""),
            *([row.get("box", "")] if boxes else []),
            Cell(words.count(row["n"]), row["n"]),
            _number(row, "frame"),
            _number(row, "frames"),
            _number(row, "pairs"),
            _number(row, "max_count"),
            Cell(f"{row['density']:.3g}", row["density"]) if "density" in row else "",
            (
                Cell(f"{row['smallest_margin']:.2e}", row["smallest_margin"])
                if row.get("smallest_margin") is not None
                else ""
            ),
            *([_number(row, "images")] if boxes else []),
        ]
        for row in run.list("scenes")
    ]
    in_boxes = " The box repeats space; its images are spheres that a build adds at the faces." if boxes else ""
    return Table(
        f"scenes{report.key(run)}",
        "Chains that were run",
        "The hash is that of every sphere's bytes: the same hash, the same chain." + in_boxes,
        [
            "chain",
            "what it is",
            "hash",
            *(["box"] if boxes else []),
            "n",
            "frame",
            "frames",
            "pairs",
            "most a sphere",
            "pairs a sphere",
            "smallest margin",
            *(["images"] if boxes else []),
        ],
        rows,
        words=4 if boxes else 3,
    )


def _number(row, key):
    value = row.get(key)
    if value is None:
        return ""
    return Cell(words.count(value), value) if isinstance(value, (int, float)) else str(value)
