"""Robots that run into each other: how they come apart, whether they turn, what energy is left."""

import numpy as np

from rsoccer import SimConfig
from rsoccer.frame import Array
from tools.physics.check import EXACT, Checks, Line, within
from tools.physics.cited import GENERIC, SSL_SHARED, VSS_ROBOTS
from tools.physics.scene import TICK, Scene, Track

TOPIC = "crashes"
CRASHES = 300

APART = Line(TOPIC, "speed at which two come apart, by that of their meeting", "", within(0.02))
TURNS = Line(TOPIC, "squares face to face: turn rate", "rad/s", within(0.01), "symmetry")
ASIDE = Line(TOPIC, "aside after 2 s of pushing", "mm", within(0.1), "symmetry")
ENERGY = Line(
    TOPIC, "crashes at random, wheels told to stand: some tick gains energy", "", EXACT, "friction"
)
MET = Line(TOPIC, "more than half of them met", "", EXACT, "aim")


def checks() -> Checks:
    """Every line of the acceptance about robots that run into each other."""
    for first, second in ((1.0, 0.0), (1.0, 1.0), (2.0, 1.0), (3.0, 3.0)):
        yield from _head_on(first, second)
    for name in VSS_ROBOTS:
        for speed in (0.3, 0.6, 1.1):
            yield from _squares(name, speed)
    for name in ("ssl_generic", *VSS_ROBOTS):
        yield from _at_random(name)


def _head_on(first: float, second: float) -> Checks:
    scene = Scene(SimConfig("ssl_b", 1, 1, time_step=TICK))
    scene.ball.position[:] = (0.0, 2.0)
    scene.robots.position[0, :, 0] = (-0.2, 0.2)
    scene.robots.velocity[0, :, 0] = (first, -second)
    scene.face(1, 180.0)
    scene.tell(0, v_x=first)
    scene.tell(1, v_x=second)
    blue, yellow = scene.play(0.5).robots.velocity[:, 0, :, 0].T
    apart = float((yellow - blue).max()) / (first + second)
    yield APART(f"{first:g} and {second:g} m/s", SSL_SHARED["restitution"].value, apart)


def _squares(name: str, speed: float) -> Checks:
    rim = speed / VSS_ROBOTS[name].wheel_radius
    scene = Scene(SimConfig("vss_3v3", 1, 1, robot=name, time_step=TICK))
    scene.ball.position[:] = (0.0, 0.6)
    scene.robots.position[0, :, 0] = (-0.2, 0.2)
    scene.robots.velocity[0, :, 0] = (speed, -speed)
    scene.face(1, 180.0)
    for index in (0, 1):
        scene.tell(index, left=rim, right=rim)
    robots = scene.play(2.0).robots
    case = f"`{name}`, {speed:g} m/s each"
    yield TURNS(case, 0.0, abs(robots.spin).max())
    yield ASIDE(case, 0.0, 1000 * abs(robots.position[-1, ..., 1]).max())


def _at_random(name: str) -> Checks:
    """One drives and turns at another; nobody's wheels are told to turn."""
    vss, rng = VSS_ROBOTS.get(name), np.random.default_rng(5)
    field, size = ("vss_3v3", vss.side) if vss else ("ssl_b", 2 * GENERIC.radius)
    scene = Scene(SimConfig(field, 1, 1, robot=name, time_step=TICK), CRASHES)
    scene.ball.position[:] = (0.0, 0.6)
    scene.robots.position[:, :, 0] = (-size, size)
    scene.robots.position[:, 0, 1] = rng.uniform(-0.6 * size, 0.6 * size, CRASHES)
    scene.robots.velocity[:] = rng.uniform(-1, 1, (CRASHES, 2, 2))
    scene.robots.velocity[:, 0, 0] += 2.0
    scene.robots.spin[:] = rng.uniform(-15, 15, (CRASHES, 2))
    for index in (0, 1):
        scene.face(index, rng.uniform(-180, 180, CRASHES))
    robots = scene.play(0.5)
    mass, inertia = (vss.mass, vss.side**2 / 6) if vss else (GENERIC.mass, GENERIC.radius**2 / 2)
    energy = np.concatenate([_energy(scene, mass, inertia)[None], _energy(robots, mass, inertia)])
    gains = (np.diff(energy, axis=0) > 1e-3 * energy[0]).any(axis=0)
    yield ENERGY(f"`{name}`, {CRASHES} crashes", 0, gains.sum())
    met = (robots.robots.touched_foe > 0).any(axis=(0, 2)).sum()
    yield MET(f"`{name}`", 1, met > CRASHES / 2)


def _energy(at: Scene | Track, mass: float, inertia: float) -> Array:
    """Of motion and turning, J; `inertia` is that of a plate, by the mass."""
    velocity, spin = at.robots.velocity.astype(np.float64), at.robots.spin.astype(np.float64)
    energy: Array = mass / 2 * ((velocity**2).sum(axis=-1) + inertia * spin**2).sum(axis=-1)
    return energy
