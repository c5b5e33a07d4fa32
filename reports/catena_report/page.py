"""The page and the files beside it."""
import base64
import concurrent.futures
import dataclasses
import gzip
import json
import multiprocessing
import os
import pathlib
import re
import signal

import jinja2
import markupsafe

from . import columns, kept_runs, sections, whole_file
from .drawn import interactive, static
from .figure import Figure
from .section import Code, Heading, Prose, Raw
from .sections import viewer
from .style import DARK, LIGHT
from .table import Table

HERE = pathlib.Path(__file__).parent
INDEX = "index.html"
LIMIT = 8_000_000  # bytes of the page; a quick run of a machine with a GPU and all peers takes 7


def write(report, output):
    """Writes the page below the folder `output`; the path of index.html. All of it is made before anything is written:
    what cannot be made leaves the folder as it was.
    """
    output = pathlib.Path(output)
    kept_runs.require(output, report.runs)
    files = {name: _bytes(content) for name, content in _files(report).items()}
    for folder in ("figures", "tables"):
        (output / folder).mkdir(parents=True, exist_ok=True)
    _list_files(files, output)
    for name, content in files.items():
        whole_file.write(output / name, content)
    return output / INDEX


def _bytes(content):
    return content if isinstance(content, bytes) else content.encode("utf-8")


def _files(report):
    """{name: content} of all that is written, the page last."""
    built = sections.build(report)
    blocks = [block for section in built for block in section.blocks]
    drawings = _draw_all([block for block in blocks if isinstance(block, Figure)])
    files = {}
    for key, drawing in drawings.items():
        files |= {f"figures/{key}.svg": drawing.on_white, f"figures/{key}.pdf": drawing.pdf}
    for table in (block for block in blocks if isinstance(block, Table)):
        files |= {f"tables/{table.key}.csv": table.as_csv(), f"tables/{table.key}.tex": table.as_latex()}
    files["report.md"] = _markdown(built)
    files["run.json"] = json.dumps(
        [run.raw for run in report.runs] if len(report.runs) > 1 else report.runs[0].raw,
        separators=(",", ":"),
    )
    library, left_out = interactive.library(), []
    if not library:
        left_out.append(
            "zooming, hovering and toggling of plots: plotly's JavaScript was not found (Debian package"
            " python3-plotly)"
        )
    if viewer.missing(report):
        left_out.append(f"the three-dimensional view of the chains: {viewer.missing(report)}")
    files[INDEX] = _render(report, built, {key: drawing.themed for key, drawing in drawings.items()}, library, left_out)
    return files


def _list_files(files, output):
    """Says in the folder what this report is about to write there, so that the next one can remove what it
    does not replace (reports/report_folder.h).
    """
    with (output / ".catena-report").open("a", encoding="utf-8") as file:
        file.write("\n".join(["report", *files]) + "\n")


def _markdown(built):
    """The tables of the page as one Markdown file, for places that show no HTML."""
    parts = ["# Self-collisions of tubes, compared\n"]
    for section in built:
        tables = [block for block in section.blocks if isinstance(block, Table)]
        parts += [f"\n## {section.title}\n"] if tables else []
        for table in tables:
            stop = "" if table.title.endswith("?") else "."
            parts.append(f"\n**{table.title}{stop}** {table.caption}\n\n{table.markdown()}")
    return "".join(parts)


@dataclasses.dataclass(frozen=True)
class Drawing:
    """Of a figure: SVG in the colours of the page's theme, SVG for anywhere else, PDF."""

    themed: str
    on_white: str
    pdf: bytes


def _draw_all(figures):
    """The drawings by their keys, drawn by all cores: half a second each, which is most of what the page takes."""
    try:
        with concurrent.futures.ProcessPoolExecutor(
            len(os.sched_getaffinity(0)),
            multiprocessing.get_context("fork"),  # matplotlib is imported once
            initializer=signal.signal,  # at Ctrl-C this process speaks for all
            initargs=(signal.SIGINT, signal.SIG_IGN),
        ) as cores:
            return {figure.key: drawing for figure, drawing in zip(figures, cores.map(_draw, figures), strict=True)}
    except OSError:  # no more processes, or nothing that they can share, as where /dev/shm cannot be written
        return {figure.key: _draw(figure) for figure in figures}


def _draw(figure):
    canvas = static.draw(figure)
    text = static.svg(canvas, figure.key)
    return Drawing(static.themed(text), static.on_white(text), static.pdf(canvas))


def data(report):
    """What the page carries of its runs: everything but the views, which the viewer carries, and rows that
    Google Benchmark computed from others.
    """
    return [
        {
            **run.raw,
            "benchmarks": [
                row for row in run.raw["benchmarks"] if row.get("run_type", "iteration") == "iteration"
            ],
            **(
                {"catena": {key: value for key, value in run.catena.items() if key != "viewer"}}
                if run.catena
                else {}
            ),
        }
        for run in report.runs
    ]


def _packed(value):
    text = json.dumps(value, separators=(",", ":"), allow_nan=False).encode()
    return base64.b64encode(gzip.compress(text, 9, mtime=0)).decode()


OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")
ADDRESS = re.compile(r"https://[\w./-]+")


def _text(text):
    """Text as HTML: a line does not end within an option, and what is an address and nothing else is a link."""
    if ADDRESS.fullmatch(text):
        return markupsafe.Markup('<a href="{0}">{0}</a>').format(text)
    return markupsafe.Markup(OPTION.sub(r'<span class="option">\g<0></span>', str(markupsafe.escape(text))))


def _render(report, built, drawings, library, left_out):
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["text"] = _text
    kinds = {Figure: "figure", Table: "table", Prose: "prose", Heading: "heading", Code: "code", Raw: "raw"}
    read = lambda name: (HERE / "assets" / name).read_text(encoding="utf-8")  # noqa: E731
    figures = [block for section in built for block in section.blocks if isinstance(block, Figure)]
    return environment.get_template("page.html").render(
        report=report,
        sections=built,
        drawings=drawings,
        kind=lambda block: kinds[type(block)],
        left_out=left_out,
        light=LIGHT,
        dark=DARK,
        style=read("report.css"),
        script=read("legend.js") + read("report.js"),
        figures=_packed({figure.key: interactive.describe(figure) for figure in figures}),
        data=_packed([{**run, "benchmarks": columns.of_rows(run["benchmarks"])} for run in data(report)]),
        tables=_packed({table.key: table.as_csv() for section in built for table in section.blocks if isinstance(table, Table)}),
        plotly=interactive.packed(library) if library else "",
    )
