"""The catalogue as regressors: what each cause adds to the stage residuals of `stages.py` at its typical size.

    y = sum over causes of c · column,  c = 1 at the typical size

A column spans all stages, since one cause shows in several: an encoder that reads 2 % too much adds -Kv l w to the electrical
residual and -pinv(G) r w to the camera's. Laws are those of the catalogue's cards, to first order. Causes that are not a
fixed function of what is measured have none: cogging and commutation ripple (averaged out under the straight lines), backlash,
elastic shafts, presliding, load transfer, uneven load, lost commands, a drifting clock.
"""

from dataclasses import dataclass

import numpy as np

from peers.stages import MOVES, soft

# Below these a sign is not told [A], [rad/s].
SMALL_CURRENT, SMALL_SPEED = 0.05, 0.3


@dataclass(frozen=True)
class Column:
    """A regressor: whose it is, the wheel if it sits on one, and what it adds by stage."""

    cause: str
    wheel: int | None
    adds: dict


class Library:
    """The regressors of a motion."""

    def __init__(self, motion):
        self.m, self.n = motion, motion.numbers
        n, m = self.n, motion
        self.wheels = range(n.radius.size)
        self.sign = soft(m.twist, MOVES / 4)
        self.away = np.zeros((m.time.size, 2)) if m.position is None else m.position
        self.voltage = m.supply or (float(np.max(np.abs(m.volts))) if m.volts is not None else 0.0) or 1.0

    def columns(self):
        """All of them."""
        made = [*self.electrical(), *self.drivetrain(), *self.contact(), *self.body(), *self.camera(), *self.beside()]
        made += [column for j in self.wheels for column in self.one_wheel(j)]
        return made + list(self.parameters())

    def of(self, cause, wheel=None, **adds):
        """A regressor."""
        return Column(cause, wheel, adds)

    def wheelwise(self, forces):
        """What forces at the rims [N] add to the body's residual."""
        return -self.m.under_body(forces @ self.n.rows)

    def rolling(self, speeds):
        """What rim speeds that do not belong to the body's motion [m/s] add to camera and parity."""
        adds = {"camera": -self.m.under_camera(speeds @ self.n.inverse.T)}
        return adds | ({"parity": self.m.under_body(speeds) @ self.n.null} if self.n.null.size else {})

    def electrical(self):
        """Bridge, supply, windings."""
        m, n = self.m, self.n
        sign = soft(m.i, SMALL_CURRENT)
        yield self.of("dead_time", electrical=0.3 * sign)
        diodes = np.minimum(0.3, n.emf * np.abs(m.w)) * (m.i * m.w < 0)
        yield self.of("regeneration_asymmetry", electrical=diodes * sign)
        yield self.of("torque_saturation", body=self.wheelwise(0.015 * m.i**2 * m.force))
        yield self.of("current_sensor_gain", electrical=-0.05 * n.resistance * m.i, body=self.wheelwise(0.05 * m.force))
        offset = np.full_like(m.i, 0.05)
        forces = offset * n.torque / n.radius
        yield self.of("current_sensor_offset", electrical=-n.resistance * offset, body=self.wheelwise(forces))
        heat = np.cumsum(n.resistance * m.i**2, axis=0) * m.dt / 60.0
        yield self.of("winding_heating", electrical=n.resistance * m.i * 0.0039 * 15.0 * heat)
        if m.volts is None:
            return
        bus = np.sum(m.volts * m.i, axis=1, keepdims=True) / self.voltage
        yield self.of("supply_sag", electrical=m.volts / self.voltage * 0.15 * bus, supply=-0.15 * bus)
        late = round(0.01 / m.dt)
        if late >= 1:
            yield self.of("actuation_delay", electrical=m.volts - behind(m.volts, late))
        jump = m.volts - behind(m.volts, 1)
        yield self.of("winding_inductance", electrical=jump)
        ideal = (m.volts - n.emf * m.w) / n.resistance
        yield self.of("current_lag", electrical=n.resistance * (ideal - behind(ideal, 1)) * np.exp(-m.dt / 0.002))
        yield self.of("current_limit", electrical=n.resistance * (ideal - np.clip(ideal, -2.0, 2.0)))

    def drivetrain(self):
        """What friction and inertia are at the wheels, alike on all."""
        m, n = self.m, self.n
        yield self.of("gear_efficiency", body=self.wheelwise(0.15 * m.force * (m.force * m.w > 0)))
        slow = np.exp(-((m.twist * self.arm() / 0.05) ** 2))
        yield self.of("stribeck", body=-m.under_body(0.5 * n.coulomb * slow * self.sign))
        cold = np.exp(-(m.time - m.time[0]) / 60.0)[:, None]
        yield self.of("friction_warmup", body=-m.under_body(0.3 * n.coulomb * cold * self.sign))
        yield self.of("rotor_inertia", body=-(m.change @ (n.rows.T @ (n.rows * (7.5e-5 / n.radius**2)[:, None]))))
        lag = 0.008 * slopes_of(m, m.w)
        yield self.of("encoder_lag", electrical=n.emf * lag, **self.rolling(-lag * n.radius))

    def contact(self):
        """Wheels and floor, alike on all."""
        m, n = self.m, self.n
        yield self.of("creep", **self.rolling(0.02 * m.force))
        load = n.mass[0] * 9.81 / n.radius.size
        yield self.of("wheel_slip", **self.rolling((m.force / (0.35 * load)) ** 3 * load / 30.0))
        along = self.n.rows[:, :2]
        aside = m.twist[:, :2] @ np.column_stack([-along[:, 1], along[:, 0]]).T
        pull = soft(aside, MOVES / 4) @ np.column_stack([-along[:, 1], along[:, 0]])
        yield self.of("roller_friction", body=-m.under_body(0.15 * np.column_stack([pull, np.zeros(len(pull))])))

    def body(self):
        """Forces on the body."""
        m, n = self.m, self.n
        v, vn, w = m.twist.T
        mass = n.mass[0]
        yield self.of("coriolis", body=m.under_body(mass * np.column_stack([w * vn, -w * v, 0 * w])))
        dv, dvn, dw = m.change.T
        along = np.column_stack([mass * w**2, -mass * dw, -mass * (dvn + w * v)])
        yield self.of("cog_offset", body=0.006 * along)
        across = np.column_stack([mass * dw, mass * w**2, mass * (dv - w * vn)])
        yield self.of("cog_offset", body=0.003 * across)
        for x, y in ((1.0, 0.0), (0.0, 1.0)):
            pull = self.world(x, y)
            yield self.of("floor_tilt", body=m.under_body(0.0175 * mass * 9.81 * pull))
            speed = np.hypot(v, vn)[:, None]
            yield self.of("carpet_nap", body=-m.under_body(0.2 * pull * soft(speed, 0.05)))
        far = np.column_stack([1.0 - self.away[:, 0], 0.5 - self.away[:, 1]])
        far = far / np.maximum(np.hypot(*far.T), 0.05)[:, None]
        yield self.of("cable_pull", body=m.under_body(0.3 * self.world(far[:, 0], far[:, 1])))
        square = 0.05 * np.hypot(v, vn)[:, None] * m.twist * np.array([1, 1, 0])
        yield self.of("quadratic_drag", body=-m.under_body(square))
        on = (np.hypot(self.away[:, 0] - 0.5, self.away[:, 1] - 0.3) < 0.4)[:, None]
        yield self.of("floor_patch", body=-m.under_body(0.5 * n.coulomb * on * self.sign))
        unit = m.twist[:, :2] / np.maximum(np.hypot(v, vn), 0.01)[:, None]
        shared = np.column_stack([n.coulomb[:2] * (unit - self.sign[:, :2]), 0 * v])
        yield self.of("friction_ellipse", body=-m.under_body(0.7 * shared))

    def camera(self):
        """What the camera shows otherwise."""
        m = self.m
        v, vn, w = m.twist.T
        yield self.of("camera_latency", camera=-m.under_camera(0.04 * slopes_of(m, m.twist)))
        yield self.of("camera_scale", camera=m.under_camera(0.02 * np.column_stack([v, vn, 0 * w])))
        yield self.of("camera_rotation", camera=m.under_camera(0.035 * np.column_stack([vn, -v, 0 * w])))
        yield self.of("marker_offset", camera=m.under_camera(0.01 * np.column_stack([0 * w, w, 0 * w])))
        yield self.of("marker_offset", camera=m.under_camera(0.005 * np.column_stack([-w, 0 * w, 0 * w])))
        planar = np.column_stack([v, vn, 0 * w])
        for k, size in enumerate((0.01, -0.008)):
            yield self.of("camera_perspective", camera=m.under_camera(size * planar * self.away[:, [k]]))

    def beside(self):
        """Gyro, and drives that control speed."""
        m = self.m
        if m.gyro is not None:
            yield self.of("gyro_bias", gyro=np.full((m.time.size, 1), 0.02))
        if m.set is not None:
            yield self.of("speed_loop", loop=-0.1 * slopes_of(m, m.set))
            yield self.of("speed_loop", loop=-0.05 * m.set)
            yield self.of("command_deadband", loop=-m.set * np.exp(-((m.set / 2.0) ** 4)))

    def one_wheel(self, j):
        """What sets one wheel apart."""
        m, n = self.m, self.n
        only = np.zeros_like(m.w)
        only[:, j] = 1.0
        sign = only * soft(m.w, SMALL_SPEED)
        if m.volts is not None:
            yield self.of("drive_gain", j, electrical=0.05 * only * m.volts)
        emf, force = -0.12 * only * n.emf * m.w, -0.12 * only * m.force
        yield self.of("motor_mismatch", j, electrical=emf, body=-self.wheelwise(force))
        torque = 0.02 * sign + 1e-4 * only * m.w
        yield self.of("wheel_friction", j, body=self.wheelwise(torque / n.radius))
        yield self.of("asymmetric_friction", j, body=self.wheelwise(0.02 / n.radius * np.abs(sign)))
        shown = 0.02 * only * m.w
        yield self.of("encoder_scale", j, electrical=-n.emf * shown, **self.rolling(shown * n.radius))
        less = self.wheelwise(0.02 * only * m.force)
        yield self.of("wheel_radius_error", j, body=less, **self.rolling(-0.02 * only * m.rim))
        turn = np.cumsum(m.w[:, [j]], axis=0) * m.dt
        yield self.of("wheel_eccentricity", j, **self.rolling(-0.006 * only * m.rim * np.cos(turn)))
        yield self.of("wheel_eccentricity", j, **self.rolling(-0.005 * only * m.rim * np.sin(turn)))
        yield self.of("roller_ripple", j, **self.rolling(-0.004 * only * m.rim * np.cos(15 * turn)))
        yield self.of("roller_ripple", j, **self.rolling(-0.003 * only * m.rim * np.sin(15 * turn)))
        aside = np.array([-n.rows[j, 1], n.rows[j, 0], 0.0])
        push = m.under_body(0.05 * m.force[:, [j]] * aside)
        yield self.of("wheel_misalignment", j, body=push, **self.rolling(0.05 * only * (m.twist @ aside)[:, None]))

    def parameters(self):
        """Numbers of the robot file, off by a fifth."""
        m, n = self.m, self.n
        dv = m.change
        yield self.of("mass", body=-0.2 * n.mass * dv * np.array([1, 1, 0]))
        yield self.of("inertia", body=-0.2 * n.mass * dv * np.array([0, 0, 1]))
        yield self.of("resistance", electrical=0.2 * n.resistance * m.i)
        force = -self.wheelwise(0.2 * m.force)
        yield self.of("torque_constant", electrical=0.2 * n.emf * m.w, body=force)
        yield self.of("kt_over_kv", body=force)
        yield self.of("wheel_radius", body=-force - 0.2 * n.mass * dv, **self.rolling(-0.2 * m.rim))
        spin = np.column_stack([0 * m.twist[:, 0], 0 * m.twist[:, 0], m.twist[:, 2]])
        turning = force * np.array([0, 0, 1]) + 0.2 * n.mass * dv * np.array([0, 0, 1])
        yield self.of("center_distance", body=turning, camera=-m.under_camera(0.2 * spin))
        for axis in range(3):
            only = np.eye(3)[axis]
            yield self.of("viscous_friction", body=-m.under_body(0.2 * n.viscous * m.twist * only))
            yield self.of("coulomb_friction", body=-m.under_body(0.2 * n.coulomb * self.sign * only))

    def arm(self):
        """What turns the axes' speeds into speeds at the wheels [m]."""
        return np.array([1.0, 1.0, np.abs(self.n.rows[:, 2]).mean()])

    def world(self, x, y):
        """A direction of the world, along the body's axes."""
        heading = self.m.heading
        cos, sin = np.cos(heading), np.sin(heading)
        return np.column_stack([cos * x + sin * y, cos * y - sin * x, 0 * heading])


def behind(values, rows):
    """Values as they were some rows before; zero before the first."""
    return np.concatenate([np.zeros_like(values[:rows]), values[:-rows]]) if rows < len(values) else np.zeros_like(values)


def slopes_of(motion, values):
    """How fast values change."""
    return np.gradient(values, motion.dt, axis=0) if len(values) > 1 else np.zeros_like(values)
