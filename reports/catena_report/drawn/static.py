"""A figure as SVG and PDF, by matplotlib: for print, for papers, and for the page where plotly cannot be."""
import io
import math
import os
import re

os.environ["MPLBACKEND"] = "Agg"  # whatever the caller's says: one that is not here fails the import
import matplotlib

matplotlib.rcdefaults()  # what the user's matplotlibrc says, such as text.usetex, is not of these figures
import matplotlib.figure
import matplotlib.lines
import matplotlib.patches
import matplotlib.ticker
import numpy
from matplotlib.path import Path

from ..style import LIGHT
from .compact import compact

MARKERS = {
    "circle": "o",
    "square": "s",
    "diamond": "D",
    "triangle-up": "^",
    "cross": "P",
    "triangle-down": "v",
    "star": "*",
    "hexagon": "h",
}
LINES = {"solid": "-", "dot": (0, (1, 1.6)), "dash": (0, (4, 2)), "dashdot": (0, (4, 2, 1, 2))}
INCH = 96  # CSS pixels
PANEL = 460  # CSS pixels across
RC = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9,
    "axes.edgecolor": LIGHT["faint"],
    "axes.labelcolor": LIGHT["ink"],
    "axes.titlecolor": LIGHT["ink"],
    "text.color": LIGHT["ink"],
    "xtick.color": LIGHT["muted"],
    "ytick.color": LIGHT["muted"],
    "axes.grid": True,
    "grid.color": LIGHT["grid"],
    "grid.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "axes.linewidth": 0.8,
    "lines.solid_capstyle": "round",
    "legend.fontsize": 8.5,
}


def draw(figure):
    """The matplotlib figure: every series in the state in which the page first shows it."""
    columns = min(figure.columns, len(figure.panels))
    rows = math.ceil(len(figure.panels) / columns)
    entries = [(name, look) for name, (look, shown) in figure.legend().items() if shown]
    entries += [(label, colour) for label, colour in figure.categories()]
    across = PANEL * columns if columns > 1 else 2 * PANEL
    longest = max((len(name) for name, _ in entries), default=1)
    per_row = max(1, min(len(entries), int(across / (longest * 6.2 + 44))))
    legend_height = 18 * math.ceil(len(entries) / per_row) + 14 if len(entries) > 1 else 0
    heights = [
        max(panel.height for panel in figure.panels[row * columns : (row + 1) * columns])
        for row in range(rows)
    ]
    total = sum(heights) + legend_height
    with matplotlib.rc_context(RC):
        canvas = matplotlib.figure.Figure(figsize=(across / INCH, total / INCH), layout="constrained")
        canvas.get_layout_engine().set(rect=(0, 0, 1, 1 - legend_height / total), w_pad=0.08, h_pad=0.08)
        axes = canvas.subplots(rows, columns, squeeze=False, gridspec_kw={"height_ratios": heights}).flat
        for at, (panel, ax) in enumerate(zip(figure.panels, axes)):
            _panel(ax, panel, at)
        for ax in list(canvas.axes)[len(figure.panels) :]:
            ax.remove()
        if legend_height:
            canvas.legend(
                handles=[_handle(*entry) for entry in entries],
                loc="upper left",
                ncols=per_row,
                bbox_to_anchor=(0.005, 1),
                borderaxespad=0.2,
                handlelength=2.2,
                columnspacing=1.4,
            )
        canvas.get_layout_engine().execute(canvas)
        canvas.set_layout_engine("none")  # laid out once for both files
    return canvas


def _style(look, size, width, line=True, markers=True):
    colour = LIGHT[look.colour]
    return {
        "color": colour,
        "linestyle": LINES[look.dash] if line else "none",
        "linewidth": 1.4 * width,
        "marker": MARKERS[look.marker] if markers and look.marker else None,
        "markersize": 4.6 * size,
        "markeredgewidth": 1.1,
        "markeredgecolor": colour,
        "markerfacecolor": LIGHT["paper"] if look.hollow else colour,
    }


def _handle(name, look):
    if isinstance(look, str):
        return matplotlib.patches.Patch(facecolor=LIGHT[look], label=name)
    return matplotlib.lines.Line2D([], [], label=name, **_style(look, 1, 1))


def _panel(ax, panel, at):
    above = panel.heat and any(line.label for line in panel.lines)  # words between the title and the map
    ax.set_title(panel.title, pad=18 if above else None)
    ax.set_xlabel(panel.x.title)
    ax.set_ylabel(panel.y.title)
    for line in panel.lines:
        if panel.heat:
            pass  # a word above the columns that begin there
        elif line.to is not None:
            (ax.axhspan if line.across else ax.axvspan)(line.at, line.to, color=LIGHT["band"], zorder=0)
        else:
            (ax.axhline if line.across else ax.axvline)(
                line.at, color=LIGHT["muted"], linewidth=1, linestyle=(0, (4, 3)), zorder=1
            )
        if line.label and panel.heat:
            ax.annotate(
                line.label,
                (line.at, 1),
                xycoords=ax.get_xaxis_transform(),
                xytext=(0, 4),
                textcoords="offset points",
                fontsize=9,
                fontweight="bold",
            )
        elif line.label:
            where = (0.99, line.at) if line.across else (line.at, 0.99)
            ax.annotate(
                line.label,
                where,
                xycoords=ax.get_yaxis_transform() if line.across else ax.get_xaxis_transform(),
                color=LIGHT["muted"],
                fontsize=8,
                ha="right" if line.across else "left",
                va="bottom" if line.across else "top",
                xytext=(0 if line.across else 4, 2 if line.across else -2),
                textcoords="offset points",
            )
    if panel.heat:
        _heat(ax, panel)
    for number, series in enumerate(panel.series):
        if series.shown:
            _series(ax, series, f"series-{at}-{number}")
    for axis, spec in ((ax.xaxis, panel.x), (ax.yaxis, panel.y)):
        _axis(ax, axis, spec)


def _axis(ax, axis, spec):
    is_y = axis is ax.yaxis
    if spec.log:
        (ax.set_yscale if is_y else ax.set_xscale)("log")
        low, high = sorted(ax.get_ylim() if is_y else ax.get_xlim())
        axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5) if high < 30 * low else (1,)))
        axis.set_minor_locator(matplotlib.ticker.NullLocator())
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(short))
    if spec.categories is not None:
        axis.set_ticks(range(len(spec.categories)), spec.categories)
        axis.set_tick_params(length=0, labelsize=8 if len(spec.categories) < 30 else 6.5)
        if not is_y and max(map(len, spec.categories), default=0) * len(spec.categories) > 50:
            axis.set_tick_params(rotation=90)
        (ax.set_ylim if is_y else ax.set_xlim)(
            *((len(spec.categories) - 0.5, -0.5) if is_y else (-0.5, len(spec.categories) - 0.5))
        )
    if spec.range:
        (ax.set_ylim if is_y else ax.set_xlim)(*spec.range)


def short(value, _=None):
    """10000 as 10 k, as plotly writes it."""
    value = float(f"{value:.6g}")  # a tick at 1e-4 is 9.999999999999999e-05 where pow() rounds so
    for factor, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= factor:
            return f"{value / factor:g}{letter}"
    return f"{value:g}" if value >= 1e-4 else f"1e{math.log10(value):.0f}" if value > 0 else f"{value:g}"


def _series(ax, series, gid):
    style = _style(series.look, series.size, series.width, series.line, series.markers)
    ax.plot(series.x, series.y, gid=gid, zorder=3, **style)
    if series.low is not None:
        centre = series.x if series.across else series.y
        reach = [
            [max(0.0, c - low) for c, low in zip(centre, series.low)],
            [max(0.0, high - c) for c, high in zip(centre, series.high)],
        ]
        bars = ax.errorbar(
            series.x,
            series.y,
            fmt="none",
            ecolor=style["color"],
            elinewidth=1,
            capsize=0,
            alpha=0.6,
            zorder=2,
            **{"xerr" if series.across else "yerr": reach},
        )
        for collection in bars[2]:
            collection.set_gid(gid + "-spread")
    for x, y, label in zip(series.x, series.y, series.labels or []):
        if label:
            ax.annotate(
                label,
                (x, y),
                xytext=(6, 0),
                textcoords="offset points",
                va="center",
                fontsize=8,
                color=LIGHT["muted"],
            )


def _heat(ax, panel):
    """One path for each category, so that a theme can colour it and a large map stays small."""
    for index, (_, colour) in enumerate(panel.heat.categories):
        boxes = [
            [
                (a - 0.47, row - 0.45),
                (b - 0.53, row - 0.45),
                (b - 0.53, row + 0.45),
                (a - 0.47, row + 0.45),
                (0, 0),
            ]
            for row, values in enumerate(panel.heat.value)
            for a, b in _runs(values, index)
        ]
        if boxes:
            vertices = numpy.concatenate(boxes)
            codes = [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY] * len(boxes)
            ax.add_patch(
                matplotlib.patches.PathPatch(Path(vertices, codes), facecolor=LIGHT[colour], linewidth=0)
            )
    ax.grid(False)


def _runs(values, index):
    """(first, behind the last) of every run of `index` in a row."""
    edges = numpy.flatnonzero(
        numpy.diff(numpy.array([value == index for value in values], dtype=int), prepend=0, append=0)
    )
    return zip(edges[::2], edges[1::2])


def svg(canvas, key):
    """SVG text with ids that no other figure of a page has."""
    text = io.StringIO()
    with matplotlib.rc_context({**RC, "svg.hashsalt": key}):
        canvas.savefig(text, format="svg", metadata={"Date": None, "Creator": "catena"})
    body = compact(text.getvalue())
    body = re.sub(r'\bid="', f'id="{key}-', body)
    body = re.sub(r'(xlink:href="#|url\(#)', rf"\g<1>{key}-", body)
    return body.replace("'DejaVu Sans'", "'DejaVu Sans', Verdana, sans-serif")


def on_white(text):
    """The SVG as a file: on white wherever it is shown, as on a dark page of a forge."""
    return text.replace("<svg ", '<svg style="background: #ffffff" ', 1)


def themed(text):
    """The SVG for within a page: colours by name, so that the page's theme sets them."""
    body = text[text.index("<svg") :]
    return re.sub("|".join(map(re.escape, LIGHT.values())), lambda match: f"var(--{NAMES[match[0]]})", body)


NAMES = {value: name for name, value in LIGHT.items()}


def pdf(canvas):
    with matplotlib.rc_context(RC):
        content = io.BytesIO()
        canvas.savefig(content, format="pdf", metadata={"CreationDate": None})
    return content.getvalue()
