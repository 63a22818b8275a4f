"""The nominal numbers as terms of a regression on stage residuals, and what is left beyond their stated uncertainty."""

from scipy.optimize import lsq_linear

from peers.robot_file import uncertain

# How far a nominal number may plausibly be off [its stated sigmas]; a parameter cause is what goes on from there.
PLAUSIBLE = 2.0

# The regressors' size of a parameter cause: its share of the number.
FIFTH = 0.2


def nuisance(robot, design):
    """The columns of the nominal numbers, one stated sigma each."""
    stated = dict(uncertain(robot))
    sigmas = {
        "mass": stated.get(("body", "mass_kg")),
        "inertia": stated.get(("body", "inertia_kg_m2")),
        "resistance": stated.get(("motor", "resistance_ohm")),
        "torque_constant": stated.get(("motor", "emf_constant_V_s")),
        "kt_over_kv": stated.get(("motor", "torque_constant_Nm_per_A")),
        "wheel_radius": stated.get(("wheel", "radius_m")),
        "center_distance": stated.get(("wheel", "distance_m")),
        "viscous_friction": stated.get(("friction", "viscous_v_N_s_per_m")),
        "coulomb_friction": stated.get(("friction", "coulomb_v_N")),
    }
    columns = [k for k, (cause, _) in enumerate(design.named) if sigmas.get(cause)]
    return design.terms[:, columns] * [sigmas[design.named[k][0]] / FIFTH for k in columns]


def beyond_nominal(design, robot):
    """The residual without what the nominal numbers plausibly explain."""
    moved = nuisance(robot, design)
    return design.y - moved @ lsq_linear(moved, design.y, (-PLAUSIBLE, PLAUSIBLE)).x if moved.size else design.y
