"""A section of the page: prose, figures and tables under one heading."""
import dataclasses
import re


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


def link(section, text):
    """The text, as a way to the section of that key."""
    return f'<a href="#{section}"><strong>{text}</strong></a>'


LINK = re.compile(r'<a href="#([^"]*)">(.*?)</a>')


def without_dead_links(built):
    """The sections, in whose prose what is said of a section that a page has not is no link."""
    keys = {section.key for section in built}
    alive = lambda text: LINK.sub(lambda found: found[0] if found[1] in keys else found[2], text)  # noqa: E731
    for section in built:
        for block in section.blocks:
            if isinstance(block, Prose):
                block.text, block.points = alive(block.text), [alive(point) for point in block.points]
    return built


@dataclasses.dataclass
class Raw:
    """HTML that a section made itself."""

    html: str
