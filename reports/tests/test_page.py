"""The page against the data it was made from: what it says is computed here a second time, from the JSON
alone.
"""
import base64
import csv
import dataclasses
import gzip
import html.parser
import json
import os
import pathlib
import re
import shutil
import statistics as plain
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import made
from catena_report import gate, page, paired, paper, report, runfile, style, variant, whole_file
from catena_report.drawn import interactive, static
from catena_report.figure import Axis, Figure, Heat, Panel, Series
from catena_report.style import Look


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
            self._table[-1][-1] += text.strip()
        if self._script:
            self.packed[self._script] += text

    def unpacked(self, name):
        return json.loads(gzip.decompress(base64.b64decode(self.packed[name])))


class Made(unittest.TestCase):
    """A page from a value; cls.value is set by the cases below."""

    values = []

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.output = pathlib.Path(cls.folder.name) / "page"
        runs = [
            runfile.load(made.write(cls.folder.name, value, f"run{at}.json"))
            for at, value in enumerate(cls.values)
        ]
        cls.text = page.write(report.Report(runs), cls.output).read_text()
        cls.page = Parsed(cls.text)


class Everything(Made):
    values = [made.run()]

    def test_every_section_but_the_viewer_is_there(self):
        from catena_report import sections

        names = {module.__name__.rpartition(".")[2].replace("_", "-") for module in sections.ORDER}
        self.assertEqual(set(self.page.sections), names - {"viewer"})

    def test_the_folder_lists_what_was_written(self):
        listed = (self.output / ".catena-report").read_text().splitlines()
        written = {str(path.relative_to(self.output)) for path in self.output.rglob("*") if path.is_file()}
        self.assertEqual(listed[0], "report")
        self.assertEqual(set(listed[1:]), written - {".catena-report"})

    def test_stands_alone(self):
        outside = [address for address in self.page.addresses if not address.startswith(("#", "data:"))]
        self.assertEqual(outside, [])
        self.assertNotRegex(
            re.sub(r"https?://www\.w3\.org/\S+|<!DOCTYPE[^>]*>", "", self.text), r"(src|href)=[\"']?https?:"
        )
        self.assertLess(len(self.text), page.LIMIT)

    def test_ids_are_unique(self):
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))

    def test_what_comes_from_data_is_escaped(self):
        self.assertNotIn("<1536>", self.text)
        self.assertIn("takes at most &lt;1536&gt;", self.text)

    def test_carries_its_data(self):
        value = json.loads(json.dumps(self.values[0]))
        value["catena"].pop("viewer", None)
        self.assertEqual(self.page.unpacked("data"), [value])
        self.assertEqual(json.loads((self.output / "run.json").read_text()), self.values[0])

    def test_points_of_the_plots_are_the_medians_of_the_data(self):
        figures = self.page.unpacked("figures")
        for stage in ("build", "update", "find"):
            for panel in figures[f"times-{stage}"]["panels"]:
                scene, each, _ = panel["title"].partition(", for each sphere")
                for trace in panel["data"]:
                    for n, y in zip(trace["x"], trace["y"]):
                        times = [
                            row["real_time"] / 1e6
                            for row in self.values[0]["benchmarks"]
                            if row.get("real_time")
                            and self.of(row["name"], scene, n, trace["name"], stage)
                        ]
                        self.assertTrue(times)
                        self.assertAlmostEqual(y, plain.median(times) * (1e6 / n if each else 1), places=9)

    @staticmethod
    def of(name, scene, n, trace, stage):
        """Whether a row belongs to a trace; a construction's trace pools the variants that begin with it."""
        parts = name.removesuffix("/manual_time").split("/")
        variant, arithmetic = parts[2], "/".join(parts[3:-1])
        if stage in ("build", "update"):
            variant = variant.partition("+")[0]
        return (
            parts[:2] == [scene, f"n:{n}"]
            and parts[-1] == stage
            and "/".join(filter(None, (variant, arithmetic))) == trace
        )

    def test_static_and_interactive_hold_the_same_series(self):
        """Every series that is shown at first is drawn in the SVG too, with as many points."""
        for key, figure in self.page.unpacked("figures").items():
            drawing = (self.output / "figures" / f"{key}.svg").read_text()
            for at, panel in enumerate(figure["panels"]):
                series = [trace for trace in panel["data"] if trace["type"] == "scatter"]
                for number, trace in enumerate(series):
                    group = f'id="{key}-series-{at}-{number}"'
                    self.assertEqual(group in drawing, trace["visible"] is True, (key, at, trace["name"]))

    def test_every_figure_and_table_has_its_files(self):
        for key in self.page.unpacked("figures"):
            self.assertGreater((self.output / "figures" / f"{key}.pdf").stat().st_size, 1000)
        for key, rows in self.page.tables.items():
            with open(self.output / "tables" / f"{key}.csv", newline="") as file:
                written = list(csv.reader(file))
            self.assertEqual(
                (len(written), [len(row) for row in written]), (len(rows), [len(row) for row in rows]), key
            )
            latex = (self.output / "tables" / f"{key}.tex").read_text()
            self.assertEqual(latex.count(r"\\"), len(rows), key)

    def test_exponents_find_the_law_of_the_data(self):
        for row in self.page.tables["exponents"][1:]:
            given = [cell for cell in row[2:] if cell]
            self.assertEqual(len(given), 1 if row[0].startswith("update") else 2, row)  # path2 does not move
            for cell in given:
                self.assertAlmostEqual(float(cell.split()[0]), 1, delta=0.05, msg=row)

    def test_claims_follow_the_data(self):
        verdicts = {row[0]: row[3] for row in self.page.tables["claims"][1:] if row[2] == "a GPU"}
        self.assertEqual(
            verdicts["Two threads per sphere (GPUv2) reduce the time of GPU2 by half."], "holds"
        )  # 5e-5 of 1e-4
        self.assertEqual(verdicts["Despite the GPU, GPU1 is the slowest traversal."], "holds")
        self.assertEqual(
            verdicts["GPU2 takes O(log n) time, since its n threads run in parallel."], "does not hold"
        )  # made linear
        self.assertEqual(verdicts["aCPU2 takes O(n log n) time."], "holds")
        self.assertEqual(verdicts["A parent encloses its two children."], "does not hold")
        self.assertNotIn("bGPU2 takes O(log n) time.", verdicts)
        self.assertIn("<strong>bGPU2 takes O(log n) time.</strong> bGPU2 was not timed at four sizes", self.text)

    def test_stability_cells_are_the_outcomes(self):
        panel = self.page.unpacked("figures")["stability"]["panels"][0]
        heat = panel["data"][0]
        found = sorted(value for row in heat["z"] for value in row if value is not None)
        codes = {"exact": 0, "unenclosed": 2, "wrong": 5, "not finite": 3, "refused": 6}
        self.assertEqual(
            found, sorted(codes[line["outcome"]] for line in self.values[0]["catena"]["stability"])
        )


class OtherData(Made):
    """Half the claim broken: with GPUv2 as slow as GPU2 the verdict must turn."""

    values = [made.run(slower={("aGPU2+GPUv2", "find"): 2, ("GPU1", "find"): 0.01})]

    def test_verdicts_turn_with_the_data(self):
        verdicts = {row[0]: row[3] for row in self.page.tables["claims"][1:] if row[2] == "a GPU"}
        self.assertEqual(
            verdicts["Two threads per sphere (GPUv2) reduce the time of GPU2 by half."], "does not hold"
        )
        self.assertEqual(verdicts["Despite the GPU, GPU1 is the slowest traversal."], "does not hold")


def with_peer_and_resident():
    """The made run with FCL, the fastest of all and wrong in places, and a search of a chain on the device."""
    value = made.run()
    value["catena"]["variants"]["FCL"] = made.described("FCL")
    added = []
    for row in value["benchmarks"]:
        if "/aGPU2+GPUv2/" in row["name"] and "/update" not in row["name"]:
            added.append({**row, "name": row["name"].replace("aGPU2+GPUv2", "FCL"), "real_time": row["real_time"] / 9})
        if "/aGPU2+GPU2/find" in row["name"]:
            added.append({**row, "name": row["name"].replace("/find", "/resident"), "real_time": row["real_time"] / 9})
    value["benchmarks"] += added
    for line in [line for line in value["catena"]["stability"] if line["variant"] == "GPU1"]:
        value["catena"]["stability"].append({**line, "variant": "FCL", "arithmetic": "binary64", "outcome": "wrong", "missing": 2})
    for point in [p for p in value["catena"]["work_precision"]["points"] if p["variant"] == "GPU1"]:
        value["catena"]["work_precision"]["points"].append({**point, "variant": "FCL", "front": True})
    return value


class Peer(Made):
    values = [with_peer_and_resident()]

    def names(self, figure):
        return {trace["name"] for panel in self.page.unpacked("figures")[figure]["panels"] for trace in panel["data"]}

    def test_it_is_timed_and_labelled(self):
        for figure in ("times-build", "times-find", "work-precision"):
            self.assertIn("FCL (peer)", self.names(figure))
        self.assertIn("FCL (peer) in 0.0 % of 3 cases", self.text)

    def test_each_peer_has_a_marker_of_its_own(self):
        fcl = variant.Variant.of("FCL", made.described("FCL"))
        several = [dataclasses.replace(fcl, name=name) for name in ("Bullet", "CGAL", "Embree", "FCL", "nanoflann")]
        looks = style.Looks(several)
        self.assertEqual(len({looks.variant(peer).marker for peer in several}), len(several))
        self.assertEqual({looks.variant(peer).colour for peer in several}, {"muted"})

    def test_it_is_never_recommended_but_stands_beside(self):
        self.assertTrue(all("FCL" not in " ".join(row) for row in self.page.tables["choice"]))
        for row in self.page.tables["advice-short"][1:]:
            self.assertNotIn("FCL", row[0])
            self.assertIn("FCL", row[5])
        self.assertIn("FCL (peer)", self.names("slowdown"))
        self.assertNotIn("FCL is fastest", self.text)

    def test_it_is_no_rounded_arithmetic_and_no_claim(self):
        alone = page.sections.build(report.Report([runfile.load(made.write(self.folder.name, made.run()))]))
        tables = {block.key: block for section in alone for block in section.blocks if hasattr(block, "columns")}
        for key in ("exactness", "claims"):
            shown = [[cell.text for cell in row] for row in tables[key].rows]
            self.assertEqual(self.page.tables[key][1:], shown, key)
        self.assertNotIn("binary64 arithmetic", self.text)

    def test_a_resident_search_has_its_own_figure(self):
        self.assertEqual(self.names("times-resident"), {"aGPU2+GPU2"})
        one = self.page.unpacked("figures")["times-find"]["panels"][0]
        times = next(trace["y"] for trace in one["data"] if trace["name"] == "aGPU2+GPU2")
        self.assertAlmostEqual(times[0], 1e-4 * 1000, delta=0.02)


class WithoutVariants(unittest.TestCase):
    """Nothing takes a name apart: a page needs the run's own table."""

    def refused(self, variants):
        value = made.run()
        value["catena"]["variants"] = variants
        with tempfile.TemporaryDirectory() as folder:
            path = made.write(folder, value)
            with self.assertRaises(runfile.BadRunFile) as raised:
                report.Report([runfile.load(path)])
        return str(raised.exception)

    def test_one_line_says_what_to_do(self):
        full = made.run()["catena"]["variants"]
        less = {name: value for name, value in full.items() if name != "GPU1"}
        for variants, says in (
            (None, "no catena.variants"),
            (less, "does not have GPU1"),
            ({**full, "GPU1": {}}, "not as in reports/run_file.md"),
            ({**full, "GPU1": {**full["GPU1"], "stages": []}}, "not as in reports/run_file.md"),
            ([1], "not as in reports/run_file.md"),
        ):
            line = self.refused(variants)
            self.assertIn(says, line)
            self.assertIn("measure again", line)
            self.assertNotIn("\n", line)

    def test_two_runs_are_compared_all_the_same(self):
        value = made.run()
        del value["catena"]["variants"]
        run = runfile.Run("run.json", value)
        self.assertTrue(gate.decide(paired.cases(run, run))[0])

    def test_what_a_variant_is_comes_from_the_table_alone(self):
        value = made.run()
        text = json.dumps(value)
        for at, name in enumerate(sorted(value["catena"]["variants"], key=len, reverse=True)):
            text = text.replace(name, f"v{at}")
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "run.json").write_text(text)
            run = runfile.load(pathlib.Path(folder) / "run.json")
            pages = report.Report([run])
        self.assertEqual(len(run.recommended()), 5)
        self.assertEqual(sum(run.info(name).rounded for name in run.variants()), 1)


class H200(Made):
    """The stored run: a plain file of Google Benchmark."""

    values = [json.loads(made.H200.read_text())]

    def test_sections_without_data_are_left_out(self):
        self.assertEqual(
            set(self.page.sections)
            & {"stability", "work-precision", "counts", "animation", "motion", "savings"},
            set(),
        )

    def test_tables_hold_the_paper_and_the_medians(self):
        printed = paper.tables()
        for path in paper.TABLES:
            head, *rows = self.page.tables[path]
            sizes = [int(cell.replace(",", "")) for cell in head[3:]]
            seen = 0
            for algorithm, _, place, *cells in rows:
                for n, cell in zip(sizes, cells):
                    if place == "the paper":
                        then = dict(zip(printed["n"], printed[path][algorithm]))
                        self.assertEqual(float(cell) if cell else None, then.get(n))
                    elif algorithm in paper.STAGES and cell:
                        variant, stage = paper.STAGES[algorithm]
                        times = [
                            row["real_time"]
                            for row in self.values[0]["benchmarks"]
                            if row["run_type"] == "iteration"
                            and row["name"].removesuffix("/manual_time")
                            in [f"{path}{frames}/n:{n}/{variant}/{stage}" for frames in ("", ":frames=all")]
                        ]
                        self.assertAlmostEqual(float(cell) / plain.median(times), 1, delta=0.006)
                        seen += 1
            self.assertGreater(seen, 40)


class EveryKeyframe(H200):
    """The same, timed through the whole animation, as `catena report --paper` does."""

    values = [
        json.loads(re.sub(r'"(path[12])/n:', r'"\1:frames=all/n:', made.H200.read_text()))
    ]


class Several(Made):
    values = [made.run(), json.loads(made.H200.read_text())]

    def test_each_run_is_named(self):
        for name in ("a GPU", "NVIDIA H200"):
            self.assertIn(name, self.page.tables["environment"][0])
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        figures = self.page.unpacked("figures")
        self.assertIn("times-find-1", figures)
        self.assertIn("times-find-2", figures)

    def test_a_claim_judged_differently_is_told_once(self):
        summary = re.search(r'id="summary".*?</section>', self.text, re.S).group()
        differing = re.search(r"hold in one run and not in another</strong></a>: (.*?)</li", summary, re.S).group(1)
        self.assertIn("Two threads per sphere (GPUv2) reduce the time of GPU2 by half", differing)
        self.assertEqual(summary.count("Two threads per sphere"), 1)


class Drawing(unittest.TestCase):
    def test_labels_keep_their_digits(self):
        drawn = Figure(
            "digits",
            "",
            "",
            [
                Panel(
                    "",
                    Axis("x", log=True),
                    Axis("y", log=True),
                    [Series("a", [1e-4, 1e-3, 1], [1e-4, 1e-3, 1], Look("c0"), labels=["1.23456", "", ""])],
                )
            ],
        )
        text = static.svg(static.draw(drawn), "digits")
        for label in ("0.0001", "0.001", "0.01", "1.23456"):
            self.assertIn(f">{label}<", text)
        self.assertNotRegex(text, r'd="[^"]*\d\.\d{3}')


class Covered(unittest.TestCase):
    """Points under one marker: the hover of the topmost names the others."""

    def drawn(self, **changed):
        hover = lambda name: [f"<b>{name}</b>"] * 2  # noqa: E731
        series = [
            Series("a", [10, 100], [1, 5], Look("c0"), hover=hover("a")),
            Series("b", [10.02, 100], [1.001, 9], Look("c1"), hover=hover("b")),
            Series("c", [10, 1000], [1, 5], Look("c2"), hover=hover("c"), **changed),
        ]
        panel = Panel("", Axis("x", log=True), Axis("y"), series)
        return [trace["text"] for trace in interactive.describe(Figure("k", "", "", [panel]))["panels"][0]["data"]]

    def test_the_others_are_named(self):
        a, b, c = self.drawn()
        self.assertEqual(a, ["<b>a</b><br>also here: b and c", "<b>a</b>"])
        self.assertEqual(b, ["<b>b</b><br>also here: a and c", "<b>b</b>"])
        self.assertEqual(c, ["<b>c</b><br>also here: a and b", "<b>c</b>"])

    def test_not_those_that_are_hidden(self):
        self.assertEqual(self.drawn(shown=False)[0], ["<b>a</b><br>also here: b", "<b>a</b>"])


class Alternative(unittest.TestCase):
    def test_it_tells_where_curves_begin_and_end(self):
        panel = Panel("path1", Axis("n", log=True), Axis("ms"), [Series("a", [10, 20, 30], [1, 2, 4.5], Look("c0"))])
        text = Figure("k", "", "", [panel]).alternative()
        self.assertEqual(text, "path1: ms over n. a from 1 at 10 to 4.5 at 30.")

    def test_of_a_map_how_many_cells_are_what(self):
        heat = Heat([[0, 1], [None, 1]], [("good", "c0"), ("bad", "c1")], [["", ""], ["", ""]])
        panel = Panel("", Axis("", categories=["x", "y"]), Axis("", categories=["u", "v"]), heat=heat)
        self.assertEqual(Figure("k", "", "", [panel]).alternative(), "Map: of 3 cells 1 good; 2 bad.")


class Views(unittest.TestCase):
    def test_a_chain_without_a_view_shows_the_nearest_of_its_scene(self):
        value = made.run()
        value["catena"]["viewer"] = [
            {"input": name} for name in ("path1/n:20", "path1/n:9000", "far:exponent=22/n:50")
        ]
        with tempfile.TemporaryDirectory() as folder:
            pages = report.Report([runfile.load(made.write(folder, value))])
        for asked, shown in (
            ("path1/n:20", "path1/n:20"),
            ("path1/n:10000", "path1/n:9000"),
            ("far:n=200,exponent=22", "far:exponent=22/n:50"),
            ("far:n=200,exponent=23", None),
            ("path2/n:20", None),
        ):
            self.assertEqual(pages.view(asked), shown, asked)


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


class Written(unittest.TestCase):
    """Files are written whole or not at all, and what cannot be written is said."""

    def test_what_was_there_stays_until_all_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "link").symlink_to("a")
            whole_file.write(folder / "link", "old\r\n")
            with unittest.mock.patch("pathlib.Path.replace", side_effect=OSError(28, "No space left on device")):
                with self.assertRaises(OSError) as raised:
                    whole_file.write(folder / "a", b"new")
            self.assertEqual(raised.exception.filename, str(folder / "a"))
            self.assertEqual((folder / "a").read_bytes(), b"old\r\n")
            self.assertTrue((folder / "link").is_symlink())
            self.assertEqual({file.name for file in folder.iterdir()}, {"a", "link"})

    def test_what_is_no_regular_file_is_written_through(self):
        with tempfile.TemporaryDirectory() as folder:
            full = pathlib.Path(folder) / "full"
            full.symlink_to("/dev/full")
            with self.assertRaises(OSError):
                whole_file.write(full, "text")
            self.assertTrue(full.is_symlink())

    def test_a_full_disk_under_the_output_is_said(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run(
                [sys.executable, "-m", "catena_report", "--compare", made.H200, made.H200],
                env={**os.environ, "PYTHONPATH": str(pathlib.Path(page.__file__).parents[1])},
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
            )
        said = "catena report: cannot write the output: No space left on device\n"
        self.assertEqual((done.returncode, done.stderr), (2, said))


class WithoutPlotly(unittest.TestCase):
    def test_static_figures_and_a_word(self):
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch(
            "catena_report.page.interactive.library", return_value=None
        ):
            run = runfile.load(made.write(folder, made.run()))
            text = page.write(report.Report([run]), pathlib.Path(folder) / "page").read_text()
        self.assertIn("python3-plotly", text)
        self.assertIn("<svg", text)
        self.assertNotIn("plotly", Parsed(text).packed)


if __name__ == "__main__":
    unittest.main()
