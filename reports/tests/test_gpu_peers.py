"""The committed figures of GPU libraries, and catena's committed times beside them, computed a second time."""
import json
import pathlib
import statistics as plain
import tempfile
import unittest
import unittest.mock

import made
import pages
from catena_report.sections import gpu_peers
from pages import recomputes

STORED = made.REPORTS / "results" / "h200_peers.json"


class Committed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stored = json.loads(STORED.read_text(encoding="utf-8"))
        cls.prose, cls.table = gpu_peers.build(None).blocks
        cls.peers = cls.table.columns[3:]

    def row(self, input_):
        scene, n = input_.split("/n:")
        (row,) = (row for row in self.table.rows if row[0].text == f"{scene}, n = {int(n):,}")
        return row

    @recomputes("table:gpu-peers")
    def test_every_figure_stands_where_it_belongs(self):
        shown = sum(cell.value is not None for row in self.table.rows for cell in row[3:])
        self.assertEqual(shown, sum(len(times) for times in self.stored["peers"].values()))
        for peer, times in self.stored["peers"].items():
            for input_, time in times.items():
                cell = self.row(input_)[3 + self.peers.index(peer)]
                self.assertEqual((cell.value, cell.kind), (time, "committed"))
                self.assertEqual(float(cell.text.removesuffix(", pairs lost").replace(",", "")), time)

    def test_catenas_own_is_the_fastest_exact_one_of_the_committed_run(self):
        run = json.loads(made.H200.read_text(encoding="utf-8"))
        described = run["catena"]["variants"]
        for input_ in {input_ for times in self.stored["peers"].values() for input_ in times}:
            timed = {}
            for row in run["benchmarks"]:
                if row["run_type"] == "iteration" and row["name"].startswith(f"{input_}/") and "/resident" in row["name"]:
                    variant = row["name"].removeprefix(f"{input_}/").partition("/resident")[0]
                    if described[variant]["exact"]:
                        timed.setdefault(variant, []).append(row["real_time"])
            _, variant, time, *_ = self.row(input_)
            if not timed:
                self.assertEqual((variant.text, time.text, time.value), ("", "", None))
                continue
            fastest = min(timed, key=lambda name: plain.median(timed[name]))
            self.assertEqual(variant.text, fastest)
            self.assertAlmostEqual(time.value, plain.median(timed[fastest]))

    def test_what_rounds_is_not_catenas_own_however_fast_it_is(self):
        run, rounded = json.loads(made.H200.read_text(encoding="utf-8")), "aGPU2+GPU2/literal"
        run["catena"]["variants"][rounded] = made.described(rounded)
        _, timed = gpu_peers.own()
        run["benchmarks"] += [
            {"name": f"{input_}/{rounded}/resident", "run_type": "iteration", "real_time": 1e-6, "time_unit": "ms"} for input_ in timed
        ]
        with tempfile.TemporaryDirectory() as folder:
            with unittest.mock.patch.object(gpu_peers, "OWN", made.write(folder, run)):
                gpu_peers.own.cache_clear()
                self.addCleanup(gpu_peers.own.cache_clear)
                self.assertEqual(gpu_peers.own()[1], timed)

    def test_it_says_whose_figures_they_are(self):
        for key in ("gpu", "driver", "cuda", "date"):
            self.assertIn(self.stored[key], self.prose.text)
        for word in ("anchors.md", "Not measured in this run"):
            self.assertIn(word, self.prose.text)
        context = json.loads(made.H200.read_text(encoding="utf-8"))["context"]
        for word in (made.H200.name, context["date"][:10], context["commit"]):
            self.assertIn(word, self.prose.text)

    def test_what_lost_pairs_says_so(self):
        marked = [row[0].text for row in self.table.rows if any("lost" in cell.text for cell in row)]
        self.assertEqual(marked, ["yarn, n = 10,000,000", "yarn, n = 100,000,000"])
        for word in ("1,120 and 6,049 of 484 million", "in 2 runs", "401 of 49 million"):
            self.assertIn(word, self.prose.text)

    def test_no_other_section_knows_them(self):
        value = made.run()
        value["context"]["gpu"] = self.stored["gpu"]  # of the same card, too
        built = pages.shown(value).sections
        (own,) = (section for section in built if section.key == "gpu-peers")
        others = str([section for section in built if section is not own])
        for peer in self.stored["peers"]:
            self.assertIn(peer, str(own))
            self.assertNotIn(peer, others)

    def test_a_page_without_the_files_has_no_section(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("PATH", "OWN"):
                with unittest.mock.patch.object(gpu_peers, name, pathlib.Path(folder) / "none.json"):
                    self.assertIsNone(gpu_peers.build(None))


if __name__ == "__main__":
    unittest.main()
