"""Rotors saved by ROSS, and their lateral modes after ROSS: the files beside this one.

Run with ROSS 2.3.0 (`pip install ross-rotordynamics==2.3.0 "plotly<6"`) in this folder. Each rotor is saved as it is. The modes
are those of the same rotor with every shaft element cut into four, without its motion along z and in torsion: frequencies
(Hz) and damping ratios of the first modes at two speeds. Beams of few elements are up to some percent too stiff in higher
modes, which is none of the differences between beams and solids that are to be seen.
"""

import csv
import gzip
import warnings
from pathlib import Path

import numpy as np

warnings.simplefilter("ignore")
import ross as rs
from ross.utils import convert_6dof_to_4dof

CUT = 4
MODES = 8
steel = rs.materials.steel
bronze = rs.Material(name="Bronze", rho=8800, E=110e9, G_s=41e9)


def cut(rotor, parts=CUT):
    """The same rotor with shorter elements."""

    def nodes(n, run):
        return run[n] if n in run else n

    runs = {}
    new = 0
    elements = rotor.shaft_elements
    last = None
    for n in sorted({e.n for e in elements}):
        if last is None or n != last + 1:
            runs[n] = new
        new = runs[n] + (1 if type(elements[0]) is not rs.ShaftElement else parts)
        runs[n + 1] = new
        last = n
        if n + 1 not in {e.n for e in elements}:
            new += 1
    top = max(runs)
    shift = max(runs.values()) - top

    def at(n):
        return runs[n] if n in runs else n + shift

    def between(a, b, k):
        return a + (b - a) * k / parts

    shafts, run, previous = [], [], None
    for e in elements:
        if previous is not None and e.n > previous + 1:
            shafts.append(run)
            run = []
        previous = e.n
        for k in range(parts):
            run.append(
                rs.ShaftElement(
                    L=e.L / parts,
                    idl=between(e.idl, e.idr, k), idr=between(e.idl, e.idr, k + 1),
                    odl=between(e.odl, e.odr, k), odr=between(e.odl, e.odr, k + 1),
                    material=e.material, n=runs[e.n] + k, alpha=e.alpha, beta=e.beta,
                    shear_effects=e.shear_effects, rotary_inertia=e.rotary_inertia,
                    gyroscopic=e.gyroscopic, tag=f"{e.tag}.{k}",
                )
            )  # fmt: skip
    shafts.append(run)
    discs = [rs.DiskElement(at(d.n), d.m, d.Id, d.Ip) for d in rotor.disk_elements]
    keys = [k + d for k in "kcm" for d in ("xx", "xy", "yx", "yy", "zz")]
    bearings = [
        rs.BearingElement(
            n=at(b.n), n_link=None if b.n_link is None else at(b.n_link), frequency=b.frequency,
            tag=b.tag, **{key: getattr(b, key) if len(getattr(b, key)) > 1 else float(getattr(b, key)[0]) for key in keys},
        )
        for b in rotor.bearing_elements
    ]  # fmt: skip
    masses = [rs.PointMass(n=at(p.n), mx=p.mx, my=p.my, mz=p.mz) for p in rotor.point_mass_elements]
    if len(shafts) > 1:
        return rs.CoAxialRotor(shafts, discs, bearings, masses)
    return rs.Rotor(shafts[0], discs, bearings, masses)


def lateral(rotor, speed):
    """Frequencies (Hz) and damping ratios of lateral modes."""
    modal = convert_6dof_to_4dof(rotor).run_modal(speed, num_modes=4 * MODES, sparse=False)
    found = sorted(zip(modal.wd / 2 / np.pi, modal.damping_ratio))
    return [own for own in found if own[0] > 0.1][:MODES]


def tapered():
    """Cones, a bore, and a sleeve of bronze around a part of the shaft."""
    rows = [(0.2, 0, 0, 0.05, 0.05), (0.15, 0, 0, 0.05, 0.08), (0.3, 0.02, 0.02, 0.08, 0.08),
            (0.3, 0.02, 0.02, 0.08, 0.08), (0.15, 0.02, 0.03, 0.08, 0.06), (0.2, 0.03, 0.03, 0.06, 0.06)]  # fmt: skip
    shaft = [
        rs.ShaftElement(L=L, idl=a, idr=b, odl=c, odr=d, material=steel, n=n)
        for n, (L, a, b, c, d) in enumerate(rows)
    ]
    shaft.append(rs.ShaftElement(L=0.3, idl=0.08, odl=0.1, material=bronze, n=2, tag="Sleeve"))
    discs = [rs.DiskElement.from_geometry(n=3, material=steel, width=0.05, i_d=0.08, o_d=0.3)]
    bearings = [
        rs.BearingElement(0, kxx=4e7, kyy=3e7, cxx=2e3),
        rs.BearingElement(6, kxx=5e7, kyy=4e7, cxx=2e3),
    ]
    return rs.Rotor(shaft, discs, bearings, rated_w=600.0)


def film():
    """Bearings whose coefficients are tables over the speed, with cross terms."""
    shaft = [rs.ShaftElement(L=0.1, idl=0, odl=0.06, material=steel) for _ in range(10)]
    discs = [rs.DiskElement.from_geometry(n=5, material=steel, width=0.08, i_d=0.06, o_d=0.32)]
    speeds = np.linspace(50, 800, 16)
    own = dict(
        kxx=2e7 + 1e4 * speeds, kyy=1.2e7 + 2e4 * speeds, kxy=4e6 + 3e3 * speeds, kyx=-6e6 - 2e3 * speeds,
        cxx=8e4 - 40 * speeds, cyy=5e4 - 20 * speeds, cxy=-2e3 + 0 * speeds, cyx=-2e3 + 0 * speeds,
        frequency=speeds,
    )  # fmt: skip
    return rs.Rotor(shaft, discs, [rs.BearingElement(1, **own), rs.BearingElement(9, **own)], max_w=700.0)


def supports():
    """Bearings on masses on springs, and a thrust bearing."""
    shaft = [rs.ShaftElement(L=0.12, idl=0.0, odl=0.05, material=steel) for _ in range(10)]
    discs = [rs.DiskElement(n=4, m=20.0, Id=0.12, Ip=0.2), rs.DiskElement(n=10, m=6.0, Id=0.02, Ip=0.03)]
    bearings = [
        rs.BearingElement(0, n_link=11, kxx=3e7, kyy=2e7, cxx=1e3, kzz=1e7),
        rs.BearingElement(8, n_link=12, kxx=3e7, kyy=2e7, cxx=1e3),
        rs.BearingElement(11, kxx=1e7, kyy=4e7, cxx=5e2, kzz=5e7),
        rs.BearingElement(12, kxx=1e7, kyy=4e7, cxx=5e2),
    ]
    masses = [rs.PointMass(n=11, m=12.0), rs.PointMass(n=12, m=15.0)]
    return rs.Rotor(shaft, discs, bearings, masses, min_w=0.0, max_w=1000.0, rated_w=500.0)


def train():
    """Two shafts and a coupling that gives way in bending and torsion."""
    shaft = [rs.ShaftElement(L=0.15, idl=0, odl=0.06, material=steel) for _ in range(6)]
    shaft.append(
        rs.CouplingElement(
            m_l=3.0, m_r=4.0, Ip_l=0.02, Ip_r=0.03, Id_l=0.012, Id_r=0.017, kt_x=5e7, kt_y=5e7, kt_z=1e6,
            kr_x=2e5, kr_y=2e5, kr_z=3e5, L=0.1,
        )
    )  # fmt: skip
    shaft += [rs.ShaftElement(L=0.12, idl=0, odl=0.05, material=steel) for _ in range(5)]
    discs = [
        rs.DiskElement.from_geometry(n=3, material=steel, width=0.08, i_d=0.06, o_d=0.3),
        rs.DiskElement.from_geometry(n=9, material=steel, width=0.05, i_d=0.05, o_d=0.25),
    ]
    bearings = [rs.BearingElement(n, kxx=5e7, kyy=4e7, cxx=1e3) for n in (1, 5, 8, 11)]
    return rs.Rotor(shaft, discs, bearings)


def soft():
    """Impellers of mass without stiffness on a shaft: a cone, and a tube as long as it is wide."""
    light = rs.Material(name="Soft", rho=6000, E=1e5, G_s=4e4)
    shaft = [rs.ShaftElement(L=0.125, idl=0, odl=0.06, material=steel, n=n) for n in range(12)]
    shaft.append(rs.ShaftElement(L=0.125, idl=0.06, odl=0.1, idr=0.06, odr=0.2, material=light, n=4))
    shaft.append(rs.ShaftElement(L=0.125, idl=0.06, odl=0.25, material=light, n=11))
    discs = [rs.DiskElement(n=9, m=10, Id=0.05, Ip=0.09)]
    bearings = [rs.BearingElement(n, kxx=2e7, kyy=1.5e7, cxx=100) for n in (0, 10)]
    return rs.Rotor(shaft, discs, bearings)


ROTORS = {
    "example": (rs.rotor_example, "toml", [0.0, 400.0]),
    "example-6dof": (rs.rotor_example_6dof, "json", [0.0, 400.0]),
    "compressor": (rs.compressor_example, "toml", [900.0]),
    "coaxial": (rs.coaxrotor_example, "toml", [0.0, 200.0]),
    "damping": (rs.rotor_example_with_damping, "json", [0.0]),
    "tapered": (tapered, "toml", [0.0, 600.0]),
    "film": (film, "toml", [200.0, 700.0]),
    "supports": (supports, "json", [0.0, 500.0]),
    "train": (train, "toml", [0.0, 400.0]),
    "soft": (soft, "toml", [0.0, 400.0]),
}


def main():
    rows = []
    for name, (make, form, speeds) in ROTORS.items():
        rotor = make()
        file = Path(f"{name}.{form}")
        file.unlink(missing_ok=True)
        rotor.save(file)
        with open(f"{file}.gz", "wb") as packed, gzip.GzipFile("", "wb", fileobj=packed, mtime=0) as into:
            into.write(file.read_bytes())
        file.unlink()
        try:
            fine = cut(rotor) if name != "train" else rotor
        except Exception as error:
            raise RuntimeError(name) from error
        for speed in speeds:
            own, finer = lateral(rotor, speed), lateral(fine, speed)
            for number, ((hertz, ratio), (fine_hertz, _)) in enumerate(zip(finer, own), 1):
                rows.append([name, speed, number, f"{hertz:.7g}", f"{ratio:.6g}", f"{fine_hertz:.7g}"])
    with open("lateral.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["rotor", "speed_rad_s", "mode", "frequency_hz", "damping_ratio", "as_saved_hz"])
        table.writerows(rows)


if __name__ == "__main__":
    main()
