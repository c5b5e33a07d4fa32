"""What a run file says of a variant (`catena.variants`, written by catena). No name is taken apart here."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Stage:
    text: str  # with its settings: aGPU2@host(subtree=256)
    algorithm: str  # without executor and settings: aGPU2
    on_host: bool  # a device algorithm that the host runs
    place: str  # host or device


@dataclasses.dataclass(frozen=True)
class Variant:
    name: str
    stages: tuple  # of Stage: one, complete in itself, or construction and traversal
    arithmetic: str
    exact: bool
    peer: bool  # somebody else's library
    all_pairs: bool  # it looks at every pair: nothing is built

    @staticmethod
    def of(name, described):
        """From an entry of `catena.variants`. Throws KeyError and TypeError where it is not one."""
        keys = [field.name for field in dataclasses.fields(Stage)]
        stages = tuple(Stage(*(stage[key] for key in keys)) for stage in described["stages"])
        if not stages:
            raise TypeError("no stages")
        return Variant(name, stages, *(described[key] for key in ("arithmetic", "exact", "peer", "all_pairs")))

    @property
    def host_only(self):
        """Nothing moves between memories."""
        return all(stage.place == "host" for stage in self.stages)

    @property
    def device_only(self):
        """Chain, tree and answer can stay on the device."""
        return all(stage.place == "device" for stage in self.stages)

    @property
    def composed(self):
        return len(self.stages) == 2

    @property
    def traversal(self):
        """The stage that finds; of a variant complete in itself, the whole."""
        return self.stages[-1]

    @property
    def construction(self):
        """The stage that builds, or None."""
        return self.stages[0] if self.composed else None

    @property
    def recommended(self):
        """Advice and ranks are among these: exact, and catena's own."""
        return self.exact and not self.peer

    @property
    def rounded(self):
        """In a rounded arithmetic that the report sets against the exact one; a peer's is its own."""
        return not self.exact and not self.peer

    @property
    def algorithms(self):
        """The stages without the arithmetic."""
        return "+".join(stage.text for stage in self.stages)

    @property
    def label(self):
        """As figures and tables write it."""
        return f"{self.name} (peer)" if self.peer else self.name

    def construction_label(self):
        """The construction alone, with the arithmetic where it is rounded; of a variant complete in itself,
        the whole.
        """
        if not self.composed:
            return self.label
        return self.construction.text if self.exact else f"{self.construction.text}/{self.arithmetic}"
