"""Rows of a run file as columns, which packs them in two thirds of the size: what the rows of one shape have under a key
lies together. reports/catena_report/assets/report.js makes rows of them again.
"""
import json


def of_rows(rows):
    """{"shapes": the different lists of keys, "shape": that of each row, by its place among them, "columns": of each shape,
    of each key the values; or, where they are those of an earlier key, the place of that key}.
    """
    places = {}
    shape = [places.setdefault(tuple(row), len(places)) for row in rows]
    columns = []
    for keys, place in places.items():
        mine = [row for row, its in zip(rows, shape) if its == place]
        values = [[row[key] for row in mine] for key in keys]
        said = [json.dumps(column) for column in values]  # 1 is not true, nor 1.0
        columns.append([first if (first := said.index(text)) < at else values[at] for at, text in enumerate(said)])
    return {"shapes": [list(keys) for keys in places], "shape": shape, "columns": columns}
