"""How figures are drawn: labels, points under one marker, their words."""
import dataclasses
import io
import re
import unittest

import made
import matplotlib
import matplotlib.colors
import pages
from catena_report import runfile, statistics, style, variant, words
from catena_report.drawn import interactive, static
from catena_report.drawn.compact import compact
from catena_report.figure import Axis, Figure, Heat, Line, Panel, Series
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


class Legend(unittest.TestCase):
    def test_a_name_is_shown_where_any_of_its_series_is_and_a_line_without_marks_has_none(self):
        look = Look("c0", "square")
        panels = [
            Panel("", Axis("x"), Axis("y"), [Series("a", [1], [1], look, shown=shown), Series("b", [1], [1], look, markers=False)])
            for shown in (True, False)
        ]
        self.assertEqual(
            Figure("f", "", "", panels).legend(), {"a": (look, True), "b": (dataclasses.replace(look, marker=""), True)}
        )


class Ends(unittest.TestCase):
    def test_an_axis_whose_ends_are_given_shows_every_point(self):
        given = 0
        for key, figure in pages.Shown(pages.of(made.run())).figures.items():
            for panel in figure.panels:
                for axis, letter in ((panel.x, "x"), (panel.y, "y")):
                    values = [value for series in panel.series if series.shown for value in getattr(series, letter)]
                    if axis.range:
                        self.assertTrue(axis.range[0] <= min(values) and max(values) <= axis.range[1], (key, panel.title))
                        given += 1
        self.assertGreater(given, 3)

    def test_an_axis_of_two_decades_is_logarithmic(self):
        decades = 0
        for key, figure in pages.Shown(pages.of(made.run())).figures.items():
            for panel in figure.panels:
                for axis, letter in ((panel.x, "x"), (panel.y, "y")):
                    values = [value for series in panel.series for value in getattr(series, letter) if value > 0]
                    if axis.categories is None and values and max(values) >= 100 * min(values):
                        self.assertTrue(axis.log, (key, panel.title, letter))
                        decades += 1
        self.assertGreater(decades, 20)


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
        self.assertEqual({looks.variant(one).colour for one in variants[:14]}, set(style.COLOURS))


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


class Drawn(unittest.TestCase):
    """What is drawn, by matplotlib and for plotly, is what the figure holds: points, the bars around them, cells."""

    def figure(self, across, log=True):
        return Figure(
            "k", "", "",
            [
                Panel(
                    "p",
                    Axis("x", log=log),
                    Axis("y", log=log),
                    [
                        Series("a", [1, 10, 100], [2, 3, 5], Look("c0"), low=[0.5, 1, 4], high=[3, 30, 300], across=across,
                               chains=[{"input": str(k)} for k in range(3)], hover=["h0", "h1", "h2"]),
                        Series("b", [2, 20], [7, 1], Look("c1", "square", "dot", True), shown=False),
                    ],
                ),
                Panel("q", Axis("x"), Axis("y"), [Series("b", [2], [7], Look("c1", "square", "dot", True), line=False)]),
            ],
        )  # fmt: skip

    def test_matplotlib_has_points_and_bars(self):
        for across in (False, True):
            first, second = static.draw(self.figure(across)).axes
            found = {line.get_gid(): line for line in first.lines}
            self.assertEqual(set(found), {"series-0-0"})  # b waits in the legend
            (drawn,) = found.values()
            self.assertEqual((list(drawn.get_xdata()), list(drawn.get_ydata())), ([1, 10, 100], [2, 3, 5]))
            (bars,) = [c for c in first.collections if c.get_gid() == "series-0-0-spread"]
            ends = [segment[:, 0 if across else 1].tolist() for segment in bars.get_segments()]
            centre = [1, 10, 100] if across else [2, 3, 5]
            for (low, high), middle, low_end, high_end in zip(ends, centre, (0.5, 1, 4), (3, 30, 300)):
                self.assertAlmostEqual(low, min(low_end, middle))
                self.assertAlmostEqual(high, max(high_end, middle))
            self.assertEqual((first.get_xscale(), second.get_xscale()), ("log", "linear"))

    def test_svg_says_once_how_the_marks_of_a_series_look_and_turns_no_text_by_nothing(self):
        """Both were a tenth of a page that has to stay small enough for a browser."""
        text = static.svg(static.draw(self.figure(False)), "k")
        uses = re.findall(r"<use [^>]*>", text[text.index('id="k-series-0-0"'):])[:3]
        self.assertEqual(len(uses), 3)
        self.assertFalse(any("style" in use for use in uses), uses)
        self.assertRegex(text, r'<g clip-path="[^"]*" style="fill: #[^"]*">\s*<use ')
        self.assertNotIn("rotate(-0", text)
        self.assertIn("rotate(-90", text)

    def test_what_is_written_in_fewer_words_is_the_same_drawing(self):
        whole = io.StringIO()
        with matplotlib.rc_context(static.RC):
            static.draw(self.figure(True)).savefig(whole, format="svg")
        whole, small = whole.getvalue(), compact(whole.getvalue())
        self.assertLess(len(small), 0.8 * len(whole))

        def drawn(text):
            """All lines in their order, all marks and all words; numbers to a hundredth."""
            text = re.sub(r"(\d\.\d{2})\d+", r"\1", text)
            lines = " ".join(re.findall(r' d="([^"]*)"', text)).split()
            return lines, re.findall(r'<use [^>]*? (x="[^"]*" y="[^"]*")', text), re.findall(r">([^<>]+)</text>", text)

        for before, after in zip(drawn(whole), drawn(small)):
            self.assertTrue(before)
            self.assertEqual(before, after)
        for name in re.findall(r'(?:href="#|url\(#)([^")]*)', small):
            self.assertIn(f' id="{name}"', small)
        self.assertEqual(re.findall(r'\bid="(series[^"]*)"', small), re.findall(r'\bid="(series[^"]*)"', whole))

    def test_plotly_has_points_and_bars(self):
        for across in (False, True):
            described = interactive.describe(self.figure(across))
            first, second = described["panels"]
            a, b = first["data"]
            self.assertEqual((a["x"], a["y"], a["text"]), ([1, 10, 100], [2, 3, 5], ["h0", "h1", "h2"]))
            self.assertEqual([a["visible"], b["visible"], second["data"][0]["visible"]], [True, "legendonly", True])
            self.assertEqual([chain["input"] for chain in a["customdata"]], ["0", "1", "2"])
            bars, centre = (a["error_x"], a["x"]) if across else (a["error_y"], a["y"])
            self.assertEqual({"error_x", "error_y"} & set(a), {"error_x" if across else "error_y"})
            for middle, up, down, low, high in zip(centre, bars["array"], bars["arrayminus"], (0.5, 1, 4), (3, 30, 300)):
                self.assertEqual((middle - down, middle + up), (min(low, middle), max(high, middle)))
            axes = [panel["layout"][axis]["type"] for panel in (first, second) for axis in ("xaxis", "yaxis")]
            self.assertEqual(axes, ["log", "log", "linear", "linear"])

    def test_marks_lie_where_they_are_and_axes_reach_as_far_as_asked(self):
        lines = [Line(2.0), Line(3.0, across=True), Line(4.0, to=6.0)]
        series = [Series("a", [1, 10], [2, 10], Look("c0", "square", "solid", True), labels=["one", ""])]
        panel = Panel("", Axis("x", range=(0, 20)), Axis("y", log=True, range=(0.1, 1000)), series, lines=lines)
        rows = Panel("", Axis("x"), Axis("", categories=["top", "mid", "low"]), [Series("a", [5], [0], Look("c0"))])
        figure = Figure("k", "", "", [panel, rows])
        ax, other = static.draw(figure).axes
        drawn = [[list(line.get_xdata()), list(line.get_ydata())] for line in ax.lines if line.get_gid() is None]
        self.assertEqual(drawn, [[[2.0, 2.0], [0, 1]], [[0, 1], [3.0, 3.0]]])
        self.assertEqual((ax.get_xlim(), ax.get_ylim()), ((0, 20), (0.1, 1000)))
        top, bottom = other.get_ylim()
        self.assertGreater(top, bottom)  # the first row is at the top
        (points,) = [line for line in ax.lines if line.get_gid()]
        self.assertEqual(matplotlib.colors.to_hex(points.get_markerfacecolor()), style.LIGHT["paper"])
        (said,) = [text for text in ax.texts if text.get_text() == "one"]
        self.assertEqual(said.xy, (1, 2))

        layout, of_rows = (one["layout"] for one in interactive.describe(figure)["panels"])
        marks = [[shape[key] for key in ("type", "x0", "x1", "y0", "y1")] for shape in layout["shapes"]]
        self.assertEqual(marks, [["line", 2.0, 2.0, 0, 1], ["line", 0, 1, 3.0, 3.0], ["rect", 4.0, 6.0, 0, 1]])
        self.assertEqual([(shape.get("xref"), shape.get("yref")) for shape in layout["shapes"]],
                         [(None, "paper"), ("paper", None), (None, "paper")])
        self.assertEqual((layout["xaxis"]["range"], layout["yaxis"]["range"]), ([0, 20], [-1, 3]))
        self.assertEqual(of_rows["yaxis"]["range"], [2.5, -0.5])
        self.assertEqual(interactive.describe(figure)["panels"][0]["data"][0]["marker"]["symbol"], "square-open")
        self.assertEqual(interactive.describe(figure)["panels"][1]["data"][0]["marker"]["symbol"], "circle")

    def test_the_word_of_a_mark_stands_at_it(self):
        """Plotly takes the place of a word as a logarithm where the axis is one, and that of a mark as it is."""
        for log, place in ((True, 2), (False, 100)):
            axes = Axis("x", log=log), Axis("y", log=log)
            for line, along in ((Line(100, label="aim"), "x"), (Line(100, across=True, label="aim"), "y")):
                layout = interactive._layout(Panel("", *axes, [Series("a", [1, 1000], [1, 1000], Look("c0"))], lines=[line]))
                (shape,), (word,) = layout["shapes"], layout["annotations"]
                self.assertEqual((shape[f"{along}0"], word[along], word["text"]), (100, place, "aim"))

    def test_the_legend_has_each_name_once_shown_where_it_is_anywhere(self):
        figure = self.figure(False)
        self.assertEqual({name: shown for name, (_, shown) in figure.legend().items()}, {"a": True, "b": True})
        figure.panels.pop()
        self.assertEqual({name: shown for name, (_, shown) in figure.legend().items()}, {"a": True, "b": False})
        entries = {entry["name"]: entry for entry in interactive.describe(figure)["legend"]}
        self.assertEqual([entries[n]["shown"] for n in "ab"], [True, False])
        b = entries["b"]
        self.assertEqual([b[key] for key in ("colour", "marker", "dash", "hollow")], ["c1", "square", "dot", True])

    def test_every_cell_has_the_colour_of_its_category(self):
        values = [[0, 0, 1, None, 0], [2, 2, 2, 2, 2], [None, 1, 0, 1, 1], [None] * 5]
        categories = [("good", "good"), ("bad", "bad"), ("open", "warn")]
        heat = Heat(values, categories, [[""] * 5] * 4)
        panel = Panel("", Axis("", categories=list("abcde")), Axis("", categories=list("uvwx")), heat=heat)
        (ax,) = static.draw(Figure("k", "", "", [panel])).axes
        colours = [matplotlib.colors.to_hex(style.LIGHT[colour]) for _, colour in categories]
        for row, cells in enumerate(values):
            for column, value in enumerate(cells):
                at = [
                    colours.index(matplotlib.colors.to_hex(patch.get_facecolor()))
                    for patch in ax.patches
                    if any(inside(polygon, column, row) for polygon in patch.get_path().to_polygons())
                ]
                self.assertEqual(at, [] if value is None else [value], (row, column))
        (trace,) = interactive.describe(Figure("k", "", "", [panel]))["panels"][0]["data"]
        self.assertEqual(trace["z"], values)
        span = trace["zmax"] - trace["zmin"]
        for value, (_, colour) in enumerate(categories):
            place = (value - trace["zmin"]) / span
            ends = [at for at, name in trace["colorscale"] if name == f"var(--{colour})"]
            self.assertTrue(min(ends) < place < max(ends))

    def test_a_tick_is_as_large_as_it_says(self):
        units = {"G": 1e9, "M": 1e6, "k": 1e3}
        for power in range(-8, 12):
            for digit in (1, 2, 5):
                text = static.short(digit * 10.0**power)
                value = float(text[:-1]) * units[text[-1]] if text[-1] in units else float(text)
                if digit == 1 or power >= -4:  # below, ticks are at powers alone
                    self.assertAlmostEqual(value / (digit * 10.0**power), 1)


def inside(polygon, x, y):
    return polygon[:, 0].min() < x < polygon[:, 0].max() and polygon[:, 1].min() < y < polygon[:, 1].max()


class Alternative(unittest.TestCase):
    def test_it_tells_where_curves_begin_and_end(self):
        panel = Panel("path1", Axis("n", log=True), Axis("ms"), [Series("a", [10, 20, 30], [1, 2, 4.5], Look("c0"))])
        text = Figure("k", "", "", [panel]).alternative()
        self.assertEqual(text, "path1: ms over n. a from 1 at 10 to 4.5 at 30.")
        panel.series.append(Series("hidden", [10], [7], Look("c1"), shown=False))
        panel.x.categories = [str(k) for k in range(31)]
        self.assertEqual(Figure("k", "", "", [panel]).alternative(), text)

    def test_of_a_map_how_many_cells_are_what(self):
        heat = Heat([[0, 1], [None, 1]], [("good", "c0"), ("bad", "c1")], [["", ""], ["", ""]])
        panel = Panel("", Axis("", categories=["x", "y"]), Axis("", categories=["u", "v"]), heat=heat)
        self.assertEqual(Figure("k", "", "", [panel]).alternative(), "Map: of 3 cells 1 good; 2 bad.")


if __name__ == "__main__":
    unittest.main()
