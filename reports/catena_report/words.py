"""Numbers and lists as the page writes them."""
import math


def ms(value):
    """A time in milliseconds, three significant digits: 0.0123, 4.56, 789."""
    return significant(value, 3)


def duration(value):
    """A time of so many milliseconds in the unit that suits it."""
    scale, unit = _unit(value)
    return f"{significant(value * scale, 3)} {unit}"


def duration_interval(estimate):
    """95.0 [90.1, 150.2] ms: a time of so many milliseconds with its interval, in the digits and the unit that suit it."""
    scale, unit = _unit(estimate.value)
    value = estimate.value * scale
    places = max(0, 2 - math.floor(math.log10(value))) if value > 0 else 0
    value, low, high = (f"{end * scale:,.{places}f}" for end in (estimate.value, estimate.low, estimate.high))
    return f"{value} [{low}, {high}] {unit}"


def _unit(ms):
    """(how many of it a millisecond has, its name)."""
    return (1e-3, "s") if ms >= 1000 else (1, "ms") if ms >= 0.1 else (1e3, "µs")


def significant(value, digits):
    if value is None:
        return ""
    if value == 0 or not math.isfinite(value):
        return f"{value:g}"
    places = digits - 1 - math.floor(math.log10(abs(value)))
    return f"{value:,.{max(places, 0)}f}" if -6 < places < 12 else f"{value:.{digits - 1}e}"


def count(value):
    return f"{value:,.0f}"


def number(value):
    """Three digits; what JSON cannot hold (inf, nan) is a word in the run file and stays one."""
    return f"{value:.3g}" if isinstance(value, (int, float)) else str(value)


def plural(number, noun):
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def listed(items, most=None):
    """a, b and c; past `most` names: a, b and 7 more."""
    items = list(items)
    if most and len(items) > most:
        items = items[:most] + [f"{len(items) - most} more"]
    return items[0] if len(items) == 1 else ", ".join(items[:-1]) + " and " + items[-1] if items else "none"


def apart(items, most):
    """a; b; and 7 more: of items that hold commas themselves."""
    items = list(items)
    return "; ".join(items if len(items) <= most else [*items[:most], f"and {len(items) - most} more"])


def percent(number, of, places=1):
    """number / of in per cent: 100 only of all, and 0 only of none."""
    text, least = f"{100 * number / of:.{places}f}", 10.0**-places
    if number < of and float(text) == 100:
        text = f"> {100 - least:.{places}f}"
    if number > 0 and float(text.removeprefix("> ")) == 0:
        text = f"< {least:.{places}f}"
    return text + " %"


def interval(estimate, digits=2):
    """1.02 [0.98, 1.06]; past 100, and a ratio below 0.1, in three significant digits. One sample has no interval:
    1.02.
    """
    if estimate.low == estimate.high:
        return significant(estimate.value, 3)
    small = estimate.low > 0 and estimate.value < 0.1
    if not small and max(map(abs, (estimate.low, estimate.high))) < 100:
        return f"{estimate.value:.{digits}f} [{estimate.low:.{digits}f}, {estimate.high:.{digits}f}]"
    return (
        f"{significant(estimate.value, 3)} [{significant(estimate.low, 3)}, {significant(estimate.high, 3)}]"
    )
