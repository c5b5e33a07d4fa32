"""What a run file is held to before anything is computed from it. What else is wrong with the data of one section is
told by the name of that section.
"""
import json
import math

from . import views

# The arrays of `catena`, and what each row of theirs names in words.
ARRAYS = {
    "scenes": ("input",),
    "counts": ("input", "variant"),
    "wants": ("input", "variant"),
    "savings": ("input",),
    "regret": ("input",),
    "animation": ("input", "variant"),
    "coherence": ("input", "variant"),
    "stability": ("scene", "variant"),
    "tube_errors": (),
    "examine": (),
    "motion": ("variant",),
    "keyframes": ("input",),
    "memory": ("input", "variant"),
    "steps": ("input", "variant"),
    "viewer": ("input",),
}
FACTS = ("cpu", "gpu", "host_name", "date", "commit")  # of the context, by which a run is named
OBJECTS = ("stopping", "work_precision", "pivots", "ranks", "bandwidth")
NUMBERS = {"counts": ("pair_tests", "node_visits", "bytes")}  # that a row may have
OF_A_SAMPLE = ("transfer_ms", "least_ms", "pairs", "missing", "invented")  # 0 or more
KERNELS = ("load_one_ms", "load_all_ms")  # more than 0
# What Python's reader takes for numbers. One object each: two readings of a file are equal.
CONSTANTS = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
# What data of another kind than reports/run_file.md says makes of a computation.
UNEXPECTED = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)


class BadRunFile(Exception):
    """One line: what is wrong, where, and what to do."""


def unusable(where, what, error):
    """A BadRunFile of data that one of UNEXPECTED came of."""
    reason = " ".join(f"{type(error).__name__}: {error}".split())
    return BadRunFile(f"{where}: {what} ({reason}); compare its data with reports/run_file.md")


def whole(where, raw):
    """The parts of a run are of the right kind."""
    if (
        not isinstance(raw, dict)
        or not isinstance(raw.get("context"), dict)
        or not isinstance(raw.get("benchmarks"), list)
    ):
        raise BadRunFile(
            f"{where}: no context and benchmarks; give a file that catena report or catena_bench wrote"
        )
    if not all(isinstance(row, dict) for row in raw["benchmarks"]):
        raise BadRunFile(
            f"{where}: benchmarks holds something else than objects; give a file that catena report wrote"
        )
    for fact in FACTS:
        if not isinstance(raw["context"].get(fact), (str, type(None))):
            raise BadRunFile(f"{where}: context.{fact} is not a text; give a file that catena report wrote")
    catena = raw.get("catena", {})
    if not isinstance(catena, dict):
        raise BadRunFile(f"{where}: catena is not an object; see reports/run_file.md")
    if type(catena.get("schema", 1)) is not int or catena.get("schema", 1) != 1:
        raise BadRunFile(
            f"{where}: schema {json.dumps(catena['schema'])}, this report reads 1; use the catena that wrote the file"
        )
    for key in ARRAYS:
        _array(where, key, catena.get(key))
    for key in OBJECTS:
        if not isinstance(catena.get(key), (dict, type(None))):
            raise BadRunFile(f"{where}: catena.{key} is not an object; see reports/run_file.md")
    for at, view in enumerate(catena.get("viewer") or []):
        if wrong := views.fault(view):
            raise BadRunFile(f"{where}: catena.viewer[{at}].{wrong}; see reports/run_file.md")


def _array(where, key, rows):
    if not isinstance([] if rows is None else rows, list):
        raise BadRunFile(f"{where}: catena.{key} is not an array; see reports/run_file.md")
    if not all(isinstance(row, dict) for row in rows or []):
        raise BadRunFile(f"{where}: catena.{key} holds something else than objects; see reports/run_file.md")
    for at, row in enumerate(rows or []):
        for name in ARRAYS[key]:
            if not isinstance(row.get(name), str):
                raise BadRunFile(f"{where}: catena.{key}[{at}] has no {name}; see reports/run_file.md")
        for name in NUMBERS.get(key, ()):
            if not _number(row.get(name, 0)):
                raise BadRunFile(f"{where}: catena.{key}[{at}].{name} is not a number; see reports/run_file.md")


def drawable(where, inputs):
    """What is said of a sphere, and logarithms, need chains that have some."""
    for name in inputs:
        if int(name.rpartition(":")[2]) == 0:
            raise BadRunFile(f"{where}: {name} is a chain without spheres, of which there is no page; measure a longer one")


def sample(where, row):
    """What a sample says beside its time are numbers."""
    for key in OF_A_SAMPLE:
        if not (_number(row.get(key, 0)) and row.get(key, 0) >= 0):
            raise BadRunFile(f"{where} has {key} {json.dumps(row[key])}; measure again with catena report")
    for key in KERNELS:
        if not (_number(row.get(key, 1)) and row.get(key, 1) > 0):
            raise BadRunFile(f"{where} has {key} {json.dumps(row[key])}; measure again with catena report")


def finite(where, raw):
    """Every number is one, but for those in rows that Google Benchmark computed from others: it writes NaN there."""
    for key, value in raw.items():
        if key != "benchmarks":
            _finite(f"{where}: {key}", value)
    for at, row in enumerate(raw["benchmarks"]):
        if row.get("run_type", "iteration") == "iteration":
            _finite(f"{where}: benchmarks[{at}]", row)


def _finite(where, value):
    if isinstance(value, float) and not math.isfinite(value):
        raise BadRunFile(f"{where} is {value}, which is no number of JSON's; measure again with catena report")
    if isinstance(value, dict):
        for key, inner in value.items():
            _finite(f"{where}.{key}", inner)
    if isinstance(value, list):
        for at, inner in enumerate(value):
            _finite(f"{where}[{at}]", inner)


def _number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
