"""The report that a contestant leaves: the fields that a scorer reads, in the contract's form."""

import json
from dataclasses import dataclass, field

import tomli_w

from peers.mistakes import Mistake

STAGES = ("electrical", "drivetrain", "contact", "body", "sensing")
PSEUDO = ("unknown", "no_gap")
VERDICTS = ("effect", "parameter", "unknown", "no_gap", "unfit_data")


@dataclass
class Answer:
    """What a contestant found. `which` has (Cause or pseudo-cause, wheel, weight) in any order, weights of any sum;
    `stages` are shares by stage of any sum, needed only where no cause has a weight."""

    which: list
    stages: dict = field(default_factory=dict)
    robot: dict | None = None
    notes: dict = field(default_factory=dict)


def ranked(which):
    """The entries of `which`, most probable first; both pseudo-causes are there, and probabilities sum to one."""
    named = [one[0] for one in which]
    which = [*which, *((pseudo, None, 0.0) for pseudo in PSEUDO if pseudo not in named)]
    total = sum(weight for *_, weight in which)
    entries = []
    for cause, wheel, weight in sorted(which, key=lambda one: -one[2]):
        pseudo = isinstance(cause, str)
        name, kind = (cause, None) if pseudo else (cause.id, cause.kind)
        entries.append({"cause": name, "kind": kind, "probability": weight / total, "wheel": wheel, "axis": None})
    return entries


def stage_shares(answer):
    """Shares of the stages: the weight of the causes in each; where there is none, what the answer says of stages."""
    shares = dict.fromkeys(STAGES, 0.0)
    for cause, _, weight in answer.which:
        if not isinstance(cause, str):
            shares[cause.stage] += weight
    if sum(shares.values()) <= 0:
        shares |= answer.stages or dict.fromkeys(STAGES, 1.0)
    total = sum(shares.values())
    return {stage: share / total for stage, share in shares.items() if share > 0}


def report(session, name, answer, seconds):
    """The report as a dictionary."""
    which = ranked(answer.which)
    best = which[0]
    where = [
        {"stage": stage, "axis": None, "wheel": best["wheel"] if len(shares) == 1 else None, "share": share}
        for shares in [stage_shares(answer)]
        for stage, share in sorted(shares.items(), key=lambda one: -one[1])
    ]
    made = {
        "schema": 1,
        "robot": session.robot.get("name"),
        "session": session.folder.name,
        "verdict": best["kind"] or best["cause"],
        "causes": [best["cause"]] if best["kind"] else [],
        "which": which,
        "where": where,
        "engine": {"name": f"peer {name}", "version": 1, "seconds": seconds, **answer.notes},
    }
    faults = check(made)
    if faults:
        raise AssertionError(f"a report that breaks its own form: {faults}")
    return made


def check(made):
    """What is wrong with a report; nothing where it keeps the form."""
    faults = [f"no {key}" for key in ("schema", "verdict", "causes", "which", "where") if key not in made]
    if faults:
        return faults
    if made["schema"] != 1:
        faults.append("schema is not 1")
    if made["verdict"] not in VERDICTS:
        faults.append(f"verdict {made['verdict']}")
    if (made["verdict"] in ("effect", "parameter")) != bool(made["causes"]):
        faults.append("causes stand where the verdict is effect or parameter, and nowhere else")
    probabilities = [one["probability"] for one in made["which"]]
    if not all(0 <= p <= 1 for p in probabilities) or abs(sum(probabilities) - 1) > 1e-9:
        faults.append("probabilities do not sum to 1")
    if probabilities != sorted(probabilities, reverse=True):
        faults.append("which is not sorted")
    causes = {one["cause"] for one in made["which"]}
    faults += [f"which lacks {pseudo}" for pseudo in PSEUDO if pseudo not in causes]
    for one in made["which"]:
        if set(one) != {"cause", "kind", "probability", "wheel", "axis"}:
            faults.append(f"fields of {one['cause']}")
        if (one["kind"] is None) != (one["cause"] in PSEUDO):
            faults.append(f"kind of {one['cause']}")
    if any(one["stage"] not in STAGES for one in made["where"]):
        faults.append("a stage that is none")
    if abs(sum(one["share"] for one in made["where"]) - 1) > 1e-9:
        faults.append("shares do not sum to 1")
    return faults


def write(folder, session, name, answer, seconds):
    """Leaves report.json and, where a model was made, corrected_robot.toml; no file is ever left half-written."""
    made = report(session, name, answer, seconds)
    texts = {"report.json": json.dumps(made, indent=1) + "\n"}
    corrected = folder / "corrected_robot.toml"
    if answer.robot is not None and made["causes"]:
        texts[corrected.name] = tomli_w.dumps(answer.robot)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        corrected.unlink(missing_ok=True)
        for file, text in texts.items():
            half = folder / f".{file}.half"
            half.write_text(text, encoding="utf-8")
            half.replace(folder / file)
    except OSError as why:
        raise Mistake(f"{folder}: cannot be written ({why.strerror}); choose another folder") from why
    return made
