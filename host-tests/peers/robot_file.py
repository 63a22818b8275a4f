"""Robot files with a cause put in, and with nominal numbers moved by their stated uncertainty.

A nominal number is p = p0·(1 + s·z), s its stated relative uncertainty and z standard normal; wheels share their radius
and their distance.
"""

import copy

# Where [uncertainty] is silent: the contract's own defaults.
UNCERTAINTY = {
    ("body", "mass_kg"): 0.01,
    ("body", "inertia_kg_m2"): 0.10,
    ("motor", "resistance_ohm"): 0.10,
    ("motor", "emf_constant_V_s"): 0.03,
    ("motor", "torque_constant_Nm_per_A"): 0.03,
    ("wheel", "radius_m"): 0.01,
    ("wheel", "distance_m"): 0.01,
    ("friction", "viscous_v_N_s_per_m"): 0.20,
    ("friction", "viscous_vn_N_s_per_m"): 0.20,
    ("friction", "viscous_w_Nm_s"): 0.20,
    ("friction", "coulomb_v_N"): 0.20,
    ("friction", "coulomb_vn_N"): 0.20,
    ("friction", "coulomb_w_Nm"): 0.20,
}

# A number is never moved below this share of its nominal value.
LEAST = 0.05


def uncertain(robot):
    """The nominal numbers that may be off, as ((table, key), relative sigma); zeros cannot be off by a share."""
    stated = robot.get("uncertainty", {})
    named = [(where, stated.get(where[1], sigma)) for where, sigma in UNCERTAINTY.items()]
    return [(where, sigma) for where, sigma in named if sigma > 0 and any(value(robot, where))]


def value(robot, where):
    """The values of a number: one, or one a wheel."""
    table, key = where
    tables = robot[table] if table == "wheel" else [robot[table]]
    return [one.get(key, 0.0) for one in tables]


def scaled(robot, factors):
    """The robot with numbers multiplied: `factors` by (table, key)."""
    changed = copy.deepcopy(robot)
    for (table, key), factor in factors.items():
        for one in changed[table] if table == "wheel" else [changed[table]]:
            one[key] = one.get(key, 0.0) * factor
    return changed


def moved(robot, z):
    """The robot with its uncertain numbers moved by z of their sigmas."""
    known = uncertain(robot)
    return scaled(robot, {where: max(1 + sigma * k, LEAST) for (where, sigma), k in zip(known, z, strict=True)})


def with_cause(robot, cause, numbers, wheel=None):
    """The robot with a cause in it: `numbers` by the cause's parameter keys, the others at their typical value."""
    if cause.kind == "parameter":
        factors = [numbers[one.key] for one in cause.parameters]
        shared = factors * len(cause.keys) if len(factors) == 1 else factors
        return scaled(robot, dict(zip(cause.keys, shared, strict=True)))
    changed = copy.deepcopy(robot)
    table = {one.key: float(numbers.get(one.key, one.typical)) for one in cause.parameters}
    effects = changed.setdefault("effects", {})
    if wheel is None:
        effects[cause.id] = table
    else:
        there = effects.get(cause.id, [])
        effects[cause.id] = [*(there if isinstance(there, list) else []), {"wheel": wheel, **table}]
    return changed


def carries(robot, cause):
    """Whether the nominal robot already has this effect."""
    return cause.id in robot.get("effects", {})
