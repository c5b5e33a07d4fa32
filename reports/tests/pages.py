"""What tests of the page share: a page written and parsed, or only its sections, which costs no drawing; and the mark
of a test that computes a figure or table a second time.
"""
import base64
import contextlib
import gzip
import html.parser
import json
import pathlib
import tempfile
import unittest
import unittest.mock

import made
from catena_report import page, report, runfile, sections
from catena_report.figure import Figure
from catena_report.section import Prose
from catena_report.table import Table


def recomputes(*keys):
    """Marks a test that computes what is shown under these keys ("figure:counts", "table:counts") from the raw run.
    test_page.py holds that every figure and table has one.
    """
    return lambda test: test


def recomputed():
    """The keys that the tests of this folder are marked with."""
    found = set()
    for file in pathlib.Path(__file__).parent.glob("test_*.py"):
        for line in file.read_text(encoding="utf-8").splitlines():
            if line.strip().startswith("@recomputes("):
                found |= set(line.split('"')[1::2])
    return found


def of(value):
    """The run in a value, which is left as it is."""
    return runfile.Run("run.json", json.loads(json.dumps(value)))


class Shown:
    """The blocks of the sections of one or several runs, without drawing: figures and tables by key, prose joined."""

    def __init__(self, *runs):
        self.report = report.Report(list(runs))
        self.sections = sections.build(self.report)
        blocks = [block for section in self.sections for block in section.blocks]
        self.figures = {block.key: block for block in blocks if isinstance(block, Figure)}
        self.tables = {block.key: block for block in blocks if isinstance(block, Table)}
        self.prose = "\n".join(
            line for block in blocks if isinstance(block, Prose) for line in (block.text, *block.points)
        )

    def keys(self):
        return {f"figure:{key}" for key in self.figures} | {f"table:{key}" for key in self.tables}

    def rows(self, key):
        """The rows of a table as they are read."""
        return [[cell.text for cell in row] for row in self.tables[key].rows]

    def raw(self, key):
        """The rows of a table, with the number behind a cell where there is one."""
        return [[cell.raw for cell in row] for row in self.tables[key].rows]


def shown(value):
    return Shown(of(value))


def rows_of(packed):
    """The rows that columns.of_rows packed."""
    left = [
        iter(zip(*(columns[column] if isinstance(column, int) else column for column in columns)))
        for columns in packed["columns"]
    ]
    return [dict(zip(packed["shapes"][shape], next(left[shape], ()))) for shape in packed["shape"]]


class Parsed(html.parser.HTMLParser):
    """Sections, tables as text, ids and addresses of a page."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.sections, self.tables, self.addresses, self.packed = [], [], {}, [], {}
        self._table = self._cell = self._script = None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids += [given["id"]] if "id" in given else []
        self.addresses += [given[name] for name in ("src", "href", "xlink:href") if name in given]
        if tag == "section":
            self.sections.append(given["id"])
        if tag == "div" and given.get("id", "").startswith("table-"):
            self._table = self.tables[given["id"][6:]] = []
        if tag == "tr" and self._table is not None:
            self._table.append([])
        if tag in ("td", "th") and self._table:
            self._table[-1].append("")
            self._cell = True
        if tag == "script" and "id" in given:
            self._script = given["id"]
            self.packed[self._script] = ""

    def handle_endtag(self, tag):
        self._cell = None if tag in ("td", "th") else self._cell
        self._script = None if tag == "script" else self._script

    def handle_data(self, text):
        if self._cell:
            self._table[-1][-1] += text
        if self._script:
            self.packed[self._script] += text

    def unpacked(self, name):
        return json.loads(gzip.decompress(base64.b64decode(self.packed[name])))

    def runs(self):
        """The runs that the page carries, as their files have them."""
        return [{**run, "benchmarks": rows_of(run["benchmarks"])} for run in self.unpacked("data")]


def without_figures():
    """While this lasts, pages are written with empty figures, which take no time to draw."""
    blank = lambda figures: {figure.key: page.Drawing("<svg></svg>", "", b"") for figure in figures}  # noqa: E731
    return unittest.mock.patch("catena_report.page._draw_all", blank)


class Made(unittest.TestCase):
    """A page written from `values`, which the cases that derive from this set, and what holds of every page. Its
    figures take seconds to draw; without `drawn` they are empty.
    """

    values, drawn = [], True

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.output = pathlib.Path(cls.folder.name) / "page"
        runs = [
            runfile.load(made.write(cls.folder.name, value, f"run{at}.json"))
            for at, value in enumerate(cls.values)
        ]
        with contextlib.nullcontext() if cls.drawn else without_figures():
            cls.text = page.write(report.Report(runs), cls.output).read_text()
        cls.page = Parsed(cls.text)

    def test_every_link_within_the_page_leads_somewhere(self):
        within = {address[1:] for address in self.page.addresses if address.startswith("#")}
        self.assertTrue(within)
        self.assertEqual(within - set(self.page.ids), set())
