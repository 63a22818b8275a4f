"""Stage residuals of a recording: what each part of the nominal model leaves of what was measured, without simulating.

Rim speeds r w = G (v, vn, omega), rows of G (cos a, sin a, d); motor forces f = Kt l i / r; nominal model of Oliveira, Sousa,
Moreira, Costa (ICINCO 2008), equations 2, 6 and 10 to 15:

    electrical   u - R i - Kv l w                                          [V]    one a wheel
    body         M dv/dt + B v + C sgn(v) - G^T f                          [N]    along v, vn, omega, while they move
    camera       speed of the pose - pinv(G) r w                           [m/s]  along v, vn, omega
    parity       N^T r w, N the null space of G^T                          [m/s]  four wheels: what rolling does not allow
    loop         w - wset                                                  [rad/s]
    gyro         yaw rate measured - omega                                 [rad/s]
    supply       vbat - its largest                                        [V]

Derivatives are slopes of straight lines over 2 h (Savitzky, Golay, Analytical Chemistry 36, 1964); a slope is the mean of
the derivative under a parabola, so everything that is compared with one is averaged under the same parabola.
Effects that the nominal file already names are not taken into account.
"""

from dataclasses import dataclass

import numpy as np

# Half widths of the straight lines: of wheel speeds, of poses [s].
WHEELS_S, POSE_S = 0.05, 0.1

# An axis moves above this speed [m/s]; a turn is measured at the wheels.
MOVES = 0.02


def parabola(half):
    """The weights under which a slope over 2·half + 1 rows averages the steps between them, one a step."""
    rows = np.arange(-half, half + 1)
    weights = np.cumsum(rows[::-1])[:-1].astype(float)
    return weights / weights.sum()


def averaged(values, half):
    """Averages under the parabola, along the first axis; a step holds the value of the row where it begins."""
    kernel = parabola(half)
    padded = np.pad(values, [(half, half - 1)] + [(0, 0)] * (values.ndim - 1), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, kernel.size, axis=0)
    return windows @ kernel


def slopes(values, half, dt):
    """Slopes of straight lines over 2·half + 1 rows, along the first axis."""
    rows = np.arange(-half, half + 1)
    padded = np.pad(values, [(half, half)] + [(0, 0)] * (values.ndim - 1), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, rows.size, axis=0)
    return windows @ (rows / (rows @ rows)) / dt


def lines(time, values, at, half):
    """Values and slopes, at given times, of straight lines through the samples within `half` seconds."""
    there = np.isfinite(values)
    t, y = time[there], values[there]
    first, last = np.searchsorted(t, at - half), np.searchsorted(t, at + half, side="right")

    def total(samples):
        sums = np.concatenate([[0.0], np.cumsum(samples)])
        return sums[last] - sums[first]

    centre = t.mean() if t.size else 0.0
    n, st, sy = total(np.ones_like(t)), total(t - centre), total(y)
    stt, sty = total((t - centre) ** 2), total((t - centre) * y)
    spread = n * stt - st**2
    good = (n >= 3) & (spread > 1e-12)
    slope = np.where(good, (n * sty - st * sy) / np.where(good, spread, 1), np.nan)
    value = np.where(good, (sy - slope * st) / np.where(good, n, 1), np.nan) + slope * (at - centre)
    return value, slope


def turned(vectors, heading):
    """Vectors (x, y, turn) turned by a heading."""
    sin, cos = np.sin(heading), np.cos(heading)
    x, y = vectors[:, 0], vectors[:, 1]
    return np.column_stack([cos * x - sin * y, sin * x + cos * y, vectors[:, 2]])


@dataclass(frozen=True)
class Numbers:
    """The nominal numbers as matrices."""

    rows: np.ndarray  # G
    inverse: np.ndarray  # pinv(G)
    null: np.ndarray  # N, a column a forbidden combination of rim speeds
    radius: np.ndarray
    resistance: float
    emf: float  # Kv l
    torque: float  # Kt l
    mass: np.ndarray
    viscous: np.ndarray
    coulomb: np.ndarray

    @classmethod
    def of(cls, robot):
        """Those of a robot file."""
        angle = np.radians([wheel["drive_angle_deg"] for wheel in robot["wheel"]])
        distance = [wheel["distance_m"] for wheel in robot["wheel"]]
        rows = np.column_stack([np.cos(angle), np.sin(angle), distance])
        motor, body, friction = robot["motor"], robot["body"], robot["friction"]
        ratio = motor["gear_ratio"]
        return cls(
            rows,
            np.linalg.pinv(rows),
            np.linalg.svd(rows.T)[2][3:].T,
            np.array([wheel["radius_m"] for wheel in robot["wheel"]]),
            motor["resistance_ohm"],
            motor["emf_constant_V_s"] * ratio,
            motor["torque_constant_Nm_per_A"] * ratio,
            np.array([body["mass_kg"], body["mass_kg"], body["inertia_kg_m2"]]),
            np.array([friction[f"viscous_{axis}"] for axis in ("v_N_s_per_m", "vn_N_s_per_m", "w_Nm_s")]),
            np.array([friction[f"coulomb_{axis}"] for axis in ("v_N", "vn_N", "w_Nm")]),
        )


def soft(values, scale):
    """The sign of a value, soft below a scale."""
    return np.tanh(values / scale)


class Motion:
    """What was measured of a run, or stands for what was not, and what follows from it."""

    def __init__(self, robot, run):
        self.numbers = numbers = Numbers.of(robot)
        self.supply = robot.get("supply", {}).get("voltage_V")
        self.time = run.time
        self.dt = float(np.median(np.diff(run.time)))
        self.half = max(2, round(WHEELS_S / self.dt))
        self.pose_half = max(2, round(POSE_S / self.dt))
        wheels = range(len(numbers.radius))
        self.volts = self.wheelwise(run, "u{}_V", wheels)
        self.set = self.wheelwise(run, "wset{}_rad_s", wheels)
        self.gyro, self.battery = run.columns.get("gyro_rad_s"), run.columns.get("vbat_V")
        self.position, self.heading, self.seen = self.posed(run)
        self.measured_w = self.wheelwise(run, "w{}_rad_s", wheels)
        self.measured_i = self.wheelwise(run, "i{}_A", wheels)
        self.w = self.speeds()
        self.i = self.currents()
        self.rim = self.w * numbers.radius
        self.twist = averaged(self.rim, self.half) @ numbers.inverse.T
        self.change = slopes(self.rim, self.half, self.dt) @ numbers.inverse.T
        # A current is sampled just after a voltage, and falls by the back-EMF until the next: half of that in the mean.
        falls = self.change @ numbers.rows.T / numbers.radius * self.dt / 2 * numbers.emf / numbers.resistance
        self.force = (self.i - falls) * numbers.torque / numbers.radius

    def wheelwise(self, run, name, wheels):
        """A signal of all wheels, gaps filled in; None where it is not logged."""
        if not all(name.format(j) in run.columns for j in wheels):
            return None
        columns = [filled(self.time, run.columns[name.format(j)]) for j in wheels]
        return None if any(column is None for column in columns) else np.column_stack(columns)

    def posed(self, run):
        """Position, heading, and the pose's speed in the world, all from straight lines; None where no pose is logged."""
        names = ("x_m", "y_m", "theta_rad")
        if not all(name in run.columns and np.isfinite(run.columns[name]).sum() > 10 for name in names):
            return None, np.zeros_like(self.time), None
        theta = np.array(run.columns["theta_rad"])
        there = np.isfinite(theta)
        theta[there] = np.unwrap(theta[there])
        smooth = [lines(self.time, y, self.time, POSE_S) for y in (run.columns["x_m"], run.columns["y_m"], theta)]
        values = [filled(self.time, value) for value, _ in smooth]
        return np.column_stack(values[:2]), values[2], np.column_stack([slope for _, slope in smooth])

    def speeds(self):
        """Wheel speeds: measured, or those of the pose by rolling, or those that were set."""
        if self.measured_w is not None:
            return self.measured_w
        if self.seen is not None:
            body = turned(np.nan_to_num(self.seen), -self.heading)
            return body @ self.numbers.rows.T / self.numbers.radius
        return self.set if self.set is not None else np.zeros((self.time.size, self.numbers.radius.size))

    def currents(self):
        """Currents: measured, or those of the voltage by the nominal motor."""
        if self.measured_i is not None:
            return self.measured_i
        if self.volts is not None:
            return (self.volts - self.numbers.emf * self.w) / self.numbers.resistance
        return np.zeros_like(self.w)

    def under_body(self, raw):
        """What is compared with an acceleration: averaged like it."""
        return averaged(raw, self.half)

    def under_camera(self, raw):
        """What is compared with the speed of the pose: averaged in the world, seen along the body."""
        return turned(averaged(turned(raw, self.heading), self.pose_half), -self.heading)

    def moving(self):
        """Which axes move, one way, all along the straight lines around a row."""
        arm = np.abs(self.numbers.rows[:, 2]).mean()
        way = np.sign(self.twist) * (np.abs(self.twist) > np.array([MOVES, MOVES, MOVES / arm]))
        padded = np.pad(way, [(2 * self.half, 2 * self.half), (0, 0)], mode="edge")
        around = np.lib.stride_tricks.sliding_window_view(padded, 4 * self.half + 1, axis=0)
        return np.abs(around.sum(axis=-1)) == 4 * self.half + 1

    @staticmethod
    def inside(values, half):
        """Values without those whose straight lines reach over the ends."""
        kept = np.array(values)
        kept[:half] = kept[len(kept) - half :] = np.nan
        return kept

    def residuals(self):
        """The stage residuals that the log allows, by stage; not-a-number where they say nothing."""
        n, found = self.numbers, {}
        if self.volts is not None and self.measured_i is not None and self.measured_w is not None:
            found["electrical"] = self.volts - n.resistance * self.i - n.emf * self.w
        if self.measured_i is not None or self.volts is not None:
            loads = n.viscous * self.twist + n.coulomb * soft(self.twist, MOVES / 4) - self.force @ n.rows
            whole = n.mass * self.change + self.under_body(loads)
            found["body"] = self.inside(np.where(self.moving(), whole, np.nan), self.half)
        if self.seen is not None and self.measured_w is not None:
            off = turned(self.seen, -self.heading) - self.under_camera(self.rim @ n.inverse.T)
            found["camera"] = self.inside(off, self.pose_half)
        if self.measured_w is not None and n.null.size:
            found["parity"] = self.under_body(self.rim) @ n.null
        if self.set is not None and self.measured_w is not None:
            found["loop"] = self.w - self.set
        if self.gyro is not None:
            found["gyro"] = (self.gyro - self.twist[:, 2])[:, None]
        if self.battery is not None:
            found["supply"] = (self.battery - np.nanmax(self.battery))[:, None]
        return found


def filled(time, values):
    """Values with gaps bridged by straight lines; None where there is nothing."""
    there = np.isfinite(values)
    return np.interp(time, time[there], values[there]) if there.any() else None
