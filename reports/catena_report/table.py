"""A table, and the two files it becomes: CSV with every digit (what says more than one number as its text, with
that number in a column beside it), LaTeX (booktabs) as shown.
"""
import csv
import dataclasses
import io
import re

# A number and nothing else but a sign, a unit or how it is counted.
ALONE = re.compile(r"[-+−<>~ ]*[\d.,]+(?:e[-+]?\d+)? ?(?:%|ms|µs|s|times)?")


@dataclasses.dataclass
class Cell:
    """What is shown, and the number behind it where there is one. `kind` is a CSS class: paper, best, good,
    bad, ...
    """

    text: str
    value: object = None
    kind: str = ""
    hint: str = ""

    @property
    def raw(self):
        return self.text if self.value is None else self.value

    @property
    def worded(self):
        """Whether the text says more than the number: an interval, a range, a name."""
        return self.value is not None and not ALONE.fullmatch(self.text)


@dataclasses.dataclass
class Table:
    key: str
    title: str
    caption: str
    columns: list
    rows: list  # of lists of Cell or str
    words: int = 1  # the first so many columns are words, the others numbers

    def __post_init__(self):
        self.rows = [
            [cell if isinstance(cell, Cell) else Cell(str(cell)) for cell in row] for row in self.rows
        ]

    def as_csv(self):
        text = io.StringIO(newline="")
        writer = csv.writer(text)
        worded = [any(cell.worded for cell in column) for column in zip(*self.rows)] or [False] * len(self.columns)
        writer.writerow(_beside(worded, ((name, f"{name}: number") for name in self.columns)))
        for row in self.rows:
            told = ((cell.text, cell.value) if is_worded else (cell.raw, None) for is_worded, cell in zip(worded, row))
            writer.writerow(_beside(worded, told))
        return text.getvalue()

    def markdown(self):
        lines = [list(map(plain, self.columns)), ["---"] * self.words + ["---:"] * (len(self.columns) - self.words)]
        lines += [
            [f"*{plain(cell.text)}*" if "paper" in cell.kind and cell.text else plain(cell.text) for cell in row]
            for row in self.rows
        ]
        return "".join("| " + " | ".join(line) + " |\n" for line in lines)

    def as_latex(self):
        align = "l" * self.words + "r" * (len(self.columns) - self.words)
        lines = [
            r"\begin{table}",
            r"\centering",
            rf"\caption{{{latex(self.title)}}}",
            rf"\label{{tab:{self.key}}}",
            rf"\begin{{tabular}}{{{align}}}",
            r"\toprule",
            " & ".join(map(latex, self.columns)) + r" \\",
            r"\midrule",
        ]
        for row in self.rows:
            cells = [
                rf"\emph{{{latex(cell.text)}}}" if "paper" in cell.kind and cell.text else latex(cell.text)
                for cell in row
            ]
            lines.append(" & ".join(cells) + r" \\")
        lines += [r"\bottomrule", r"\end{tabular}", r"\end{table}", ""]
        return "\n".join(lines)


def _beside(worded, pairs):
    """Both of each pair where the column is worded, else the first."""
    return [value for both, pair in zip(worded, pairs) for value in (pair if both else pair[:1])]


def plain(text):
    """Text as Markdown shows it in a cell: a name may hold what parts cells, begins HTML or slants."""
    return re.sub(r"[\\|<>&*_`]", lambda found: ESCAPED.get(found[0], "\\" + found[0]), text)


ESCAPED = {"<": "&lt;", ">": "&gt;", "&": "&amp;"}
SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "±": r"$\pm$",
    "≤": r"$\le$",
    "≥": r"$\ge$",
    "×": r"$\times$",
    "–": "--",
    "—": "---",
    "²": r"$^2$",
    "−": r"$-$",
    "<": r"$<$",
    ">": r"$>$",
    "…": r"\dots{}",
    "√": r"$\sqrt{}$",
    "·": r"$\cdot$",
    **{c: "\\" + c for c in "&%$#_{}"},
}


def latex(text):
    """Text as LaTeX shows it."""
    return re.sub(r"[\\~^±≤≥×–—²−<>…√·&%$#_{}]", lambda match: SPECIAL[match[0]], text)
