"""Judged from outside: every number is shown beside the published one, and what differs is counted."""
import json
import unittest

import made
from catena_report import report, runfile
from catena_report.sections import judged
from pages import recomputes


def section_of(value):
    return judged.build(report.Report([runfile.Run("run.json", json.loads(json.dumps(value)))]))


class Judged(unittest.TestCase):
    def setUp(self):
        self.value = made.run()

    def table(self):
        return next(block for block in section_of(self.value).blocks if hasattr(block, "columns"))

    @recomputes("table:judged")
    def test_every_row_is_shown_with_what_is_published(self):
        rows = self.value["catena"]["judged"]
        self.assertEqual(len(self.table().rows), len(rows))
        for shown, row in zip(self.table().rows, rows):
            self.assertEqual(
                [cell.text for cell in shown],
                [row[key] for key in ("source", "what", "command", "published", "found")],
            )
            self.assertEqual(shown[-1].kind, "good" if row["agrees"] else "bad")

    def test_the_title_counts_what_differs(self):
        self.assertIn("1 number of 2 differs from", self.table().title)
        for row in self.value["catena"]["judged"]:
            row["agrees"] = True
        self.assertIn("All 2 numbers agree", self.table().title)

    def test_what_is_open_is_no_number_that_could_differ(self):
        row = self.value["catena"]["judged"][0]
        self.value["catena"]["judged"] = [row, {**row, "agrees": False}, {**row, "open": True}]
        self.assertEqual(
            self.table().title,
            "1 number of 2 differs from what is published; the interval of 1 other is too wide to tell",
        )

    def test_an_interval_that_holds_everything_agrees_with_nothing(self):
        row = self.value["catena"]["judged"][0]
        self.value["catena"]["judged"] = [row, {**row, "open": True}]
        self.assertEqual(
            self.table().title,
            "All 1 number agree with what is published; the interval of 1 other is too wide to tell",
        )
        self.assertEqual([row[-1].kind for row in self.table().rows], ["good", "open"])

    def test_nothing_judged_is_no_section(self):
        del self.value["catena"]["judged"]
        self.assertIsNone(section_of(self.value))


if __name__ == "__main__":
    unittest.main()
