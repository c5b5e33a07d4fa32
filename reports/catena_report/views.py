"""What the views of a run file are held to (reports/run_file.md): what the viewer cannot unpack is said here, not in a
reader's browser.
"""
import base64
import binascii

ROW, PAIR = 16, 8  # bytes of a sphere, of a pair


def fault(view):
    """What is wrong with an entry of `catena.viewer`, or None."""
    frames = view.get("frames")
    if not isinstance(frames, list) or not frames or not all(isinstance(frame, dict) for frame in frames):
        return "frames is no array of one frame or more"
    named = str(view.get("input")).rpartition(":")[2]
    least = 0 if named == "0" else 1  # a chain of no spheres is said to be one, by who draws it
    for at, frame in enumerate(frames):
        if wrong := _of_frame(frame, least):
            return f"frames[{at}].{wrong}"
    for key in ("levels", "wrong"):
        rows = view.get(key) or []
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            return f"{key} is no array of objects"
    for at, level in enumerate(view.get("levels") or []):
        if not _size(level.get("spheres"), ROW):
            return f"levels[{at}].spheres is not base64 of spheres"
    for at, row in enumerate(view.get("wrong") or []):
        if not all(isinstance(row.get(key), list) for key in ("missing", "invented")):
            return f"wrong[{at}] lacks what is missing and what is invented"
    return None


def _of_frame(frame, least):
    if type(frame.get("frame")) is not int:
        return "frame is no number"
    spheres = _size(frame.get("spheres"), ROW)
    if spheres is None or spheres < least:
        return "spheres is not base64 of one sphere or more"
    if _size(frame.get("pairs", ""), PAIR) is None:
        return "pairs is not base64 of pairs"
    box = frame.get("box", [1] * 6)
    if not isinstance(box, list) or len(box) != 6 or not all(type(edge) in (int, float) for edge in box):
        return "box is no array of six numbers"
    return None


def _size(text, unit):
    """How many of so many bytes each a base64 text holds; None where it is none, or not of whole ones."""
    try:
        size = len(base64.b64decode(text, validate=True)) if isinstance(text, str) else 1
    except (binascii.Error, ValueError):
        return None
    return None if size % unit else size // unit
