"""Square nets hung from their four corners: our solvers beside IPOPT and SciPy, in one run.

Each net has N x N joints and equal members of 1 m and 1 kg; its corners are 0.8 of a side apart. The peers minimise the
potential energy over the places of the joints with the squared lengths as constraints: equal to 1 (rigid bars), or at
most 1 (cables that may be slack, an easier problem). They get exact sparse derivatives and start from the flat net,
sagged by a paraboloid. Times are those of the solvers alone, without reading, building and compiling: of the peers the
processor's; of ours the least of several runs, by the clock or, where that is less because other programs have the
processor, by the processor's time of the whole program, reading and writing included.
"""

import itertools
import json
import multiprocessing
import os
import platform
import resource
import subprocess
import sys
import tempfile
import time
from datetime import datetime, timezone

import casadi
import numpy
import scipy
from scipy.optimize import NonlinearConstraint, minimize
from scipy.sparse import coo_matrix, csr_matrix, diags

GRAVITY = 9.80665
SPAN = 0.8
# Seconds of the processor after which a peer is given up, and of the clock: on a machine with other work the processor
# may come late.
LIMIT_S = float(os.environ.get("LIMIT_S", "120"))
CLOCK_S = 10 * LIMIT_S
# Runs of ours, of which the shortest counts.
RUNS = 5
# SciPy's method for large sparse problems is given up beyond so many members.
MOST_FOR_SCIPY = 2_000


class Net:
    """Places are held as one vector x, y, z of joint 0, of joint 1, ...; the corners stay where they are."""

    def __init__(self, n):
        self.n = n
        number = numpy.arange(n * n).reshape(n, n)
        along = [number[:-1].ravel(), number[:, :-1].ravel()]
        to = [number[1:].ravel(), number[:, 1:].ravel()]
        self.ends = numpy.stack([numpy.concatenate(along), numpy.concatenate(to)])
        self.corners = number[[0, 0, -1, -1], [0, -1, 0, -1]]
        self.free = numpy.setdiff1d(number.ravel(), self.corners)
        u, v = numpy.meshgrid(numpy.linspace(0, 1, n), numpy.linspace(0, 1, n), indexing="ij")
        side = SPAN * (n - 1)
        sag = 0.4 * (n - 1) * 4 * (u * (1 - u) + v * (1 - v)) / 2
        self.start = numpy.stack([side * u, side * v, -sag], axis=-1).reshape(-1, 3)
        # Half of each member's kilogram at both of its joints.
        self.mass = numpy.bincount(self.ends.ravel(), minlength=n * n) / 2

    @property
    def members(self):
        return self.ends.shape[1]

    def system(self):
        """The system file, as JSON."""
        joints = {str(k): {} for k in range(self.n * self.n)}
        for k in self.corners:
            joints[str(k)] = {"at_m": [float(self.start[k, 0]), float(self.start[k, 1]), 0.0]}
        bars = [
            {"from": str(a), "to": str(b), "length_m": 1.0, "mass_kg": 1.0}
            for a, b in self.ends.T.tolist()
        ]
        return {"name": f"net {self.n} x {self.n}", "gravity_m_s2": GRAVITY, "joints": joints, "bars": bars}


def run(command):
    """The ended program, and the processor's time that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run(command, capture_output=True, text=True, check=False, timeout=CLOCK_S)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return ended, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def ours(net):
    """Both solvers by the program; energy is measured from the first corner, where all heights are zero."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(net.system(), file)
        file.flush()
        for solver in ["lagrange", "energy"]:
            command = [os.environ["FUNICULAR"], "solve", file.name, "--solver", solver, "--json", "--summary"]
            try:
                runs = [run(command) for _ in range(RUNS)]
            except subprocess.TimeoutExpired:
                yield f"funicular, {solver}", None, None, f"given up after {CLOCK_S:.0f} s of the clock"
                continue
            used = [seconds for _, seconds in runs]
            runs = [found for found, _ in runs]
            if not runs[0].stdout.startswith("{"):
                yield f"funicular, {solver}", None, None, runs[0].stderr.strip().splitlines()[0]
                continue
            answers = [json.loads(run.stdout) for run in runs]
            if not answers[0]["equilibria"]:
                yield f"funicular, {solver}", None, None, answers[0]["failures"][0]["reason"]
                continue
            found = answers[0]["equilibria"][0]
            seconds = min(*used, *(answer["equilibria"][0]["evidence"]["solve_s"] for answer in answers))
            yield f"funicular, {solver}", seconds, found["energy_j"], f"{found['evidence']['iterations']} steps"


def ipopt(net, cables):
    x = casadi.MX.sym("x", 3, net.free.size)
    places = casadi.MX(net.start.T)
    places[:, net.free.tolist()] = x
    across = places[:, net.ends[1].tolist()] - places[:, net.ends[0].tolist()]
    lengths = casadi.sum1(across**2).T
    energy = GRAVITY * casadi.dot(casadi.DM(net.mass[net.free]), x[2, :].T)
    options = {
        "print_time": False,
        "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-9, "max_cpu_time": LIMIT_S, "max_iter": 10_000},
    }
    solver = casadi.nlpsol("solver", "ipopt", {"x": casadi.vec(x), "f": energy, "g": lengths}, options)
    lower = -casadi.inf if cables else 1.0
    begun = time.process_time()
    found = solver(x0=net.start[net.free].ravel(), lbg=lower, ubg=1.0)
    seconds = time.process_time() - begun
    stats = solver.stats()
    said = f"{stats['iter_count']} steps" + ("" if stats["success"] else f", {stats['return_status']}")
    return seconds, float(found["f"]), said


def by_scipy(net):
    """`trust-constr`, SciPy's method for sparse constraints."""
    column = numpy.full(net.n * net.n, -1)
    column[net.free] = numpy.arange(net.free.size)
    a, b = net.ends
    force = numpy.zeros((net.free.size, 3))
    force[:, 2] = GRAVITY * net.mass[net.free]
    force = force.ravel()
    rows = numpy.arange(net.members)

    def across(x):
        places = net.start.copy()
        places[net.free] = x.reshape(-1, 3)
        return places[b] - places[a]

    def jacobian(x):
        d = 2 * across(x)
        entries = []
        for end, sign in [(a, -1.0), (b, 1.0)]:
            moves = column[end] >= 0
            for k in range(3):
                entries.append((sign * d[moves, k], rows[moves], 3 * column[end[moves]] + k))
        values, row, col = (numpy.concatenate(part) for part in zip(*entries))
        return csr_matrix((values, (row, col)), shape=(net.members, force.size))

    def hessian(_, multipliers):
        both = (column[a] >= 0) & (column[b] >= 0)
        weight = numpy.bincount(net.ends.ravel(), numpy.tile(multipliers, 2), minlength=column.size)[net.free]
        pairs = coo_matrix((-multipliers[both], (column[a[both]], column[b[both]])), shape=(net.free.size,) * 2)
        laplacian = 2 * (diags(weight) + pairs + pairs.T)
        return scipy.sparse.kron(laplacian, scipy.sparse.identity(3), format="csr")

    begun = time.process_time()
    lengths = NonlinearConstraint(lambda x: (across(x) ** 2).sum(axis=1), 1.0, 1.0, jac=jacobian, hess=hessian)
    found = minimize(
        lambda x: float(force @ x),
        net.start[net.free].ravel(),
        jac=lambda _: force,
        hess=lambda _: csr_matrix((force.size, force.size)),
        constraints=[lengths],
        method="trust-constr",
        options={"maxiter": 100_000, "gtol": 1e-8, "xtol": 1e-12},
    )
    said = f"{found.nit} steps, lengths off by {found.constr_violation:.0e}"
    return time.process_time() - begun, float(found.fun), said


def within_limits(solve, *given):
    """A peer in a process of its own, which ends at the limit wherever it is: some look at no clock for minutes."""

    def child(answers):
        resource.setrlimit(resource.RLIMIT_CPU, (int(LIMIT_S) + 1, int(LIMIT_S) + 2))
        answers.send(solve(*given))

    here, there = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=child, args=(there,))
    process.start()
    there.close()
    late = not here.poll(CLOCK_S)
    try:
        answer = None if late else here.recv()
    except EOFError:
        answer = None
    if late:
        process.kill()
    process.join()
    return answer or (None, None, f"given up after {LIMIT_S:.0f} s of the processor")


def peers(net):
    yield ("IPOPT, rigid bars", *within_limits(ipopt, net, False))
    yield ("IPOPT, slack cables", *within_limits(ipopt, net, True))
    if net.members <= MOST_FOR_SCIPY:
        yield ("SciPy trust-constr", *within_limits(by_scipy, net))
    else:
        yield "SciPy trust-constr", None, None, f"not tried beyond {MOST_FOR_SCIPY} members"


def table(net):
    print(f"net of {net.n} x {net.n} joints, {net.members} members", flush=True)
    print(f"  {'solver':<22}{'time / s':>10}{'ratio':>9}{'energy / J':>22}  ", flush=True)
    fastest = None
    for name, seconds, energy, said in itertools.chain(ours(net), peers(net)):
        if fastest is None and seconds is not None:
            fastest = seconds
        time_s = "-" if seconds is None else f"{seconds:.3g}"
        ratio = "-" if seconds is None else f"{seconds / fastest:.3g}"
        height = "-" if energy is None else f"{energy:.10g}"
        print(f"  {name:<22}{time_s:>10}{ratio:>9}{height:>22}  {said}", flush=True)
    print(flush=True)


def main():
    processor = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if "model name" in line), "?")
    version = subprocess.run([os.environ["FUNICULAR"], "--version"], capture_output=True, text=True, check=True)
    print(f"{datetime.now(timezone.utc):%Y-%m-%d %H:%M} UTC, {processor}, load {os.getloadavg()[0]:.1f}")
    print(
        f"{version.stdout.strip()}, CasADi {casadi.__version__} with IPOPT and MUMPS, SciPy {scipy.__version__}, "
        f"Python {platform.python_version()}"
    )
    print("ratio: time over that of the first; energies from the height of the corners\n", flush=True)
    for n in [int(text) for text in sys.argv[1:]] or [32, 100]:
        table(Net(n))


if __name__ == "__main__":
    main()
