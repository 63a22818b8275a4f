"""The catalogue of causes as `omni-gap explain` tells it: nothing of it is written down a second time.

An effect has parameters that size it, that shape it, or that are held; a parameter cause is a set of the robot file's own
numbers that are wrong by a common factor (or, friction, one factor an axis).
"""

import re
import tomllib
from dataclasses import dataclass

from peers.mistakes import Mistake

# Stages of the parameter causes, which `explain` does not name.
PARAMETER_STAGES = {
    "resistance": "electrical",
    "torque_constant": "electrical",
    "kt_over_kv": "drivetrain",
    "wheel_radius": "contact",
    "center_distance": "contact",
}

SIZES, SHAPES, HELD = "sizes", "shapes", "held"


@dataclass(frozen=True)
class Parameter:
    """A number of a cause: what it is where the cause is absent, at its typical size, and between what bounds."""

    key: str
    role: str
    absent: float
    typical: float
    low: float
    high: float


@dataclass(frozen=True)
class Cause:
    """A cause of the catalogue. `keys` are the robot file's own numbers, as (table, key), of a parameter cause."""

    id: str
    kind: str
    stage: str
    parameters: tuple
    one_wheel: bool = False
    any_wheel: bool = False
    keys: tuple = ()

    def role(self, role):
        """The parameters of a role."""
        return [one for one in self.parameters if one.role == role]


def number(text):
    """A number as the program prints it, with a typographic minus."""
    return float(text.replace("−", "-"))


def catalogue(tool):
    """All causes, effects first."""
    listed = tool.explain()
    effects, _, parameters = listed.partition("\nParameters ")
    ids = re.compile(r"^  ([a-z][a-z0-9_]*) ", re.MULTILINE)
    causes = [effect(tool.explain(name)) for name in ids.findall(effects)]
    causes += [parameter_cause(tool.explain(name)) for name in ids.findall(parameters)]
    if len(causes) < 2:
        raise Mistake("omni-gap explain lists no causes; its output is not the one that the peers know")
    return causes


def effect(text):
    """An effect from its explanation."""
    head = re.match(r"([a-z0-9_]+): .*\((\w+) stage\)", text)
    shown = text.partition("To have it in a robot file (typical sizes)\n")[2]
    lines = [line.strip() for line in shown.splitlines() if line.strip()]
    example = tomllib.loads("\n".join(line for line in lines if not line.startswith("(")))
    table = example["effects"][head[1]]
    single = isinstance(table, list)
    typical = table[0] if single else table
    parameters = tuple(numbers(text, typical))
    return Cause(head[1], "effect", head[2], parameters, single, "for one wheel write" in text)


def numbers(text, typical):
    """The parameters of an effect: bounds and roles from the text, typical values from the example."""
    stated = re.compile(r"^  (\w+): [^\n]*?, (sizes|shapes)([^\n]*)\n      ([^\n]*)", re.MULTILINE)
    for key, role, more, line in stated.findall(text):
        low, high = (number(x) for x in re.search(r"from (\S+) to (\S+)", line).groups())
        absent = re.search(r"absent (\S+),", line)
        value = float(typical[key])
        held = HELD if "held" in more else role
        yield Parameter(key, held, number(absent[1]) if absent else value, value, low, high)


def parameter_cause(text):
    """A parameter cause from its explanation; its factors are 1 where nothing is wrong."""
    name = text.partition(":")[0]
    named = text.partition("In the robot file\n")[2].partition("\n\n")[0]
    keys = tuple(re.findall(r"^  \[+(\w+)\]+ (\w+)", named, re.MULTILINE))
    factors = [key for _, key in keys] if keys[0][0] == "friction" else ["factor"]
    parameters = tuple(Parameter(key, SIZES, 1.0, 1.2, 0.2, 5.0) for key in factors)
    return Cause(name, "parameter", PARAMETER_STAGES.get(name, "body"), parameters, keys=keys)
