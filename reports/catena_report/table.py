"""A table, and the two files it becomes: CSV with every digit, LaTeX (booktabs) as shown."""
import csv
import dataclasses
import io
import re


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
        writer.writerow(self.columns)
        writer.writerows([cell.raw for cell in row] for row in self.rows)
        return text.getvalue()

    def markdown(self):
        lines = [self.columns, ["---"] * self.words + ["---:"] * (len(self.columns) - self.words)]
        lines += [
            [f"*{cell.text}*" if "paper" in cell.kind and cell.text else cell.text for cell in row]
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
