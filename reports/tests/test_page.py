"""The page and the files beside it: sections, addresses, ids, what it carries."""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import made
import pages
from catena_report import page, runfile, section, sections, style


class Everything(pages.Made):
    values = [made.run()]

    def test_every_section_but_the_viewer_is_there(self):
        names = {module.__name__.rpartition(".")[2].replace("_", "-") for module in sections.ORDER}
        self.assertEqual(set(self.page.sections), names - {"viewer"})

    def test_every_figure_and_table_is_recomputed_by_a_test(self):
        """What no test computes a second time from the raw run may be wrong and look right."""
        keys = {f"figure:{key}" for key in self.page.unpacked("figures")} | {f"table:{key}" for key in self.page.tables}
        keys |= pages.Shown(runfile.load(made.REPORTS / "results" / "h200_quick.json.gz")).keys()
        self.assertEqual(keys - pages.recomputed(), set())
        self.assertEqual(pages.recomputed() - keys - {"table:path1", "table:path2", "figure:times-resident"}, set())

    def test_the_folder_lists_what_was_written(self):
        listed = (self.output / ".catena-report").read_text().splitlines()
        written = {str(path.relative_to(self.output)) for path in self.output.rglob("*") if path.is_file()}
        self.assertEqual(listed[0], "report")
        self.assertEqual(set(listed[1:]), written - {".catena-report"})

    def test_stands_alone(self):
        outside = {address for address in self.page.addresses if not address.startswith(("#", "data:"))}
        self.assertEqual(outside, {"https://oeis.org/A001412"})  # of a link, which loads nothing
        text = self.text.replace('<a href="https://oeis.org/A001412">https://oeis.org/A001412</a>', "")
        self.assertNotRegex(re.sub(r"https?://www\.w3\.org/\S+|<!DOCTYPE[^>]*>", "", text), r"(src|href)=[\"']?https?:")

    def test_a_line_does_not_end_within_an_option(self):
        for text, said in (
            ("path1 (--paper)", 'path1 (<span class="option">--paper</span>)'),
            ("a --no-omit b", 'a <span class="option">--no-omit</span> b'),
            ("--x <b>", '<span class="option">--x</span> &lt;b&gt;'),
            ("1e--2 and a--b", "1e--2 and a--b"),
            ("see https://oeis.org/A1", "see https://oeis.org/A1"),
            ('https://a"b', "https://a&#34;b"),
        ):
            self.assertEqual(page._text(text), said)
        for in_prose_and_table in ("--warm-up", "--walks"):
            self.assertIn(f'<span class="option">{in_prose_and_table}</span>', self.text)
        self.assertLess(len(self.text), page.LIMIT)

    def test_ids_are_unique(self):
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))

    def test_what_comes_from_data_is_escaped(self):
        self.assertNotIn("<1536>", self.text)
        self.assertIn("takes at most &lt;1536&gt;", self.text)

    def test_carries_its_data(self):
        value = json.loads(json.dumps(self.values[0]))
        value["catena"].pop("viewer", None)
        self.assertEqual(self.page.runs(), [value])
        self.assertEqual(json.loads((self.output / "run.json").read_text()), self.values[0])

    def test_static_and_interactive_hold_the_same_series(self):
        """Every series that is shown at first is drawn in the SVG too, with as many points."""
        for key, figure in self.page.unpacked("figures").items():
            drawing = (self.output / "figures" / f"{key}.svg").read_text()
            shown = re.search(rf'describedby="alternative-{key}">(.*?)</div>', self.text, re.S)[1]
            self.assertIn("background: #ffffff", drawing)
            # The same drawing, in the colours of the page's theme.
            self.assertEqual(re.findall(r'\bid="[^"]*"', shown), re.findall(r'\bid="[^"]*"', drawing))
            self.assertNotIn(style.LIGHT["ink"], shown)
            for at, panel in enumerate(figure["panels"]):
                series = [trace for trace in panel["data"] if trace["type"] == "scatter"]
                for number, trace in enumerate(series):
                    group = f'id="{key}-series-{at}-{number}"'
                    self.assertEqual(group in drawing, trace["visible"] is True, (key, at, trace["name"]))

    def test_every_figure_and_table_has_its_files(self):
        for key in self.page.unpacked("figures"):
            self.assertGreater((self.output / "figures" / f"{key}.pdf").stat().st_size, 1000)
        markdown = (self.output / "report.md").read_text()
        self.assertNotRegex(markdown, r"(?m)^## [^\n]*\n+(## |\Z)")  # nothing but tables
        self.assertNotRegex(markdown, r"[.?!]\.\*\*")  # a title that is a question has its own end
        for key, rows in self.page.tables.items():
            with open(self.output / "tables" / f"{key}.csv", newline="") as file:
                written = list(csv.reader(file))
            # What is worded has its number in a column beside it; the button of the page saves the same.
            shown = [at for at, name in enumerate(written[0]) if not name.endswith(": number")]
            self.assertEqual([written[0][at] for at in shown], rows[0], key)
            self.assertEqual({len(row) for row in written}, {len(written[0])}, key)
            self.assertEqual(len(written), len(rows), key)
            self.assertEqual((self.output / "tables" / f"{key}.csv").read_bytes().decode(), self.page.unpacked("tables")[key])
            latex = (self.output / "tables" / f"{key}.tex").read_text()
            self.assertEqual(latex.count(r"\\"), len(rows), key)


class Short(pages.Made):
    """A run of one variant on one chain, which most sections have nothing to say of."""

    drawn = False

    @classmethod
    def setUpClass(cls):
        value = json.loads(json.dumps(made.run(repetitions=2)))
        value["benchmarks"] = [row for row in value["benchmarks"] if row["name"].startswith("path1/n:1000/aCPU2+CPU2/")]
        value["catena"] = {key: value["catena"][key] for key in ("variants", "scenes")}
        cls.values = [value]
        super().setUpClass()

    def test_what_is_said_of_a_section_leads_to_it_or_is_no_link(self):
        self.assertIn('<a href="#times"><strong>Compared</strong></a> on', self.text)
        alone = section.Section("times", "", [section.Prose(section.link("times", "A") + section.link("slowdown", "B"))])
        self.assertEqual(section.without_dead_links([alone])[0].blocks[0].text, '<a href="#times"><strong>A</strong></a><strong>B</strong>')
        self.assertIn("claims", self.page.sections)  # of the committed run: the summary tells of it
        self.assertIn("No run of this page can test any.", self.text)
        self.assertEqual({row[2].partition(" committed ")[1] for row in self.page.tables["claims"][1:]}, {" committed "})


class Several(pages.Made):
    drawn = False
    values = [made.run(), json.loads(made.H200.read_text())]

    def test_each_run_is_named(self):
        for name in ("a GPU", "NVIDIA H200"):
            self.assertIn(name, self.page.tables["environment"][0])
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        figures = self.page.unpacked("figures")
        self.assertIn("times-find-1", figures)
        self.assertIn("times-find-2", figures)
        self.assertEqual(json.loads((self.output / "run.json").read_text()), self.values)
        again = [run.raw for run in runfile.load_all(self.output / "run.json")]
        self.assertEqual(json.dumps(again), json.dumps(self.values))  # as text, in which nan is nan

    def test_a_claim_judged_differently_is_told_once(self):
        summary = re.search(r'id="summary".*?</section>', self.text, re.S).group()
        differing = re.search(r"hold in one run and not in another</strong></a>: (.*?)</li", summary, re.S).group(1)
        self.assertIn("Two threads per sphere (GPUv2) reduce the time of GPU2 by half", differing)
        self.assertEqual(summary.count("Two threads per sphere"), 1)


class Installed(unittest.TestCase):
    """As `cmake --install` leaves the package: alone, with nothing of the source tree beside it."""

    def test_it_writes_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            package = pathlib.Path(page.__file__).parent
            shutil.copytree(package, folder / "share" / package.name)
            done = subprocess.run(
                [sys.executable, "-m", package.name, "--output", folder / "page", made.H200],
                env={**os.environ, "PYTHONPATH": str(folder / "share")},
                capture_output=True,
                text=True,
            )
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("the paper", (folder / "page" / "index.html").read_text())


class WithoutPlotly(pages.Made):
    values, drawn = [made.run()], False

    @classmethod
    def setUpClass(cls):
        with unittest.mock.patch("catena_report.page.interactive.library", return_value=None):
            super().setUpClass()

    def test_static_figures_and_a_word(self):
        self.assertIn("python3-plotly", self.text)
        self.assertIn("<svg", self.text)
        self.assertNotIn("plotly", self.page.packed)


if __name__ == "__main__":
    unittest.main()
