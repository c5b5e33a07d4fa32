"""Steps a sphere, computed a second time from the rows of the run."""
import json
import statistics as plain
import unittest

import made
from catena_report import report, runfile
from catena_report.sections import steps
from pages import recomputes


class Made(unittest.TestCase):
    def setUp(self):
        self.value = made.run()

    def table(self):
        run = runfile.Run("run.json", json.loads(json.dumps(self.value)))
        (table,) = steps.build(report.Report([run])).blocks
        return run, table

    @recomputes("table:steps")
    def test_a_sphere_takes_its_share(self):
        self.value["catena"]["steps"][-1]["steps"].append({"step": "visits", "times": 5})  # of one search alone
        run, table = self.table()
        self.assertEqual(table.columns[5:], ["rows", "tests", "visits"])
        self.assertEqual(len(table.rows), len(run.list("steps")))
        for row in table.rows:
            input_, variant = row[0].text, row[1].text
            n = int(input_.split(":")[1])
            given = next(r for r in run.list("steps") if (r["input"], r["variant"]) == (input_, variant))
            times = [
                r["real_time"] for r in run.raw["benchmarks"] if r["name"] == f"{input_}/{variant}/find/manual_time"
            ]
            ns = plain.median(times) / n
            self.assertAlmostEqual(row[2].raw, ns)
            self.assertAlmostEqual(row[3].raw, ns * 10.0 / 32)  # 10 bytes a ns, 16 read and 16 written
            self.assertAlmostEqual(row[4].raw, given["pairs"] / n)
            taken = {step["step"]: step["times"] for step in given["steps"]}
            self.assertEqual([cell.raw for cell in row[5:]], [taken[s] / n if s in taken else "" for s in table.columns[5:]])

    def test_rows_are_by_scene_size_and_variant(self):
        self.value["catena"]["steps"].reverse()
        _, table = self.table()
        inputs = [row[0].text.split(":") for row in table.rows]
        keys = [(scene, int(n), row[1].text) for (scene, n), row in zip(inputs, table.rows)]
        self.assertGreater(len({n for _, n, _ in keys}), 1)
        self.assertEqual(keys, sorted(keys))

    def test_the_title_says_how_many_memory_bounds(self):
        for gb_s, says in (
            (10.0, "Memory bounds none of 16 searches: in the time of each the chain could be copied"),
            (4.0, "Memory bounds"),
            (0.001, "Memory bounds all 16 searches"),
        ):
            self.value["catena"]["bandwidth"]["gb_s"] = [gb_s] * 6
            _, table = self.table()
            self.assertIn(says, table.title)
            bound = sum(row[3].raw < 2 for row in table.rows)
            self.assertIn(f"bounds {'all' if bound == 16 else bound or 'none'} ", table.title)

    def test_without_a_copy_only_steps_are_told(self):
        del self.value["catena"]["bandwidth"]
        _, table = self.table()
        self.assertEqual({row[3].raw for row in table.rows}, {""})
        self.assertNotIn("Memory bounds", table.title)

    def test_no_steps_no_section(self):
        del self.value["catena"]["steps"]
        run = runfile.Run("run.json", json.loads(json.dumps(self.value)))
        self.assertIsNone(steps.build(report.Report([run])))


if __name__ == "__main__":
    unittest.main()
