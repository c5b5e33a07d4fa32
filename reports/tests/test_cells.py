"""What a cell shows is the number behind it, to the digits that are shown: CSV has the one, the page the other."""
import re
import unittest

import made
import pages

SHOWN = re.compile(r"(-?[\d,]+(?:\.(\d+))?(?:e([+-]\d+))?)( %)?")


def reading(text):
    """(the number that a text begins with, half a unit of its last digit); None where it begins with none."""
    found = SHOWN.match(text)
    if found is None:
        return None
    number, places, exponent, share = found.groups()
    unit = 10.0 ** (int(exponent or 0) - len(places or "")) * (0.01 if share else 1)
    return float(number.replace(",", "")) * (0.01 if share else 1), unit / 2


class Cells(unittest.TestCase):
    def test_what_is_shown_is_the_number_behind_it(self):
        compared = set()
        for key, table in pages.Shown(pages.of(made.run())).tables.items():
            for row in table.rows:
                for column, cell in zip(table.columns, row):
                    read = reading(cell.text)
                    if read is None or not isinstance(cell.value, (int, float)):
                        continue
                    scale = 1e6 if column.startswith("million ") else 1
                    compared.add((key, column))
                    self.assertAlmostEqual(read[0], cell.value / scale, delta=1.001 * read[1], msg=f"{key}: {column}: {cell}")
        self.assertGreater(len(compared), 80)

    def test_a_number_is_read_with_its_last_digit(self):
        for text, number, half in (
            ("1,234", 1234, 0.5),
            ("2.50 [2.45, 2.55] times", 2.5, 0.005),
            ("42 %", 0.42, 0.005),
            ("1.00e-05", 1e-5, 5e-8),
        ):
            value, delta = reading(text)
            self.assertAlmostEqual(value, number)
            self.assertAlmostEqual(delta / half, 1)
        self.assertIsNone(reading("> 99.9 %"))


if __name__ == "__main__":
    unittest.main()
