"""The committed run of cuda/roofline.py, computed a second time."""
import json
import unittest

import made
from catena_report.sections import roofline
from pages import recomputes

STORED = made.REPORTS / "results" / "h200_roofline.json"


class Committed(unittest.TestCase):
    def setUp(self):
        self.stored = json.loads(STORED.read_text(encoding="utf-8"))
        self.prose, self.table = roofline.build(None).blocks

    def test_every_kernel_that_takes_long_has_a_row(self):
        expected = []
        for run in self.stored["runs"]:
            whole = sum(kernel["us"] for kernel in run["kernels"].values())
            expected += [
                (run["input"], run["variant"], name)
                for name, kernel in run["kernels"].items()
                if kernel["us"] / whole >= 0.05
            ]
        self.assertEqual(sorted(expected), sorted(tuple(cell.text for cell in row[:3]) for row in self.table.rows))

    @recomputes("table:roofline")
    def test_shares_are_of_the_card(self):
        kernels = {(run["input"], run["variant"]): run["kernels"] for run in self.stored["runs"]}
        for row in self.table.rows:
            kernel = kernels[row[0].text, row[1].text][row[2].text]
            nearest, share = row[3].text.rsplit(", ", 1)
            carried = kernel["device_memory_bytes"] / kernel["us"] * 1e6 / self.stored["ceilings"]["copy_bytes_per_second"]
            shares = {
                "memory": 100 * carried,
                "L2": kernel["l2_percent_of_peak"],
                "instructions": kernel["issue_slots_percent"],
            }
            greatest = max(shares.values())
            self.assertLessEqual(greatest, 105, row[2].text)
            self.assertAlmostEqual(float(share.rstrip(" %")), greatest, delta=0.5)
            self.assertEqual(nearest, "latency" if greatest < 40 else max(shares, key=shares.get))

    def test_every_number_of_a_kernel_is_in_its_row(self):
        kernels = {(run["input"], run["variant"]): run["kernels"] for run in self.stored["runs"]}
        self.assertEqual(self.table.columns[4:], ["µs", "of the search", "MB", "million warp instructions", "lanes active"])
        for row in self.table.rows:
            of_search = kernels[row[0].text, row[1].text]
            kernel = of_search[row[2].text]
            numbers = [
                kernel["us"],
                kernel["us"] / sum(other["us"] for other in of_search.values()),
                kernel["device_memory_bytes"] / 1e6,
                kernel["warp_instructions"],
                kernel["lanes_active"],
            ]
            for cell, number in zip(row[4:], numbers, strict=True):
                self.assertAlmostEqual(cell.raw, number)

    def test_searches_stand_as_they_were_measured_and_their_kernels_the_longest_first(self):
        searches = [(run["input"], run["variant"]) for run in self.stored["runs"]]
        rows = [(searches.index((row[0].text, row[1].text)), -row[4].raw) for row in self.table.rows]
        self.assertEqual(rows, sorted(rows))

    def test_it_says_what_a_copy_moves(self):
        bytes_a_second = self.stored["ceilings"]["copy_bytes_per_second"]
        self.assertIn(f"moved {bytes_a_second / 1e12:.2f} TB/s", self.prose.text)

    def test_latency_is_below_forty_per_cent_of_everything(self):
        kernel = {"us": 1.0, "device_memory_bytes": 0, "l2_percent_of_peak": 20.0}
        for percent, nearest in ((40.0, "instructions"), (39.9, "latency")):
            self.assertEqual(roofline.bound({**kernel, "issue_slots_percent": percent}, 1e12), (nearest, percent / 100))

    def test_it_says_whose_card(self):
        for word in (self.stored["gpu"], self.stored["driver"], self.stored["date"]):
            self.assertIn(word, self.prose.text)

    def test_a_page_without_the_file_has_no_section(self):
        path, roofline.PATH = roofline.PATH, made.REPORTS / "results" / "none.json"
        try:
            self.assertIsNone(roofline.build(None))
        finally:
            roofline.PATH = path


if __name__ == "__main__":
    unittest.main()
