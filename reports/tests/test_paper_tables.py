"""The paper's Tables 3 and 4 beside the medians of the stored run, a plain file of Google Benchmark."""
import json
import re
import statistics as plain
import unittest

import made
import pages
from catena_report import paper
from pages import recomputes


class H200(unittest.TestCase):
    """The stored run: a plain file of Google Benchmark."""

    value = json.loads(made.H200.read_text())

    @classmethod
    def setUpClass(cls):
        cls.shown = pages.shown(cls.value)

    def test_sections_without_data_are_left_out(self):
        self.assertEqual(
            {section.key for section in self.shown.sections}
            & {"stability", "work-precision", "counts", "animation", "motion", "savings"},
            set(),
        )

    @recomputes("table:path1", "table:path2")
    def test_tables_hold_the_paper_and_the_medians(self):
        printed = paper.tables()
        for path in paper.TABLES:
            head, rows = self.shown.tables[path].columns, self.shown.rows(path)
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
                            for row in self.value["benchmarks"]
                            if row["run_type"] == "iteration"
                            and row["name"].removesuffix("/manual_time")
                            in [f"{path}{frames}/n:{n}/{variant}/{stage}" for frames in ("", ":frames=all")]
                        ]
                        self.assertAlmostEqual(float(cell) / plain.median(times), 1, delta=0.006)
                        seen += 1
            self.assertGreater(seen, 40)


class EveryKeyframe(H200):
    """The same, timed through the whole animation, as `catena report --paper` does."""

    value = json.loads(re.sub(r'"(path[12])/n:', r'"\1:frames=all/n:', made.H200.read_text()))


if __name__ == "__main__":
    unittest.main()
