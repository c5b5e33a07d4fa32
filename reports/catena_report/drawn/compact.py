"""SVG without what matplotlib writes and nobody reads: a page of many figures has to stay small enough for a browser."""
import re

# Marks of one series: each says the colours that all of them have.
MARKS = re.compile(r'<g((?: clip-path="[^"]*")?)>(<use [^>]*? style="([^"]*)"/>(?:<use [^>]*? style="\3"/>)+)</g>')
# Lines of one look, one after the other: the spread of every point of a series.
LINES = re.compile(r'<path d="([^"]*)"([^>]*fill: none[^>]*)/>(?:<path d="[^"]*"\2/>)+')
OWN_NAME = re.compile(r' id="[\w.]+?_\d+"')  # "line2d_4"; a figure's own have no such end
SHARED = re.compile(r'(\bid="|xlink:href="#|url\(#)([mp][0-9a-f]{10})\b')  # marks and borders of panels
PLAIN_GROUP = re.compile(r"<g>((?:(?!</?g[ >]).)*)</g>", re.S)


def compact(svg):
    """The same drawing in half the size."""
    body = OWN_NAME.sub("", re.sub(r"\s*\n\s*", " ", svg).replace("> <", "><"))
    # In tags, never in text, a hundredth of a point is enough.
    body = re.sub(r"<[^>]*>", lambda tag: re.sub(r"(\d\.\d{2})\d+", r"\1", tag[0]).replace(' "', '"'), body)
    body = re.sub(r' transform="rotate\(-0 [^)]*\)"', "", body)  # every text has one, and it turns nothing
    body = LINES.sub(_one_path, MARKS.sub(_said_once, body))
    names = {name: f"{name[0]}{at}" for at, name in enumerate(dict.fromkeys(found[2] for found in SHARED.finditer(body)))}
    body = SHARED.sub(lambda found: found[1] + names[found[2]], body)
    while (fewer := PLAIN_GROUP.sub(r"\1", body)) != body:
        body = fewer
    return body


def _said_once(found):
    group, marks, style = found.groups()
    return f'<g{group} style="{style}">' + marks.replace(f' style="{style}"', "") + "</g>"


def _one_path(found):
    drawn = " ".join(re.findall(r' d="([^"]*)"', found[0]))
    return f'<path d="{drawn}"{found[2]}/>'
