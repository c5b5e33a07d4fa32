"""Memory and the roofline, computed a second time from the rows of the run."""
import json
import statistics as plain
import unittest

import made
from catena_report import report, runfile
from catena_report.sections import memory
from pages import recomputes


class Made(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        value = json.loads(json.dumps(made.run()))
        for row in value["catena"]["memory"]:  # a sphere: 48 bytes or 80; one holds none
            n = int(row["input"].partition("n:")[2])
            row["held_bytes"] = n * (80 if row["variant"] == "aCPU2+Dual" else 48)
            if (row["input"], row["variant"]) == ("path2/n:1000", "aCPU2+Dual"):
                row["held_bytes"] = 0
            if (row["input"], row["variant"]) == ("path2/n:3000", "aCPU2+Dual"):
                row["held_bytes"] = 236 * 3000
        cls.run_ = runfile.Run("run.json", value)
        cls.sizes = {(row["input"], row["variant"]): row["held_bytes"] for row in value["catena"]["memory"]}
        blocks = memory.build(report.Report([cls.run_])).blocks
        cls.held, cls.roofline, cls.table = blocks

    def median(self, input_, variant, stage):
        return plain.median(
            row["real_time"]
            for row in self.run_.raw["benchmarks"]
            if row["name"] == f"{input_}/{variant}/{stage}/manual_time"
        )

    @recomputes("figure:memory", "table:memory")
    def test_bytes_a_sphere(self):
        drawn = {
            (f"{panel.title}/n:{n}", series.name): y * n
            for panel in self.held.panels
            for series in panel.series
            for n, y in zip(series.x, series.y)
        }
        self.assertEqual(drawn, {case: size for case, size in self.sizes.items() if size > 0})
        self.assertIn("From 48 bytes a sphere (aCPU2+CPU2) to 236 (aCPU2+Dual) over all chains", self.held.title)
        rows = {(input_, variant): numbers for input_, variant, *numbers in ([c.raw for c in row] for row in self.table.rows)}
        self.assertEqual(set(rows), set(self.sizes))
        for (input_, variant), numbers in rows.items():
            n, size = runfile.n_of(input_), self.sizes[input_, variant]
            self.assertEqual(numbers, [size / n, 64.0, size, 64 * n])

    def test_of_many_variants_those_that_hold_the_least_are_drawn_at_first(self):
        value = json.loads(json.dumps(made.run()))
        least_last = [f"aCPU2+V{k}" for k in range(memory.SHOWN + 2)][::-1]
        value["catena"]["variants"] |= {name: made.described(name) for name in least_last}
        value["catena"]["memory"] = [
            {**row, "variant": name, "held_bytes": 16 * runfile.n_of(row["input"]) * (1 + int(name.partition("V")[2]))}
            for name in least_last
            for row in value["catena"]["memory"]
            if row["variant"] == "aCPU2+CPU2"
        ]
        held = memory.build(report.Report([runfile.Run("run.json", value)])).blocks[0]
        for panel in held.panels:
            hidden = {series.name for series in panel.series if not series.shown}
            self.assertEqual(hidden, {f"aCPU2+V{memory.SHOWN}", f"aCPU2+V{memory.SHOWN + 1}"})

    @recomputes("figure:roofline")
    def test_a_stage_beside_the_copy(self):
        construction, traversal = self.roofline.panels
        for panel, stage in ((construction, "build"), (traversal, "find")):
            line = panel.series[0]
            self.assertIn(f" of {sum(len(series.x) for series in panel.series[1:])} {panel.title}", self.roofline.title)
            self.assertEqual([x / y for x, y in zip(line.x, line.y)], [10.0, 10.0])  # the median of the copies
            for series in panel.series[1:]:
                self.assertNotIn("GPU", series.name)
                points = []
                for scene in made.SCENES:
                    for n in sorted(made.SIZES, key=lambda n: f"{scene}/n:{n}"):
                        input_ = f"{scene}/n:{n}"
                        counted = next(
                            row["bytes"] for row in self.run_.list("counts")
                            if (row["input"], row["variant"]) == (input_, series.name)
                        )
                        size = 16 * n + self.sizes[input_, series.name] if stage == "build" else counted
                        points.append((size / n, self.median(input_, series.name, stage) / n))
                for x, y, (size, ns) in zip(series.x, series.y, points):
                    self.assertAlmostEqual(x, size)
                    self.assertAlmostEqual(y, ns)

    def test_what_rounds_is_not_held_against_the_copy(self):
        value = json.loads(json.dumps(made.run()))
        for key in ("memory", "counts"):
            value["catena"][key] += [
                {**row, "variant": "aCPU2+CPU2/literal"} for row in value["catena"][key] if row["variant"] == "aCPU2+CPU2"
            ]
        found = memory.traffic(runfile.Run("run.json", value))
        self.assertEqual({(variant, stage) for _, variant, stage, *_ in found}, {
            (variant, stage) for variant in ("aCPU2+CPU2", "aCPU2+Dual") for stage in ("build", "find")
        })

    def test_what_memory_does_not_bound_is_told_where_there_is_some(self):
        value = json.loads(json.dumps(self.run_.raw))
        title = lambda: memory.build(report.Report([runfile.Run("run.json", value)])).blocks[1].title  # noqa: E731
        value["catena"]["bandwidth"]["gb_s"] = [1e-6] * 8
        self.assertEqual(
            title(),
            "Memory may bound every construction and every traversal: none takes more than 2 times as long as a copy of as many bytes",
        )
        slow = next(row["name"] for row in value["benchmarks"] if row["name"].endswith("/aCPU2+CPU2/build/manual_time"))
        for row in value["benchmarks"]:
            if row["name"] == slow:
                row["real_time"] = 1e12
        self.assertRegex(title(), r"^Memory does not bound 1 of \d+ constructions: it takes more than 2 times")

    def test_without_a_copy_there_is_no_roofline(self):
        value = made.run()
        del value["catena"]["bandwidth"]
        run = runfile.Run("run.json", json.loads(json.dumps(value)))
        keys = [block.key for block in memory.build(report.Report([run])).blocks]
        self.assertEqual(keys, ["memory", "memory"])


if __name__ == "__main__":
    unittest.main()
