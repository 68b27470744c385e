"""Times Campbell diagrams: whirl's of the reference machine beside ROSS's of a rotor of 56 nodes, in turns.

    cargo build --release && pip install ross-rotordynamics && python3 benches/campbell.py target/release/whirl

whirl is timed as a process, from the start of the program to its files, with its bodies in the cache; ROSS within a process that
has imported it and assembled its rotor. Both find the first 20 modes at 61 speeds. ROSS keeps what it has found for a rotor, so
that each turn has a rotor of its own.
"""

import statistics
import subprocess
import sys
import tempfile
import time
import warnings

SPEEDS = 61
MODES = 20
TURNS = 5


def ross_rotor():
    import ross

    steel = ross.Material(name="steel", rho=7860, E=2.06e11, G_s=7.9e10)
    shaft = [ross.ShaftElement(L=0.02, idl=0, odl=0.05, material=steel) for _ in range(55)]
    disk = ross.DiskElement(n=28, m=15, Id=0.1, Ip=0.18)
    bearings = [ross.BearingElement(n=n, kxx=1e7, kyy=8e6, cxx=1e3, cyy=1e3) for n in (4, 51)]
    return ross.Rotor(shaft, [disk], bearings)


def timed(work) -> float:
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun


def main(whirl: str) -> None:
    warnings.simplefilter("ignore")
    import numpy

    speeds = numpy.linspace(0, 6000 * 2 * numpy.pi / 60, SPEEDS)
    with tempfile.TemporaryDirectory() as folder:
        command = [whirl, "campbell", "hu2003-2", "--speeds", f"0 rpm .. 6000 rpm, {SPEEDS}"]
        command += ["--count", str(MODES), "--no-figures", "--quiet", "--out", folder]
        subprocess.run(command, check=True)

        own, other = [], []
        for _ in range(TURNS):
            rotor = ross_rotor()
            own.append(timed(lambda: subprocess.run(command, check=True)))
            other.append(timed(lambda: rotor.run_campbell(speeds, frequencies=MODES)))
    own, other = statistics.median(own), statistics.median(other)
    print(f"whirl campbell, 226 coordinates: {own:.2f} s")
    print(f"ROSS run_campbell, {rotor.ndof} dofs:  {other:.2f} s, {other / own:.1f} times as long")


if __name__ == "__main__":
    main(sys.argv[1])
