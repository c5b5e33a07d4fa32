"""How figures are drawn: labels, points under one marker, their words."""
import unittest

import made
from catena_report import runfile, statistics, style, variant, words
from catena_report.drawn import interactive, static
from catena_report.figure import Axis, Figure, Heat, Panel, Series
from catena_report.style import Look


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


class Told(unittest.TestCase):
    def test_an_interval_keeps_its_digits_where_it_is_small_and_is_none_of_one_sample(self):
        for (value, low, high), text in (
            ((1.02, 0.98, 1.06), "1.02 [0.98, 1.06]"),
            ((0.0013, 0.0005, 0.0021), "0.00130 [0.000500, 0.00210]"),
            ((250, 99, 300), "250 [99.0, 300]"),
            ((-0.03, -0.07, 0.01), "-0.03 [-0.07, 0.01]"),
            ((64.31, 64.31, 64.31), "64.3"),
        ):
            self.assertEqual(words.interval(statistics.Interval(value, low, high)), text)

    def test_no_two_variants_of_one_arithmetic_look_alike(self):
        run = runfile.load(made.REPORTS / "results" / "h200_quick.json.gz")
        names = [f"v{at}" for at in range(14)]  # more than colours
        variants = [variant.Variant.of(name, made.described(name)) for name in names]
        variants += [run.info(name) for name in run.variants()]
        looks = style.Looks(variants)
        drawn = [looks.variant(one) for one in variants if not one.peer and not one.composed]
        self.assertEqual(len(drawn), len(set(drawn)))


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


if __name__ == "__main__":
    unittest.main()
