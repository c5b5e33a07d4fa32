"""The page and the files beside it."""
import base64
import concurrent.futures
import gzip
import itertools
import json
import multiprocessing
import os
import pathlib
import signal

import jinja2

from . import sections, whole_file
from .drawn import interactive, static
from .figure import Figure
from .section import Code, Heading, Prose, Raw
from .sections import viewer
from .style import DARK, LIGHT
from .table import Table

HERE = pathlib.Path(__file__).parent
LIMIT = 10_000_000  # bytes of the page; a quick run of a machine with a GPU and all peers takes 9


def write(report, output):
    """Writes the page below the folder `output`; the path of index.html."""
    output = pathlib.Path(output)
    for folder in ("figures", "tables"):
        (output / folder).mkdir(parents=True, exist_ok=True)
    built = sections.build(report)
    blocks = [block for section in built for block in section.blocks]
    _list_files(blocks, output)
    drawings = _draw_all([block for block in blocks if isinstance(block, Figure)], output)
    for table in (block for block in blocks if isinstance(block, Table)):
        table.write_csv(output / "tables" / f"{table.key}.csv")
        table.write_latex(output / "tables" / f"{table.key}.tex")
    _write_markdown(built, output / "report.md")
    raw = json.dumps(
        [run.raw for run in report.runs] if len(report.runs) > 1 else report.runs[0].raw,
        separators=(",", ":"),
    )
    whole_file.write(output / "run.json", raw)
    library, left_out = interactive.library(), []
    if not library:
        left_out.append(
            "zooming, hovering and toggling of plots: plotly's JavaScript was not found (Debian package"
            " python3-plotly)"
        )
    if viewer.missing(report):
        left_out.append(f"the three-dimensional view of the chains: {viewer.missing(report)}")
    text = _render(report, built, drawings, library, left_out)
    path = output / "index.html"
    whole_file.write(path, text)
    return path


def _list_files(blocks, output):
    """Says in the folder what this report is about to write there, so that the next one can remove what it
    does not replace (reports/report_folder.h).
    """
    named = {Figure: ("figures", "svg", "pdf"), Table: ("tables", "csv", "tex")}
    files = [
        f"{folder}/{block.key}.{kind}"
        for type_, (folder, *kinds) in named.items()
        for block in blocks
        if isinstance(block, type_)
        for kind in kinds
    ]
    with (output / ".catena-report").open("a", encoding="utf-8") as file:
        file.write("\n".join(["report", *files, "report.md", "run.json", "index.html"]) + "\n")


def _write_markdown(built, path):
    """The tables of the page as one Markdown file, for places that show no HTML."""
    parts = ["# Self-collisions of tubes, compared\n"]
    for section in built:
        tables = [block for block in section.blocks if isinstance(block, Table)]
        parts += [f"\n## {section.title}\n"] if tables else []
        parts += [f"\n**{table.title}.** {table.caption}\n\n{table.markdown()}" for table in tables]
    whole_file.write(path, "".join(parts))


def _draw_all(figures, output):
    """The drawings by their keys, drawn by all cores: half a second each, which is most of what the page takes."""
    with concurrent.futures.ProcessPoolExecutor(
        len(os.sched_getaffinity(0)),
        multiprocessing.get_context("fork"),  # matplotlib is imported once
        initializer=signal.signal,  # at Ctrl-C this process speaks for all
        initargs=(signal.SIGINT, signal.SIG_IGN),
    ) as cores:
        drawn = cores.map(_draw, figures, itertools.repeat(output))
        return {figure.key: text for figure, text in zip(figures, drawn, strict=True)}


def _draw(figure, output):
    canvas = static.draw(figure)
    text = static.svg(canvas, figure.key)
    whole_file.write(output / "figures" / f"{figure.key}.svg", static.on_white(text))
    static.pdf(canvas, output / "figures" / f"{figure.key}.pdf")
    return static.themed(text)


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


def _render(report, built, drawings, library, left_out):
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
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
        script=read("report.js"),
        figures=_packed({figure.key: interactive.describe(figure) for figure in figures}),
        data=_packed(data(report)),
        plotly=interactive.packed(library) if library else "",
    )
