"""A figure as plotly reads it, and plotly itself from Debian's python3-plotly. Colours are names; the page
resolves them.
"""
import base64
import gzip
import importlib.util
import math
import pathlib

import numpy
import scipy.spatial

from .. import words

# Where Debian's python3-plotly has the library; under pip it is beside the module.
PLACES = ("/usr/share/python3-plotly/plotly.min.js", "/usr/share/python3-plotly/plotly.js")


def library():
    """The path of plotly's JavaScript, or None."""
    spec = importlib.util.find_spec("plotly")
    found = [pathlib.Path(place) for place in PLACES]
    if spec and spec.submodule_search_locations:
        found += [
            pathlib.Path(place) / "package_data/plotly.min.js" for place in spec.submodule_search_locations
        ]
    return next((path for path in found if path.is_file()), None)


def packed(path):
    """The file, gzipped, as base64: the page inflates it."""
    return base64.b64encode(gzip.compress(path.read_bytes(), 9, mtime=0)).decode()


def describe(figure):
    """What the page's script draws: {columns, legend, categories, panels: [{title, height, data, layout}]}."""
    return {
        "key": figure.key,
        "columns": figure.columns,
        "legend": [
            {
                "name": name,
                "colour": look.colour,
                "marker": look.marker,
                "dash": look.dash,
                "hollow": look.hollow,
                "shown": shown,
            }
            for name, (look, shown) in figure.legend().items()
        ],
        "categories": [{"name": label, "colour": colour} for label, colour in figure.categories()],
        "panels": [
            {
                "title": panel.title,
                "height": panel.height,
                "least": panel.least,
                "data": _data(panel),
                "layout": _layout(panel),
            }
            for panel in figure.panels
        ],
    }


NEAR = 0.008  # of the span of an axis: markers nearer than this cover each other
NAMED = 6  # of those that a marker covers


def covered(panel):
    """series index -> point index -> names of the other shown series with a point under the same marker."""
    points = [
        (at, number, _place(x, panel.x), _place(y, panel.y))
        for at, series in enumerate(panel.series)
        if series.shown and series.hover
        for number, (x, y) in enumerate(zip(series.x, series.y))
    ]
    points = [point for point in points if all(map(math.isfinite, point[2:]))]
    if not points:
        return {}
    places = numpy.array([point[2:] for point in points])
    span = numpy.maximum(places.max(axis=0) - places.min(axis=0), 1e-12)
    found = {}
    for a, b in scipy.spatial.cKDTree(places / span).query_pairs(NEAR):
        for (at, number, *_), (other, *_) in ((points[a], points[b]), (points[b], points[a])):
            if at != other:
                found.setdefault(at, {}).setdefault(number, set()).add(panel.series[other].name)
    return found


def _place(value, axis):
    if not axis.log:
        return float(value)
    return math.log10(value) if value > 0 else -math.inf


def _hover(series, under):
    """The text of each point, with the names of those that lie under its marker."""
    if not series.hover or not under:
        return series.hover
    return [
        f"{text}<br>also here: {words.listed(sorted(under[at] - {series.name}), NAMED)}"
        if under.get(at, set()) - {series.name}
        else text
        for at, text in enumerate(series.hover)
    ]


def _data(panel):
    under = covered(panel)
    traces = [_trace(series, _hover(series, under.get(at))) for at, series in enumerate(panel.series)]
    return [_heat(panel)] + traces if panel.heat else traces


def _trace(series, hover):
    look, colour = series.look, f"var(--{series.look.colour})"
    mode = "+".join(
        part
        for part, wanted in (("lines", series.line), ("markers", series.markers), ("text", series.labels))
        if wanted
    )
    trace = {
        "type": "scatter",
        "name": series.name,
        "x": list(series.x),
        "y": list(series.y),
        "mode": mode,
        "visible": True if series.shown else "legendonly",
        "showlegend": False,
        "line": {"color": colour, "dash": look.dash, "width": 2 * series.width},
        "marker": {
            "color": colour,
            "symbol": look.marker + ("-open" if look.hollow else ""),
            "size": 8 * series.size,
            "line": {"color": colour, "width": 1.5 if look.hollow else 0},
        },
    }
    if hover:
        trace |= {"text": hover, "hovertemplate": "%{text}<extra></extra>"}
    else:
        trace["hoverinfo"] = "skip"
    if series.labels:
        trace |= {
            "text": series.labels,
            "textposition": "middle right",
            "textfont": {"color": "var(--muted)", "size": 11},
        }
        if hover:
            trace |= {"hovertext": hover, "hovertemplate": "%{hovertext}<extra></extra>"}
    if series.chains:
        trace["customdata"] = series.chains
    if series.low is not None:
        centre = series.x if series.across else series.y
        trace["error_x" if series.across else "error_y"] = {
            "type": "data",
            "symmetric": False,
            "color": colour,
            "thickness": 1.2,
            "width": 0,
            "array": [max(0.0, high - c) for c, high in zip(centre, series.high)],
            "arrayminus": [max(0.0, c - low) for c, low in zip(centre, series.low)],
        }
    return trace


def _heat(panel):
    colours = panel.heat.categories
    steps = len(colours)
    scale = [
        [edge / steps, f"var(--{colour})"] for at, (_, colour) in enumerate(colours) for edge in (at, at + 1)
    ]
    trace = {
        "type": "heatmap",
        "x": list(range(len(panel.x.categories))),
        "y": list(range(len(panel.y.categories))),
        "z": panel.heat.value,
        "zmin": -0.5,
        "zmax": steps - 0.5,
        "colorscale": scale,
        "showscale": False,
        "xgap": 1,
        "ygap": 1,
        "text": panel.heat.hover,
        "hovertemplate": "%{text}<extra></extra>",
    }
    if panel.heat.chains:
        trace["customdata"] = panel.heat.chains
    return trace


def _layout(panel):
    shapes, notes = [], []
    for line in panel.lines:
        along, other = ("y", "x") if line.across else ("x", "y")
        band = line.to is not None
        if panel.heat:
            notes.append(
                {
                    "text": f"<b>{line.label}</b>",
                    "showarrow": False,
                    "yref": "paper",
                    "x": line.at,
                    "y": 1,
                    "xanchor": "left",
                    "yanchor": "bottom",
                }
            )
            continue
        shapes.append(
            {
                "type": "rect" if band else "line",
                f"{other}ref": "paper",
                f"{along}0": line.at,
                f"{along}1": line.to if band else line.at,
                f"{other}0": 0,
                f"{other}1": 1,
                "layer": "below",
                "line": {"width": 0 if band else 1, "color": "var(--muted)", "dash": "dash"},
                **({"fillcolor": "var(--band)"} if band else {}),
            }
        )
        if line.label:
            log = (panel.y if line.across else panel.x).log
            notes.append(
                {
                    "text": line.label,
                    "showarrow": False,
                    f"{other}ref": "paper",
                    f"{other}": 1,
                    f"{along}": math.log10(line.at) if log else line.at,
                    "xanchor": "right" if line.across else "left",
                    "yanchor": "bottom" if line.across else "top",
                    "font": {"color": "var(--muted)", "size": 11},
                }
            )
    return {
        "xaxis": _axis(panel.x, False, *_ends(panel, "x")),
        "yaxis": _axis(panel.y, True, *_ends(panel, "y")),
        "shapes": shapes,
        "annotations": notes,
        **({"margin": {"l": 58, "r": 14, "t": 28, "b": 46}} if panel.heat else {}),
    }


def _ends(panel, letter):
    """The least and the greatest of what an axis shows at first."""
    values = [
        value for series in panel.series if series.shown for value in getattr(series, letter) if value > 0
    ]
    return (min(values), max(values)) if values else (1, 1)


PLAIN = (1e-4, 1e7)  # between these a logarithmic axis has numbers, beyond powers of ten


def _axis(axis, is_y, least, greatest):
    span = greatest / least
    layout = {
        "title": {"text": axis.title, "standoff": 8},
        "type": "log" if axis.log else "linear",
        "automargin": True,
        "zeroline": False,
        "gridcolor": "var(--grid)",
        "linecolor": "var(--faint)",
        "showline": True,
        "ticks": "",
        "tickformat": "~s" if axis.title.startswith("spheres") else ",~g",
    }
    if axis.log:
        layout["dtick"] = "D2" if span < 50 else max(1, math.ceil(math.log10(span) / 8))
        if span >= 50 and not PLAIN[0] <= least <= greatest <= PLAIN[1]:
            del layout["tickformat"]
            layout["exponentformat"] = "power"
    if axis.categories is not None:
        size = len(axis.categories)
        layout |= {
            "tickmode": "array",
            "tickvals": list(range(size)),
            "ticktext": axis.categories,
            "showgrid": False,
            "tickfont": {"size": 12 if size < 30 else 10},
            "range": [size - 0.5, -0.5] if is_y else [-0.5, size - 0.5],
        }
        if not is_y and sum(map(len, axis.categories)) > 100:
            layout["tickangle"] = -90
    if axis.range:
        layout["range"] = [math.log10(end) for end in axis.range] if axis.log else list(axis.range)
    return layout
