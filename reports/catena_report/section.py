"""A section of the page: prose, figures and tables under one heading."""
import dataclasses


@dataclasses.dataclass
class Prose:
    """A paragraph; `points` follow as a list. May hold <code> and <strong>; what comes from data is escaped
    by its maker.
    """

    text: str
    points: list = dataclasses.field(default_factory=list)
    folded: bool = False  # the list opens on a click


@dataclasses.dataclass
class Heading:
    text: str


@dataclasses.dataclass
class Code:
    text: str
    note: str = ""


@dataclasses.dataclass
class Section:
    key: str
    title: str
    blocks: list = dataclasses.field(default_factory=list)  # Prose, Heading, Code, Figure, Table, Raw
    lead: str = ""


@dataclasses.dataclass
class Raw:
    """HTML that a section made itself."""

    html: str
