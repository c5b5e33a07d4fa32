"""What a point tells under the pointer, and a sentence of its numbers: each by its name and in its unit, of runs without noise."""
import statistics as plain
import unittest

import made
import pages
from catena_report import report, statistics, waits, words
from catena_report.sections import advice, arithmetic, motion, stability
from test_stability import LINE


class Hovered(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        value = made.run(repetitions=6, noise=0)
        # One variant was not timed on one of the eight chains.
        value["benchmarks"] = [row for row in value["benchmarks"] if not row["name"].startswith("path1/n:1000/aCPU2+Dual/")]
        for point in value["catena"]["work_precision"]["points"]:
            if point["variant"] == "GPU1":
                point.update(answer_error=0.07)
        cls.shown = pages.shown(value)

    def told(self, figure, panel):
        return [text for series in self.shown.figures[figure].panels[panel].series for text in series.hover or []]

    def test_a_click_shows_the_chain_that_the_text_names(self):
        figures = set()
        for key, figure in self.shown.figures.items():
            for series in (series for panel in figure.panels for series in panel.series):
                for text, chain in zip(series.hover or [], series.chains or []):
                    if "/n:" in text:
                        self.assertIn(chain["input"], text.replace(", ", "<br>").split("<br>"))
                        if key in ("advice", "counts", "times-find"):
                            self.assertTrue(chain["command"].endswith(f" --variant {series.name}"), chain)
                        figures.add(key)
        self.assertLessEqual({"advice", "counts", "times-build", "times-find"}, figures)

    def test_held_and_peak(self):
        said = "<b>aCPU2+CPU2</b><br>path1/n:1000<br>48.0 bytes a sphere held, 48,000 in all; peak 64,000"
        self.assertIn(said, self.told("memory", 0))

    def test_a_stage_as_a_share_of_the_copy(self):
        """64 bytes in 100 ns, where a copy moves 10 a nanosecond."""
        said = "<b>aCPU2+CPU2</b><br>path1/n:1000<br>64 bytes and 100 ns a sphere: 0.64 GB/s, 6% of the copy"
        self.assertIn(said, self.told("roofline", 0))

    def test_an_error_beside_its_time(self):
        said = (
            "<b>aCPU2+CPU2</b><br>helix, n = 1,000<br>0.880 ms, quartiles 0.800 to 0.960 ms<br>error of the tube 1.00e-02,"
            " of storing 0.0e+00 radii<br>of the answer: 0 % of the pairs wrong"
        )
        self.assertIn(said, self.told("work-precision", 0))
        self.assertTrue(all(text.endswith("of the answer: 7 % of the pairs wrong") for text in self.told("work-precision", 1)))

    def test_a_chain_and_how_long_its_fastest_takes(self):
        self.assertIn("<b>aGPU2+GPU2</b><br>path1/n:1000, 0.045 pairs a sphere<br>0.120 ms", self.told("advice", 0))

    def test_how_long_is_the_median(self):
        run = pages.of(made.run(repetitions=6))
        timed, seen = waits.end_to_end(run), 0
        for series in advice.build(report.Report([run])).blocks[1].panels[0].series:
            for text in series.hover or []:
                leader, chain, time = text.replace("<b>", "").replace("</b>", "").split("<br>")[:3]
                times = timed[chain.partition(",")[0]][leader]
                self.assertNotEqual(words.duration(plain.median(times)), words.duration(max(times)))
                self.assertEqual(time, words.duration(plain.median(times)))
                seen += 1
        self.assertEqual(seen, len(made.INPUTS))

    def test_a_time_is_of_so_many_repetitions(self):
        told = self.told("times-find", 0)
        self.assertTrue(told and all(", 6 repetitions<br>" in text for text in told), told)
        self.assertIn("<b>aCPU2+CPU2</b><br>path1/n:10000<br>8.00 [8.00, 8.00] ms, 6 repetitions<br>800 ns a sphere", told)

    def test_a_spacing_and_its_error(self):
        said = "<b>helix</b><br>n = 1,000, spacing 0.1<br>gap, tube radii 0.002"
        self.assertIn(said, self.told("tube-errors", 0))

    def test_the_share_is_of_all_chains(self):
        (series,) = (s for s in self.shown.figures["slowdown"].panels[0].series if s.name == "aCPU2+Dual")
        self.assertTrue(series.hover[-1].startswith("<b>aCPU2+Dual</b><br>88 % of chains within"), series.hover[-1])
        for factor, text in zip(series.x, series.hover, strict=True):
            self.assertTrue(text.endswith(f" of chains within {factor:.3g} times"), text)

    def test_what_stays_on_the_device_is_told_by_its_least_time(self):
        self.assertIn("aGPU2+GPUv2 for 1,000 to 100,000 spheres (path1 and path2), 0.0700 ms and more.", self.shown.prose)

    def test_missing_and_invented_of_an_arithmetic(self):
        line = {**LINE, "scene": "far:exponent=9", "missing": 1, "invented": 2, "worst_margin": 0.25}
        self.assertEqual(
            arithmetic._bite("literal", line),
            "<b>literal</b>: aCPU2+CPU2/literal<br>far:exponent=9<br>1 missing, 2 invented of 3 pairs<br>worst margin 0.25",
        )

    def test_a_case_of_the_stability_matrix(self):
        line = {**LINE, "outcome": "wrong", "reason": "largest margin", "missing": 1, "invented": 2, "worst_margin": 0.25}
        said = "<b>aCPU2+CPU2/literal</b><br>far:n=5<br>wrong: largest margin"
        self.assertEqual(stability._hover(line), said + "<br>1 missing, 2 invented of 3 pairs<br>worst margin 0.25")
        self.assertEqual(stability._hover({**line, "missing": 0, "invented": 0}), said)

    def test_a_share_of_starts_with_its_interval(self):
        self.assertEqual(motion._percent(statistics.Interval(0.5, 0.25, 0.75)), "50 % [25, 75]")

    def test_a_motion(self):
        said = (
            "<b>aCPU2+Dual</b><br>stiffness 100, step 2<br>slipped at time 72<br>energy drift 2, penetration 0.2<br>300 contacts,"
            " 0 missed and 0 invented by the variant<br>50.0 ms"
        )
        (panel,) = self.shown.figures["motion-outcome"].panels
        self.assertIn(said, [text for texts in panel.heat.hover for text in texts])
        self.assertIn("contacts of the motion with step 0.1 that", self.shown.tables["motion"].caption)


if __name__ == "__main__":
    unittest.main()
