"""What a figure says, without how it is drawn: drawn.static (matplotlib) and drawn.interactive (plotly)
both read this.
"""
import dataclasses

from .style import Look


@dataclasses.dataclass
class Axis:
    title: str
    log: bool = False
    categories: list = None  # names at 0, 1, 2, ...; the first is on top of a y axis
    range: tuple = None


@dataclasses.dataclass
class Series:
    """Points, joined by a line when `line`. `low` and `high` are the ends of an interval on y, or on x with
    `across`.
    """

    name: str
    x: list
    y: list
    look: Look
    line: bool = True
    markers: bool = True
    low: list = None
    high: list = None
    across: bool = False
    hover: list = None  # a line of text for each point
    chains: list = None  # {input, frame, command} for each point: what a click shows
    shown: bool = True  # drawn at first; the legend draws it later
    legend: bool = True
    size: float = 1.0
    width: float = 1.0
    labels: list = None  # a word written beside each point


@dataclasses.dataclass
class Heat:
    """Cells over categorical axes: value[row][column] is an index of `categories`, None is an empty cell."""

    value: list
    categories: list  # (label, colour name)
    hover: list
    chains: list = None


@dataclasses.dataclass
class Line:
    """A straight mark: x = at, y = at (`across`), or with `to` the band between them."""

    at: float
    across: bool = False
    to: float = None
    label: str = ""


@dataclasses.dataclass
class Panel:
    title: str
    x: Axis
    y: Axis
    series: list = dataclasses.field(default_factory=list)
    heat: Heat = None
    lines: list = dataclasses.field(default_factory=list)
    height: int = 300  # CSS pixels
    least: int = 0  # CSS pixels across, below which it scrolls


@dataclasses.dataclass
class Figure:
    """`title` says the message, `caption` how to read it."""

    key: str
    title: str
    caption: str
    panels: list
    columns: int = 2  # panels side by side where there is room

    def legend(self):
        """name -> (look, shown) of every series that the legend names, once, in order."""
        found = {}
        for panel in self.panels:
            for series in panel.series:
                if series.legend:
                    look, shown = found.get(series.name, (series.look, False))
                    found[series.name] = (
                        look if series.markers else dataclasses.replace(look, marker="")
                    ), shown or series.shown
        return found

    def alternative(self):
        """The figure in words, for readers who do not see it: of each panel what the axes are and where each curve
        that is shown begins and ends; of a map how many cells are what.
        """
        return " ".join(filter(None, map(_in_words, self.panels)))

    def categories(self):
        """(label, colour name) of the heat maps that occur, once, in order."""
        return list(
            dict.fromkeys(entry for panel in self.panels if panel.heat for entry in panel.heat.categories)
        )


TOLD = 8  # curves of a panel that its text tells


def _in_words(panel):
    if panel.heat:
        cells = [value for row in panel.heat.value for value in row if value is not None]
        parts = [
            f"{cells.count(at):,} {label}" for at, (label, _) in enumerate(panel.heat.categories) if at in cells
        ]
        return f"{panel.title or 'Map'}: of {len(cells):,} cells {'; '.join(parts)}."
    told = [series for series in panel.series if series.shown and len(series.x) and series.markers | series.line]
    if not told:
        return ""
    more = len(told) - TOLD
    return (
        f"{panel.title or 'Plot'}: {panel.y.title or 'rows'} over {panel.x.title}. "
        + "; ".join(_curve(panel, series) for series in told[:TOLD])
        + (f"; and {more} more." if more > 0 else ".")
    )


def _curve(panel, series):
    def place(at):
        names = panel.y.categories
        if names:
            return f"{series.x[at]:.3g}"
        x = panel.x.categories[round(series.x[at])] if panel.x.categories else f"{series.x[at]:.4g}"
        return f"{series.y[at]:.3g} at {x}"

    if len(series.x) == 1 or panel.y.categories and len(series.x) > 2:
        return f"{series.name} {', '.join(place(at) for at in range(len(series.x)))}"
    return f"{series.name} from {place(0)} to {place(-1)}"
