"""Chains in motion: ours beside MuJoCo, Pinocchio and Exudyn, in one run.

N bars of 1 m and 1 kg with hinges lie on a quarter of a circle, held at the upper end (open) or at both (closed), and
are released. Every program follows them for half a second in steps of 1 ms, and of half that: what its places change
by then is its own error, which the distance from ours has to be within. Ours for that is of the order eight, with its
own error stated too; its hinges are ball joints, and the motion stays in its plane. Times a step are those of the
processor, ours for the orders two (RATTLE) and four.

MuJoCo: nested bodies, RK4; a closed chain is closed by a soft constraint (`equality connect`), so that it stays away
from ours whatever the step, which is stated and not judged. Pinocchio: its `aba` (articulated bodies), four of them a
step of the classical Runge-Kutta method written here; open chains. Exudyn: redundant coordinates, joints as
constraints, generalised-alpha (rho 0.9), sparse.
"""

import os
import platform
import subprocess
import sys
import time
import warnings
from datetime import datetime, timezone

import numpy

# Keys of Exudyn are renamed from version to version; the old ones go on working for years.
warnings.simplefilter("ignore", DeprecationWarning)
import exudyn
import mujoco
import pinocchio
from exudyn import itemInterface as items

GRAVITY = 9.81
TIME_S = 0.5
STEP_S = 1e-3
ROUNDING = 1e-11
SIZES = [3, 10, 100, 300]


def angles(n):
    """Angles of the bars with the descending vertical."""
    return [float((k + 0.5) * numpy.pi / 2 / n) for k in range(n)]


def ends(thetas):
    """Places of the joints in the plane, x and z."""
    bars = numpy.column_stack([numpy.sin(thetas), -numpy.cos(thetas)])
    return numpy.vstack([[0.0, 0.0], numpy.cumsum(bars, axis=0)])


def ours(n, closed, step_s, steps, order):
    kind = "closed" if closed else "open"
    told = subprocess.run(
        [os.environ["RELEASED"], kind, str(n), repr(step_s), str(steps), order],
        check=True, capture_output=True, text=True,
    ).stdout.splitlines()
    places = numpy.array([[float(x) for x in line.split(",")] for line in told[1:]])
    return float(told[0]), places[:, [0, 2]]


def timed(step, steps):
    begin = time.process_time()
    for _ in range(steps):
        step()
    return (time.process_time() - begin) / steps * 1e6


def of_mujoco(n, closed, step_s, steps):
    text = [
        f'<mujoco><compiler angle="radian"/><option timestep="{step_s!r}" gravity="0 0 -{GRAVITY}" integrator="RK4">'
        '<flag contact="disable"/></option><worldbody>'
    ]
    before = 0.0
    for k, angle in enumerate(angles(n)):
        half, before = (before - angle) / 2, angle
        text.append(
            f'<body name="{k}" pos="0 0 {-1 if k else 0}" quat="{float(numpy.cos(half))!r} 0 {float(numpy.sin(half))!r} 0">'
            '<joint type="hinge" axis="0 1 0"/>'
            f'<inertial pos="0 0 -0.5" mass="1" diaginertia="{1 / 12!r} {1 / 12!r} 1e-3"/>'
        )
    text.append('<site name="end" pos="0 0 -1"/>' + "</body>" * n + "</worldbody>")
    if closed:
        text.append(f'<equality><connect body1="{n - 1}" anchor="0 0 -1"/></equality>')
    model = mujoco.MjModel.from_xml_string("".join(text) + "</mujoco>")
    data = mujoco.MjData(model)
    each = timed(lambda: mujoco.mj_step(model, data), steps)
    mujoco.mj_forward(model, data)
    return each, numpy.vstack([data.xpos[1:], data.site("end").xpos])[:, [0, 2]]


def of_pinocchio(n, closed, step_s, steps):
    model = pinocchio.Model()
    model.gravity.linear = numpy.array([0.0, 0.0, -GRAVITY])
    bar = pinocchio.Inertia(1.0, numpy.array([0.0, 0.0, -0.5]), numpy.diag([1 / 12, 1 / 12, 1e-3]))
    parent = 0
    for k in range(n):
        place = pinocchio.SE3.Identity()
        place.translation = numpy.array([0.0, 0.0, -1.0 if k else 0.0])
        parent = model.addJoint(parent, pinocchio.JointModelRY(), place, str(k))
        model.appendBodyToJoint(parent, bar, pinocchio.SE3.Identity())
    data = model.createData()
    free = numpy.zeros(n)
    state = [-numpy.diff(angles(n), prepend=0.0), numpy.zeros(n)]

    def turned(q, v):
        return pinocchio.aba(model, data, q, v, free).copy()

    def step():
        (q, v), h = state, step_s
        a = turned(q, v)
        b = turned(q + h / 2 * v, v + h / 2 * a)
        c = turned(q + h / 2 * v + h * h / 4 * a, v + h / 2 * b)
        d = turned(q + h * v + h * h / 2 * b, v + h * c)
        state[:] = [q + h * v + h * h / 6 * (a + b + c), v + h / 6 * (a + 2 * b + 2 * c + d)]

    each = timed(step, steps)
    return each, ends(-numpy.cumsum(state[0]))


def of_exudyn(n, closed, step_s, steps):
    system = exudyn.SystemContainer().AddSystem()
    ground = system.AddObject(items.ObjectGround())
    last = system.AddMarker(items.MarkerBodyPosition(bodyNumber=ground, localPosition=[0, 0, 0]))
    places, bodies = ends(angles(n)), []
    for k, angle in enumerate(angles(n)):
        x, z = places[k : k + 2].mean(axis=0)
        node = system.AddNode(items.NodeRigidBody2D(referenceCoordinates=[x, z, angle - numpy.pi / 2]))
        body = system.AddObject(items.ObjectRigidBody2D(physicsMass=1.0, physicsInertia=1 / 12, nodeNumber=node))
        begin, end = (
            system.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=[at, 0, 0])) for at in (-0.5, 0.5)
        )
        mass = system.AddMarker(items.MarkerBodyMass(bodyNumber=body))
        system.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0, -GRAVITY, 0]))
        system.AddObject(items.ObjectJointRevolute2D(markerNumbers=[last, begin]))
        last = end
        bodies.append(body)
    if closed:
        held = system.AddMarker(items.MarkerBodyPosition(bodyNumber=ground, localPosition=[*places[-1], 0]))
        system.AddObject(items.ObjectJointRevolute2D(markerNumbers=[last, held]))
    system.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = step_s * steps
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.solutionSettings.writeSolutionToFile = False
    settings.linearSolverType = exudyn.LinearSolverType.EigenSparse
    each = timed(lambda: system.SolveDynamic(settings), 1) / steps
    position = exudyn.OutputVariableType.Position
    found = [system.GetObjectOutputBody(body, position, localPosition=[0.5, 0, 0])[:2] for body in bodies]
    return each, numpy.vstack([[0.0, 0.0], found])


def apart(a, b):
    return float(numpy.linalg.norm(a - b, axis=1).max())


# Name, function, whether it follows closed chains, whether those are judged.
PEERS = [
    ("MuJoCo, RK4", of_mujoco, True, False),
    ("Pinocchio, RK4", of_pinocchio, False, True),
    ("Exudyn, gen.-alpha", of_exudyn, True, True),
]


def compare(n, closed):
    """Print the rows of a chain; whether all that is judged is within its error."""
    steps = round(TIME_S / STEP_S)
    print(f"{'closed' if closed else 'open'} chain of {n} bars")
    print("  program             us a step     ratio  us a bar  own error / m  from ours / m")
    rattle, _ = ours(n, closed, STEP_S, steps, "second")
    fourth, _ = ours(n, closed, STEP_S, steps, "fourth")
    _, coarse = ours(n, closed, STEP_S, steps, "eighth")
    _, exact = ours(n, closed, STEP_S / 2, 2 * steps, "eighth")
    own = apart(coarse, exact)
    print(f"  ours, order 2     {rattle:11.2f} {1:9.3g} {rattle / n:9.3f}")
    print(f"  ours, order 4     {fourth:11.2f} {fourth / rattle:9.3g} {fourth / n:9.3f}  {own:13.1e}  (order 8)")
    within = True
    for name, follow, closes, judged in PEERS:
        if closed and not closes:
            continue
        each, first = follow(n, closed, STEP_S, steps)
        _, second = follow(n, closed, STEP_S / 2, 2 * steps)
        error, off = apart(first, second), apart(second, exact)
        note = ""
        if closed and not judged:
            note = "  soft closure"
        elif off > error + own + ROUNDING * n:
            note, within = "  BEYOND ITS ERROR", False
        row = f"  {name:<18}{each:11.2f} {each / rattle:9.3g} {each / n:9.3f}  {error:13.1e}  {off:13.1e}{note}"
        print(row, flush=True)
    print()
    return within


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        named = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return named[0] if named else platform.processor()


def main():
    sizes = [int(n) for n in sys.argv[1:]] or SIZES
    load = os.getloadavg()[0]
    print(f"{datetime.now(timezone.utc):%Y-%m-%d %H:%M} UTC, {processor()}, load {load:.1f}")
    versions = f"MuJoCo {mujoco.__version__}, Pinocchio {pinocchio.__version__}, Exudyn {exudyn.__version__}"
    print(f"motion 0.1.0, {versions}, Python {platform.python_version()}")
    print(f"{TIME_S} s in steps of {STEP_S} s; ratio: time a step over that of ours of order 2\n")
    within = [compare(n, closed) for closed in (False, True) for n in sizes]
    if not all(within):
        sys.exit("a peer is farther from ours than its own error")


if __name__ == "__main__":
    main()
