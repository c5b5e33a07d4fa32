"""Rows as columns, and back: what a page carries of a run is the run."""
import json
import unittest

import made
import pages
from catena_report import columns


class Columns(unittest.TestCase):
    def back(self, rows):
        return pages.rows_of(json.loads(json.dumps(columns.of_rows(rows))))

    def test_rows_of_several_shapes_keep_their_order_and_keys(self):
        rows = [{"a": 1, "b": "x"}, {"b": "y", "a": 2}, {"a": 3}, {"a": 4, "b": None}, {}, {"a": [5], "b": {"c": 6}}]
        self.assertEqual([list(row.items()) for row in self.back(rows)], [list(row.items()) for row in rows])
        self.assertEqual(self.back([]), [])

    def test_what_two_keys_have_in_common_is_said_once(self):
        rows = [{"name": f"case {at}", "n": at, "run_name": f"case {at}"} for at in range(3)]
        self.assertEqual(columns.of_rows(rows)["columns"], [[["case 0", "case 1", "case 2"], [0, 1, 2], 0]])

    def test_one_is_neither_true_nor_a_float(self):
        (row,) = self.back([{"a": 1, "b": True, "c": 1.0}])
        self.assertEqual([type(value) for value in row.values()], [int, bool, float])

    def test_a_run_of_a_device_comes_back(self):
        rows = json.loads(made.H200.read_text(encoding="utf-8"))["benchmarks"]
        self.assertTrue(self.back(rows) == rows)
        plain, packed = (len(json.dumps(value)) for value in (rows, columns.of_rows(rows)))
        self.assertLess(packed, plain / 2)


if __name__ == "__main__":
    unittest.main()
